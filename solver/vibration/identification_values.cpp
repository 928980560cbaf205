// named_values and peak_motion of identification.h.

#include "solver/vibration/identification.h"
#include "solver/vibration/identification_conditioning.h"

#include <fmt/format.h>

namespace pfdm {

std::vector<Estimate> named_values(const MassMaterial& m) {
  std::vector<Estimate> values;
  const auto add = [&](std::string name, double value) { values.push_back({std::move(name), value, value, value}); };
  for (std::size_t i = 0; i < m.stiffness.size(); ++i)
    add(fmt::format("k{}_N_per_m{}", i + 1, i == 0 ? "" : std::to_string(i + 1)), m.stiffness[i]);
  add("c_N_s_per_m", m.damping);
  if (m.damping_exponent != 0.0) add("lambda", m.damping_exponent);
  const char* unit = m.forcing == KernelForcing::displacement ? "N_per_m_s"
                     : m.forcing == KernelForcing::stiffness  ? "per_s"
                                                              : "N_per_m";
  for (std::size_t i = 0; i < m.kernel.size(); ++i) {
    add(fmt::format("alpha{}_per_s", i + 1), m.kernel[i].alpha.real());
    add(fmt::format("beta{}_{}", i + 1, unit), m.kernel[i].beta.real());
    if (!m.kernel[i].is_pair()) continue;
    add(fmt::format("alpha{}_imaginary_per_s", i + 1), m.kernel[i].alpha.imag());
    add(fmt::format("beta{}_imaginary_{}", i + 1, unit), m.kernel[i].beta.imag());
  }
  return values;
}

PeakMotion peak_motion(const VibrationRecord& record) {
  const States states = integrate_states(record);
  const Eigen::Index n = states.velocity.size(), edge = n / 20;
  const auto peak = [&](const Eigen::VectorXd& x) { return x.segment(edge, n - 2 * edge).lpNorm<Eigen::Infinity>(); };
  return {.displacement = peak(states.displacement), .velocity = peak(states.velocity)};
}

}  // namespace pfdm
