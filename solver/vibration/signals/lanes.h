#pragma once
// Eight numbers side by side, one of each of eight computations that do the same: two vector registers of four, whose
// chains of operations overlap. Plain vector arithmetic, which the compiler keeps in registers.

#include <cstdint>

namespace pfdm {

constexpr int n_lanes = 8;

using Register = double __attribute__((vector_size(32)));
using RegisterBits = std::int64_t __attribute__((vector_size(32)));

struct Lanes {
  Register a;
  Register b;
  double& operator[](int i) { return i < 4 ? reinterpret_cast<double*>(&a)[i] : reinterpret_cast<double*>(&b)[i - 4]; }
  double operator[](int i) const {
    return i < 4 ? reinterpret_cast<const double*>(&a)[i] : reinterpret_cast<const double*>(&b)[i - 4];
  }
  static Lanes all(double x) { return {Register{x, x, x, x}, Register{x, x, x, x}}; }
};
inline Lanes operator+(const Lanes& x, const Lanes& y) { return {x.a + y.a, x.b + y.b}; }
inline Lanes operator-(const Lanes& x, const Lanes& y) { return {x.a - y.a, x.b - y.b}; }
inline Lanes operator*(const Lanes& x, const Lanes& y) { return {x.a * y.a, x.b * y.b}; }
inline Lanes operator*(double x, const Lanes& y) { return {x * y.a, x * y.b}; }
inline Lanes operator-(const Lanes& x) { return {-x.a, -x.b}; }
inline Lanes& operator+=(Lanes& x, const Lanes& y) { return x = x + y; }
inline Lanes& operator-=(Lanes& x, const Lanes& y) { return x = x - y; }

inline Register absolute(Register x) { return (Register)((RegisterBits)x & INT64_MAX); }

/// c_0 + c_1 x + ... + c_13 x^13 by Estrin's scheme, whose operations do not all wait for each other.
[[gnu::always_inline]] inline Register polynomial(const double (&c)[14], Register x) {
  const Register x2 = x * x;
  const Register x4 = x2 * x2;
  const auto four = [&](int i) { return (c[i] + c[i + 1] * x) + (c[i + 2] + c[i + 3] * x) * x2; };
  return (four(0) + four(4) * x4) + (four(8) + (c[12] + c[13] * x) * x4) * (x4 * x4);
}

/// x^e for x >= 0 as 2^(e log2 x), to some units in the last place of e log2 x. Zero counts as 2^-1000, and the result
/// stays between 2^-1000 and 2^1000.
[[gnu::always_inline]] inline Register power(Register x, Register e) {
  constexpr double log2_e = 1.4426950408889634074;
  constexpr double ln_2 = 0.69314718055994530942;
  constexpr std::int64_t mantissa = 0x000FFFFFFFFFFFFF, one = 0x3FF0000000000000, two_to_52 = 0x4330000000000000;
  const Register least = Register{} + 0x1p-1000;
  const Register limit = Register{} + 1000.0;
  const RegisterBits bits = (RegisterBits)(x > least ? x : least);
  // x = m 2^n, m from sqrt 1/2 to sqrt 2; the sign is zero, so that shifting brings the biased n alone.
  Register n = (Register)((bits >> 52) | two_to_52) - (0x1p52 + 1023.0);
  Register m = (Register)((bits & mantissa) | one);
  const RegisterBits large = m > (Register{} + 1.41421356237309504880);
  m = large ? 0.5 * m : m;
  n = large ? n + 1.0 : n;
  // ln m = 2 artanh s.
  const Register s = (m - 1.0) / (m + 1.0);
  const Register q = s * s;
  const Register series = polynomial({1.0, 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9, 1.0 / 11, 1.0 / 13, 1.0 / 15, 1.0 / 17,
                                      1.0 / 19, 1.0 / 21, 1.0 / 23, 0.0, 0.0},
                                     q);
  Register y = e * (n + (2.0 * log2_e) * (s * series));
  y = y > limit ? limit : y;
  y = y < -limit ? -limit : y;
  // 2^y = 2^i 2^f; adding 1.5 2^52 leaves the nearest integer i in the last bits.
  const Register shifted = y + 0x1.8p52;
  const Register f = (y - (shifted - 0x1.8p52)) * ln_2;
  const Register exponential =
      polynomial({1.0, 1.0, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880,
                  1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800},
                 f);
  return exponential * (Register)(((RegisterBits)shifted + 1023) << 52);
}

inline Lanes absolute(const Lanes& x) { return {absolute(x.a), absolute(x.b)}; }
[[gnu::always_inline]] inline Lanes power(const Lanes& x, const Lanes& e) { return {power(x.a, e.a), power(x.b, e.b)}; }

}  // namespace pfdm
