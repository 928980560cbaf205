#pragma once
// Numbers in the fields of input files.

#include <string>

namespace pfdm {

/// With 10 digits: "1.25e+12".
std::string deck_number(double value);

/// Right-aligned in a field of `width` (8 at least) characters, with as many digits as it holds, and always a decimal
/// point or an exponent, as cards want their reals: "    1.25E12".
std::string real_field(double value, int width);
std::string integer_field(int value, int width);

}  // namespace pfdm
