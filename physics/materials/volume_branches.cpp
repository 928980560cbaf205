#include "physics/materials/volume_branches.h"

#include "physics/prony_decay.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// ln J, of cells that are almost flat or turned inside out that of the least volume.
double log_volume(double change) { return std::log1p(std::max(change, least_volume - 1.0)); }

}  // namespace

double VolumeBranches::modulus_over(double duration) const {
  double sum = 0.0;
  for (const PronyBranch& branch : branches_) sum += decay_over(duration / branch.time).phi * branch.modulus;
  return sum;
}

double VolumeBranches::strain(std::size_t j, const Step& step) const {
  return decay_over(step.duration / branches_[j].time)
      .after(step.history[j], log_volume(step.to) - log_volume(step.from));
}

OfVolume VolumeBranches::over(const Step& step) const {
  return extended(step.to, [&](double at) -> OfVolume {
    const double J = 1.0 + at;
    OfVolume sum;
    for (std::size_t j = 0; j < branches_.size(); ++j) {
      const double r = strain(j, {step.from, at, step.duration, step.history}), J_e = std::exp(r);
      const double K = branches_[j].modulus, phi = decay_over(step.duration / branches_[j].time).phi;
      const OfVolume U = volume_energy(form_, std::expm1(r));
      const double by_r = U.slope * J_e, slope_of_it = (U.curvature * J_e + U.slope) * J_e;
      sum.value += K * U.value;
      sum.slope += K * by_r / J;
      sum.curvature += K * (phi * slope_of_it - by_r) / (J * J);
    }
    return sum;
  });
}

// r at the start and at the end.
double VolumeBranches::dissipated(std::size_t j, double from, double to, double duration) const {
  const auto root = [this](double r) {
    const double slope = volume_energy(form_, std::expm1(r)).slope * std::exp(r);
    return std::copysign(std::sqrt(slope * r), r);
  };
  const double start = root(from), end = root(to), stored = volume_energy(form_, std::expm1(from)).value;
  const double x = duration / branches_[j].time, rate = stored > 0.0 ? 0.5 * start * start / stored : 1.0;
  const PronySquare by = square_over(rate * x);
  return branches_[j].modulus * x * (by.start * start * start + by.cross * start * end + by.end * end * end);
}

double VolumeBranches::advance(const Step& step, std::span<double> history) const {
  double heat = 0.0;
  for (std::size_t j = 0; j < branches_.size(); ++j) {
    const double before = step.history[j];
    history[j] = strain(j, step);
    heat += dissipated(j, before, history[j], step.duration);
  }
  return heat;
}

}  // namespace pfdm
