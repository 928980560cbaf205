#pragma once
// Points that fill a box evenly: Halton's sequence, whose first points are those of any longer one (Halton, Numerische
// Mathematik 2 (1960) 84). Coordinate j of point n is radical_inverse(n, primes(dimension)[j]).

#include <cstddef>
#include <vector>

namespace pfdm {

/// The digits of n in a base, behind the point in reverse: within [0, 1).
double radical_inverse(int n, int base);

/// The first n prime numbers.
std::vector<int> primes(std::size_t n);

}  // namespace pfdm
