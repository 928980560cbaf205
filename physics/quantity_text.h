#pragma once
// Quantities in SI as people write them, in words of messages.

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace pfdm {

struct UnitPrefix {
  int power;  ///< of a thousand
  std::string_view sign;
};
/// From p to G, in ASCII: "u" of a millionth.
std::span<const UnitPrefix> unit_prefixes();

struct ScaledUnit {
  double factor = 1.0;  ///< of a number in SI
  std::string name;     ///< in ASCII: "um", "mm^3", "kJ/m^2"
};

/// The unit in which numbers up to `largest` in magnitude have one to three digits before the point. `si_unit` is a
/// unit, alone or to the power of 2 or 3, with what divides it or not: "N", "m^3", "J/m^2". Its first unit takes the
/// prefix.
ScaledUnit scaled_unit(double largest, std::string_view si_unit);

/// Seconds, or parts of them: people write no kiloseconds.
ScaledUnit scaled_seconds(double largest);

/// A number in SI with its unit and `digits` digits: "60.1 um", "2.5 MPa", "1.5 kJ/m^2". Of the unit "1" the
/// number alone; "-" for what is no number.
std::string quantity_text(double si, std::string_view si_unit, int digits = 4);

/// Several in one unit, which suits the largest, joined by `between`: "10 to 300 um".
std::string quantities_text(std::initializer_list<double> si, std::string_view si_unit, std::string_view between,
                            int digits = 4);

/// A point [m]: "(0.1, 20, 300) um".
std::string point_text(double x, double y, double z, int digits = 3);
template <class Point>
std::string point_text(const Point& x, int digits = 3) {
  return point_text(x[0], x[1], x[2], digits);
}

}  // namespace pfdm
