#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

struct Prefix {
  int power;  // of a thousand
  std::string_view sign;
};
constexpr std::array<Prefix, 8> prefixes{
    {{-4, "p"}, {-3, "n"}, {-2, "µ"}, {-1, "m"}, {0, ""}, {1, "k"}, {2, "M"}, {3, "G"}}};

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
  for (const Prefix& prefix : prefixes)
    if (unit.starts_with(prefix.sign) && unit.size() > prefix.sign.size())
      found.push_back({prefix.power, unit.substr(prefix.sign.size()), power});
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
  const std::size_t hat = si_unit.find('^');
  const std::string_view base = si_unit.substr(0, hat);
  const int exponent = hat == std::string_view::npos ? 1 : si_unit[hat + 1] - '0';
  const std::string_view raised = exponent == 2 ? "²" : exponent == 3 ? "³" : "";
  const double least = exponent == 1 ? 0.9995 : 1e-3;  // 0.02 mm³ rather than 2e+07 µm³
  const Prefix* chosen = &prefixes[4];
  if (std::isfinite(largest) && largest != 0.0) {
    chosen = &prefixes.front();
    for (const Prefix& prefix : prefixes)
      if (std::abs(largest) >= least * std::pow(1e3, prefix.power * exponent)) chosen = &prefix;
  }
  return {.factor = std::pow(1e3, -chosen->power * exponent),
          .name = fmt::format("{}{}{}", chosen->sign, base, raised)};
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
