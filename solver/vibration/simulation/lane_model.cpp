#include "solver/vibration/simulation/lane_model.h"

#include <algorithm>

namespace pfdm {
namespace {

/// A number of each run; lanes without a run repeat the last one.
template <class Get>
Lanes lanes(std::span<const SimulationRun> runs, const Get& get) {
  Lanes lane;
  for (int l = 0; l < n_lanes; ++l) lane[l] = get(*runs[std::min(static_cast<std::size_t>(l), runs.size() - 1)].model);
  return lane;
}

}  // namespace

LaneModel lane_model(std::span<const SimulationRun> runs) {
  using M = const MassMaterial&;
  const MassMaterial& first = *runs.front().model;
  LaneModel m;
  m.mass_inverse = lanes(runs, [](M x) { return 1.0 / x.mass; });
  m.damping = lanes(runs, [](M x) { return x.damping; });
  m.exponent = lanes(runs, [](M x) { return x.damping_exponent; });
  m.velocity_inverse = lanes(runs, [](M x) { return 1.0 / x.reference_velocity; });
  m.nonlinear_damping =
      std::ranges::any_of(runs, [](const SimulationRun& x) { return x.model->damping_exponent != 0.0; });
  m.forcing = first.forcing;
  for (std::size_t i = 0; i < first.stiffness.size(); ++i)
    m.stiffness.push_back(lanes(runs, [i](M x) { return x.stiffness[i]; }));
  for (std::size_t i = 0; i < first.kernel.size(); ++i) {
    LaneKernel k;
    k.pair = first.kernel[i].is_pair();
    k.rate_real = lanes(runs, [i](M x) { return x.kernel[i].alpha.real(); });
    k.rate_imaginary = lanes(runs, [i](M x) { return x.kernel[i].alpha.imag(); });
    const double share = k.pair ? 2.0 : 1.0;
    k.weight_real = lanes(runs, [=](M x) { return share * x.kernel[i].beta.real(); });
    k.weight_imaginary = lanes(runs, [=](M x) { return share * x.kernel[i].beta.imag(); });
    m.any_pair = m.any_pair || k.pair;
    m.n_states += k.pair ? 2 : 1;
    m.kernel.push_back(k);
  }
  return m;
}

}  // namespace pfdm
