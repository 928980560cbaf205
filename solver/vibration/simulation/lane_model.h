#pragma once
// The mass-material equation of several runs side by side: their parameters, and the slopes of their states.

#include "physics/point/mass_material.h"
#include "solver/vibration/signals/lanes.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <array>
#include <span>
#include <vector>

namespace pfdm {

/// A term of the kernel: one state if it is real, two of a pair.
struct LaneKernel {
  Lanes rate_real, rate_imaginary, weight_real, weight_imaginary;
  bool pair = false;
};

/// The parameters of a model in each lane; all models have the same terms.
struct LaneModel {
  Lanes mass_inverse, damping, exponent, velocity_inverse;
  std::vector<Lanes> stiffness;
  std::vector<LaneKernel> kernel;
  KernelForcing forcing = KernelForcing::none;
  bool nonlinear_damping = false;
  bool any_pair = false;
  std::size_t n_states = 2;
};

/// The models of the runs, in the order of the runs; lanes without a run repeat the last one.
LaneModel lane_model(std::span<const SimulationRun> runs);

/// (|z'|/V)^lambda.
[[gnu::always_inline]] inline Lanes power_of_speed(const LaneModel& m, const Lanes& velocity) {
  return power(absolute(velocity * m.velocity_inverse), m.exponent);
}

/// Forces of a state, and what drives the kernel.
struct LaneForces {
  Lanes plain;    ///< k(z) + c(z')
  Lanes forcing;  ///< f
};

/// Forces at the displacements z [m] and velocities [m/s].
[[gnu::always_inline]] inline LaneForces lane_forces(const LaneModel& m, const Lanes& z, const Lanes& velocity) {
  Lanes stiffness = Lanes::all(0.0);
  for (std::size_t i = m.stiffness.size(); i-- > 0;) stiffness = (stiffness + m.stiffness[i]) * z;
  const Lanes shaped = m.nonlinear_damping ? velocity * power_of_speed(m, velocity) : velocity;
  const Lanes plain = stiffness + m.damping * shaped;
  switch (m.forcing) {
    case KernelForcing::displacement: return {plain, z};
    case KernelForcing::stiffness: return {plain, stiffness};
    case KernelForcing::damping: return {plain, shaped};
    case KernelForcing::none:
    case KernelForcing::velocity: break;
  }
  return {plain, velocity};
}

/// Slopes of the kernel states, which follow z and z' in `state`; returns v. N: number of all states.
template <std::size_t N>
[[gnu::always_inline]] inline Lanes kernel_slopes(const LaneModel& m, const std::array<Lanes, N>& state, const Lanes& f,
                                                  std::array<Lanes, N>& slope) {
  Lanes v = Lanes::all(0.0);
  if (!m.any_pair && m.kernel.size() == N - 2) {
#pragma GCC unroll 4
    for (std::size_t s = 2; s < N; ++s) {
      const LaneKernel& k = m.kernel[s - 2];
      v += k.weight_real * state[s];
      slope[s] = f - k.rate_real * state[s];
    }
    return v;
  }
  std::size_t s = 2;
  for (const LaneKernel& k : m.kernel) {
    v += k.weight_real * state[s];
    slope[s] = f - k.rate_real * state[s];
    if (k.pair) {
      v -= k.weight_imaginary * state[s + 1];
      slope[s] += k.rate_imaginary * state[s + 1];
      slope[s + 1] = -k.rate_real * state[s + 1] - k.rate_imaginary * state[s];
      ++s;
    }
    ++s;
  }
  return v;
}

/// Slopes of [z, z', kernel states] under the base acceleration y.
template <std::size_t N>
[[gnu::always_inline]] inline void lane_slopes(const LaneModel& m, const std::array<Lanes, N>& state, const Lanes& y,
                                               std::array<Lanes, N>& slope) {
  const LaneForces force = lane_forces(m, state[0], state[1]);
  const Lanes v = kernel_slopes(m, state, force.forcing, slope);
  slope[0] = state[1];
  slope[1] = -(y + (force.plain + v) * m.mass_inverse);
}

}  // namespace pfdm
