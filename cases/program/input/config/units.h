#pragma once
// Quantities as people write them, "75 MPa", to SI doubles. The only place that knows UDUNITS-2. Several threads
// may call it at once.

#include <string>
#include <string_view>

namespace pfdm {

/// A physical dimension: its name, the SI unit inside the program, and an example for messages.
struct Dimension {
  std::string_view name;
  std::string_view si_unit;
  std::string_view example;
};

namespace dimension {
inline constexpr Dimension length{"length", "m", "20 um"};
inline constexpr Dimension area{"area", "m^2", "4 mm^2"};
inline constexpr Dimension volume{"volume", "m^3", "1 mm^3"};
inline constexpr Dimension mass{"mass", "kg", "50 g"};
inline constexpr Dimension time{"time", "s", "1 ms"};
inline constexpr Dimension frequency{"frequency", "Hz", "2 kHz"};
inline constexpr Dimension rate{"rate", "1/s", "1e-4 1/s"};
inline constexpr Dimension velocity{"velocity", "m/s", "1 mm/s"};
inline constexpr Dimension acceleration{"acceleration", "m/s^2", "5 g0"};
inline constexpr Dimension acceleration_density{"acceleration spectral density", "m^2/s^4/Hz", "0.05 g0^2/Hz"};
inline constexpr Dimension density{"density", "kg/m^3", "1030 kg/m^3"};
inline constexpr Dimension force{"force", "N", "10 N"};
inline constexpr Dimension compliance{"compliance", "m/N", "2 um/kN"};
inline constexpr Dimension energy{"energy", "J", "1 mJ"};
inline constexpr Dimension stress{"stress", "Pa", "75 MPa"};
inline constexpr Dimension viscosity{"viscosity", "Pa s", "1 kPa s"};
inline constexpr Dimension toughness{"energy per area", "J/m^2", "10 J/m^2"};
inline constexpr Dimension interface_stiffness{"stress per length", "Pa/m", "1e12 Pa/m"};
inline constexpr Dimension temperature{"temperature", "K", "20 degC"};
inline constexpr Dimension angle{"angle", "radian", "30 degree"};
inline constexpr Dimension number{"number without a unit", "1", "0.3"};
}  // namespace dimension

/// The value in due.si_unit of a text such as "20 um". Throws InputError that says what was found and what was
/// expected.
double parse_quantity(std::string_view text, const Dimension& due);

/// How many due.si_unit one `unit` is; for expressions that carry their unit beside them. Throws like parse_quantity.
double unit_in_si(std::string_view unit, const Dimension& due);

/// Whether UDUNITS knows it.
bool is_unit(std::string_view text);
/// Whether it is a unit of this dimension.
bool is_unit_of(std::string_view text, const Dimension& due);
/// Whether it is one of temperatures whose zero is not 0 K, as "degC".
bool has_other_zero(std::string_view unit);

/// Which of the dimensions above the text's quantity has; of several alike the first. Throws InputError for what is no
/// quantity, or is of none of them.
const Dimension& dimension_of(std::string_view text);
/// The unit of a quantity as it is written: "MPa".
std::string_view unit_of(std::string_view text);

/// "a length", "an energy".
std::string with_article(std::string_view noun);

}  // namespace pfdm
