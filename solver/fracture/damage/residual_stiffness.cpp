#include "solver/fracture/damage/residual_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double bearable = 0.02;  // part of the largest force so far
constexpr double wanted = 0.01;    // with the stiffness that is advised
constexpr double everything = 0.9;

// 1, 2 or 5 times a power of ten, at most x.
double round_down(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return (x >= 5.0 * power ? 5.0 : x >= 2.0 * power ? 2.0 : 1.0) * power;
}

}  // namespace

bool holds_all(double residual, double elastic) { return residual > everything * std::abs(elastic); }

bool has_collapsed(const ResidualShare& share) {
  return holds_all(share.residual, share.elastic) && share.traction_work > std::max(share.elastic, 0.0);
}

std::string ResidualStiffness::remark(const ResidualShare& share, double energy_before, double load) {
  const double by = is_proportional_ ? std::abs(load) : 1.0;
  largest_ = std::max(largest_, std::max(share.elastic, energy_before) / by);
  // A body that eigenstrains bend freely stores next to nothing, of either sign.
  if (said_ || !(share.elastic > 0.0) || !(share.residual / by > bearable * largest_)) return "";
  said_ = true;
  const double part = share.residual / share.elastic;
  if (holds_all(share.residual, share.elastic))
    return fmt::format(
        "load {:.6g}: cracks go through the whole body: {:.0f} % of its elastic energy is in the residual stiffness of "
        "broken cells (fracture.residual_stiffness, {:g}), which alone holds it together",
        load, 100.0 * part, k_);
  // Two springs side by side, of which one is proportional to k.
  const double advised = round_down(k_ * wanted * (1.0 - part) / part);
  return fmt::format(
      "load {:.6g}: {:.2g} % of the elastic energy is in the residual stiffness of broken cells; without it the force "
      "would be lower by about as much. Cracks so thin and long need a smaller fracture.residual_stiffness, here "
      "{:.0e} "
      "instead of {:g}",
      load, 100.0 * part, advised, k_);
}

}  // namespace pfdm
