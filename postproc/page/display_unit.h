#pragma once
// Numbers in SI for readers: with the prefix that leaves few digits before the point.

#include <optional>
#include <string>
#include <string_view>

namespace pfdm {

struct DisplayUnit {
  double factor = 1.0;  ///< of a number in SI, to be shown
  std::string name;     ///< as in "µm"
};

/// For numbers up to `largest` in magnitude. `si_unit` is one that takes a prefix, alone or to a power: "N", "m^3".
DisplayUnit display_unit(double largest, std::string_view si_unit);

/// How many `b` one `a` is, of units as display_unit() names them: 1000 of "mm" and "µm"; none where they are no such
/// two.
std::optional<double> factor_between(std::string_view a, std::string_view b);

/// As in "13.4 N", four digits, a blank that does not break; "-" for what is no number.
std::string shown(double value, std::string_view si_unit);
/// Four digits; "-" for what is no number.
std::string shown(double value);

/// Three digits, but no power of ten: "9.72", "2731".
std::string shown_seconds(double seconds);

}  // namespace pfdm
