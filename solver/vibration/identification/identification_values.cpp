#include "solver/vibration/identification/identification_values.h"

#include "solver/vibration/identification/identification_conditioning.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace pfdm {

std::vector<Estimate> named_values(const MassMaterial& m) {
  std::vector<Estimate> values;
  const auto add = [&](std::string name, std::string unit, double value) {
    values.push_back(
        {.name = std::move(name), .unit = std::move(unit), .value = value, .lower = value, .upper = value});
  };
  for (std::size_t i = 0; i < m.stiffness.size(); ++i) {
    const std::string power = i == 0 ? "" : std::to_string(i + 1);
    add(fmt::format("k{}_N_per_m{}", i + 1, power), i == 0 ? "N/m" : "N/m^" + power, m.stiffness[i]);
  }
  add("c_N_s_per_m", "N s/m", m.damping);
  if (m.damping_exponent != 0.0) add("lambda", "1", m.damping_exponent);
  struct Unit {
    const char *in_name, *symbol;
  };
  const Unit unit = m.forcing == KernelForcing::displacement ? Unit{"N_per_m_s", "N/(m s)"}
                    : m.forcing == KernelForcing::stiffness  ? Unit{"per_s", "1/s"}
                                                             : Unit{"N_per_m", "N/m"};
  for (std::size_t i = 0; i < m.kernel.size(); ++i) {
    const auto [alpha, beta] = m.kernel[i];
    add(fmt::format("alpha{}_per_s", i + 1), "1/s", alpha.real());
    add(fmt::format("beta{}_{}", i + 1, unit.in_name), unit.symbol, beta.real());
    if (!m.kernel[i].is_pair()) continue;
    add(fmt::format("alpha{}_imaginary_per_s", i + 1), "1/s", alpha.imag());
    add(fmt::format("beta{}_imaginary_{}", i + 1, unit.in_name), unit.symbol, beta.imag());
  }
  return values;
}

PeakMotion peak_motion(const VibrationRecord& record) {
  const States states = integrate_states(record);
  const Eigen::Index n = states.velocity.size(), edge = n / 20;
  const auto peak = [&](const Eigen::VectorXd& x) { return x.segment(edge, n - 2 * edge).lpNorm<Eigen::Infinity>(); };
  return {.displacement = peak(states.displacement), .velocity = peak(states.velocity)};
}

ExcitedRange excited_range(std::span<const VibrationRecord> records) {
  ExcitedRange range{.low = std::numeric_limits<double>::infinity(), .high = 0.0, .velocity = 0.0, .displacement = 0.0};
  for (const VibrationRecord& r : records) {
    range.low = std::min(range.low, r.band_low);
    range.high = std::max(range.high, r.band_high);
    const PeakMotion peak = peak_motion(r);
    range.velocity = std::max(range.velocity, peak.velocity);
    range.displacement = std::max(range.displacement, peak.displacement);
  }
  return range;
}

Passivity passivity_in_band(const MassMaterial& model, std::span<const VibrationRecord> records) {
  const auto [low, high, velocity, displacement] = excited_range(records);
  return passivity(model, 2.0 * std::numbers::pi * low, 2.0 * std::numbers::pi * high, velocity);
}

}  // namespace pfdm
