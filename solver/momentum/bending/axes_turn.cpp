#include "solver/momentum/bending/axes_turn.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double longest = 0.65;      // cells over the thickness of the body
constexpr double shear_for_it = 2.5;  // BendingLayers::shear
constexpr std::size_t few = 3;
constexpr double least_turn = 0.02;  // R

double stiffer_in_shear(double shear) { return std::sqrt(std::max(1.0, shear / shear_for_it)); }

double square(double x) { return x * x; }

double unevenness(std::span<const TurnedLayer> layers) {
  double whole = 0.0, cubes = 0.0;
  for (const TurnedLayer& in : layers) whole += in.thickness;
  for (const TurnedLayer& in : layers) cubes += std::pow(in.thickness / whole, 3);
  return std::max(0.0, cubes - 1.0 / square(static_cast<double>(layers.size())));
}

}  // namespace

double AxesTurn::error() const {
  if (unknown != Unknown::no) return 3.0;
  const double of_steps = (is_of_few ? 0.15 : 0.08) * square(step / std::max(1.0, most));
  return std::max({of_steps, error_of_plies(), error_of_uneven()});
}

double AxesTurn::error_of_plies() const { return plies > 0.0 ? 0.13 * plies / (2.0 * std::max(0.3, most)) : 0.0; }

double AxesTurn::error_of_uneven() const { return most > least_turn ? uneven * (0.6 + 8.0 * range) : 0.0; }

double AxesTurn::error_of_long(double length, double shear) const {
  return std::min(1.0, 4.0 * range) * std::max(0.0, length * stiffer_in_shear(shear) - longest);
}

double AxesTurn::length_for(double error, double shear) { return (longest + error) / stiffer_in_shear(shear); }

AxesTurn axes_turn(std::span<const TurnedLayer> layers, bool has_eigenstrain) {
  using Unknown = AxesTurn::Unknown;
  AxesTurn turn{.uneven = unevenness(layers), .is_of_few = layers.size() <= few};
  for (const TurnedLayer& in : layers) turn.most = std::max(turn.most, std::abs(in.R));
  std::ptrdiff_t before = 0;  // layers of the material before
  for (auto first = layers.begin(); first != layers.end();) {
    const auto end = std::find_if(first, layers.end(), [&](const TurnedLayer& in) { return in.zone != first->zone; });
    const auto [least, greatest] = std::ranges::minmax(std::span(first, end), {}, &TurnedLayer::R);
    turn.range = std::max(turn.range, greatest.R - least.R);
    if (turn.is_of_few) turn.step = turn.range;
    for (auto at = first + 1; at < end; ++at) turn.step = std::max(turn.step, std::abs(at->R - (at - 1)->R));
    const bool is_alone = end - first == std::ssize(layers);
    if (end - first == 1 && !is_alone && std::abs(first->R) > least_turn) turn.unknown = Unknown::lone_plies;
    const bool turns = greatest.R - least.R > least_turn;
    if (turns && !is_alone) turn.unknown = Unknown::goes_on;
    if (turns && has_eigenstrain) turn.unknown = Unknown::eigenstrains;
    if (first != layers.begin()) {
      const double jump = std::abs(first->R - (first - 1)->R);
      turn.range = std::max(turn.range, jump);
      if (before == 2 || end - first == 2) turn.plies = std::max(turn.plies, jump);
    }
    before = end - first;
    first = end;
  }
  return turn;
}

}  // namespace pfdm
