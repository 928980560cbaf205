#include "postproc/page/display_unit.h"

#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

/// "mm²" as prefix, base and power, in every way that it can be read.
struct ReadUnit {
  int thousands;  // of the prefix
  std::string_view base;
  int power;
};
std::vector<ReadUnit> readings(std::string_view unit) {
  int power = 1;
  for (const auto& [sign, raised] : {std::pair("²", 2), std::pair("³", 3)})
    if (unit.ends_with(sign)) {
      unit.remove_suffix(std::string_view(sign).size());
      power = raised;
      break;
    }
  std::vector<ReadUnit> found;
  for (const UnitPrefix& prefix : unit_prefixes()) {
    const std::string_view sign = prefix.sign == "u" ? "µ" : prefix.sign;
    if (unit.starts_with(sign) && unit.size() > sign.size())
      found.push_back({prefix.power, unit.substr(sign.size()), power});
  }
  return found;
}

}  // namespace

std::optional<double> factor_between(std::string_view a, std::string_view b) {
  if (a == b) return 1.0;
  if (a.find('/') != std::string_view::npos) return std::nullopt;
  for (const ReadUnit& one : readings(a))
    for (const ReadUnit& other : readings(b))
      if (one.base == other.base && one.power == other.power)
        return std::pow(1e3, (one.thousands - other.thousands) * one.power);
  return std::nullopt;
}

DisplayUnit display_unit(double largest, std::string_view si_unit) {
  ScaledUnit scaled = scaled_unit(largest, si_unit);
  if (scaled.name.size() > si_unit.size() && scaled.name.front() == 'u') scaled.name.replace(0, 1, "µ");
  for (const auto& [plain, sign] : {std::pair("^2", "²"), std::pair("^3", "³")})
    if (const std::size_t at = scaled.name.find(plain); at != std::string::npos) scaled.name.replace(at, 2, sign);
  return {.factor = scaled.factor, .name = scaled.name};
}

std::string shown(double value, std::string_view si_unit) {
  const DisplayUnit unit = display_unit(value, si_unit);
  return std::isfinite(value) ? shown(unit.factor * value) + "\u00a0" + unit.name : "-";
}

std::string shown(double value) {
  if (!std::isfinite(value)) return "-";
  const bool many_digits = std::abs(value) >= 1e4 && std::abs(value) < 1e6;  // 12346 rather than 1.235e+04
  return many_digits ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string shown_seconds(double seconds) {
  return seconds < 100.0 ? fmt::format("{:.3g}", seconds) : fmt::format("{:.0f}", seconds);
}

}  // namespace pfdm
