#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace pfdm {
namespace {

constexpr std::array<UnitPrefix, 8> prefixes{
    {{-4, "p"}, {-3, "n"}, {-2, "u"}, {-1, "m"}, {0, ""}, {1, "k"}, {2, "M"}, {3, "G"}}};

/// A number with some digits, whole where it has more before the point: "12346" rather than "1.235e+04".
std::string number_text(double value, int digits) {
  const double magnitude = std::abs(value);
  if (magnitude >= std::pow(10.0, digits) - 0.5 && magnitude < 1e7) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, digits);
}

double largest_of(std::initializer_list<double> values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

std::string joined(std::initializer_list<double> values, double factor, std::string_view between, int digits) {
  const double least = 1e-9 * largest_of(values);  // below it is what is left of a zero
  std::string words;
  for (const double value : values) {
    if (!words.empty()) words += between;
    words += number_text(std::abs(value) < least ? 0.0 : factor * value, digits);
  }
  return words;
}

}  // namespace

std::span<const UnitPrefix> unit_prefixes() { return prefixes; }

ScaledUnit scaled_unit(double largest, std::string_view si_unit) {
  const auto letters = static_cast<std::size_t>(
      std::ranges::find_if(si_unit, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) == 0; }) -
      si_unit.begin());
  const std::string_view rest = si_unit.substr(letters);
  const int exponent = rest.starts_with("^2") ? 2 : rest.starts_with("^3") ? 3 : 1;
  const double least = exponent == 1 ? 0.9995 : 1e-3;  // 0.02 mm^3 rather than 2e+07 um^3
  const UnitPrefix* chosen = &prefixes[4];
  const double magnitude = std::abs(largest);
  const auto of = [&](const UnitPrefix& prefix) { return std::pow(1e3, prefix.power * exponent); };
  if (magnitude >= least * of(prefixes.front()) && magnitude < 1e4 * of(prefixes.back()))
    for (const UnitPrefix& prefix : prefixes)
      if (magnitude >= least * of(prefix) && (prefix.power <= 1 || !si_unit.starts_with("m"))) chosen = &prefix;
  return {.factor = std::pow(1e3, -chosen->power * exponent), .name = fmt::format("{}{}", chosen->sign, si_unit)};
}

ScaledUnit scaled_seconds(double largest) {
  return std::abs(largest) < 1.0 ? scaled_unit(largest, "s") : ScaledUnit{1.0, "s"};
}

std::string quantity_text(double si, std::string_view si_unit, int digits) {
  if (!std::isfinite(si)) return "-";
  if (si_unit == "1") return number_text(si, digits);
  const ScaledUnit unit = scaled_unit(si, si_unit);
  return fmt::format("{} {}", number_text(unit.factor * si, digits), unit.name);
}

std::string quantities_text(std::initializer_list<double> si, std::string_view si_unit, std::string_view between,
                            int digits) {
  const ScaledUnit unit = scaled_unit(largest_of(si), si_unit);
  return fmt::format("{} {}", joined(si, unit.factor, between, digits), unit.name);
}

std::string point_text(double x, double y, double z, int digits) {
  const std::initializer_list<double> at = {x, y, z};
  const ScaledUnit unit = scaled_unit(largest_of(at), "m");
  return fmt::format("({}) {}", joined(at, unit.factor, ", ", digits), unit.name);
}

}  // namespace pfdm
