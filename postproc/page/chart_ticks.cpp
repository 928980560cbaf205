#include "postproc/page/chart_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// 1, 2 or 5 times a power of ten.
double round_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double digit = rough / power;
  return power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

constexpr double level = 1e-9;  // what differs by less beside its size differs by rounding

/// A hair of room, so that no curve runs along the frame.
void widen(double& least, double& most) {
  const double size = std::max(std::abs(least), std::abs(most));
  if (most - least <= level * size) {
    const double half = size == 0.0 ? 1.0 : 0.5 * size;
    least -= half;
    most += half;
    return;
  }
  const double room = 0.03 * (most - least);
  if (least != 0.0) least -= room;
  if (most != 0.0) most += room;
}

AxisTicks linear_ticks(const ChartAxis& axis, double least, double most, int count) {
  AxisTicks ticks;
  widen(least, most);
  ticks.from = axis.from.value_or(least);
  ticks.to = axis.to.value_or(most);
  const double step = round_step((ticks.to - ticks.from) / count);
  const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double slack = 1e-9 * (ticks.to - ticks.from);
  const double size = std::max(std::abs(ticks.from), std::abs(ticks.to));
  const int significant =
      std::max(6, static_cast<int>(std::floor(std::log10(size)) - std::floor(std::log10(step))) + 1);
  for (double k = std::ceil((ticks.from - slack) / step); k * step <= ticks.to + slack; ++k) {
    ticks.positions.push_back(k * step);
    ticks.labels.push_back(std::abs(k * step) >= 1e5 || digits > 4 ? fmt::format("{:.{}g}", k * step, significant)
                                                                   : fmt::format("{:.{}f}", k * step, digits));
  }
  for (std::string& label : ticks.labels)
    if (label.front() == '-' && label.find_first_of("123456789") == std::string::npos) label.erase(0, 1);
  return ticks;
}

std::string power_label(int power) {
  if (power >= -2 && power <= 4) return fmt::format("{:g}", std::pow(10.0, power));
  return fmt::format("1e{}", power);
}

constexpr double most_decades_with_digits = 3.5;

AxisTicks logarithmic_ticks(const ChartAxis& axis, double least, double most, int count) {
  AxisTicks ticks;
  ticks.from = std::log10(axis.from.value_or(least));
  ticks.to = std::log10(axis.to.value_or(most));
  if (ticks.to - ticks.from < 1e-6) ticks.from -= 0.5, ticks.to += 0.5;
  const double decades = ticks.to - ticks.from;
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / (count + 1))));
  for (int power = static_cast<int>(std::floor(ticks.from)); power <= std::ceil(ticks.to); ++power)
    for (int digit = 1; digit < 10; ++digit) {
      const double position = power + std::log10(digit);
      if (position < ticks.from - 1e-9 || position > ticks.to + 1e-9 ||
          (digit > 1 && decades > most_decades_with_digits))
        continue;
      const bool labelled = digit == 1 ? power % stride == 0 : decades < 2.5 && (digit == 2 || digit == 5);
      ticks.positions.push_back(position);
      const double value = digit * std::pow(10.0, power);
      ticks.labels.push_back(!labelled ? "" : digit == 1 ? power_label(power) : fmt::format("{:g}", value));
    }
  return ticks;
}

}  // namespace

AxisTicks axis_ticks(const ChartAxis& axis, double least, double most, int count) {
  if (!(least <= most)) least = axis.logarithmic ? 1.0 : 0.0, most = axis.logarithmic ? 10.0 : 1.0;  // no values
  return axis.logarithmic ? logarithmic_ticks(axis, least, most, count) : linear_ticks(axis, least, most, count);
}

}  // namespace pfdm
