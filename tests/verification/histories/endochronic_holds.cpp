// The endochronic law with a rate factor while strain or stress is held, against an independent integration.

#include "tests/physics/endochronic_laws.h"
#include "tests/solver/loadings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace pfdm::this_file {
namespace {

/// Two terms, a hardening f and a rate factor: at rest it bears less than under load.
EndochronicLaw creeping_law() {
  EndochronicLaw law = one_term_law();
  law.kernel = {{300e9, 15000.0}, {30e9, 1000.0}};
  law.hardening = {.with_path = saturating(1.4, 60.0), .with_rate = logarithmic_rate(0.1, 1e-4)};
  return law;
}

/// A part of a loading: until a time, with a constant rate of strain [1/s] or of stress [Pa/s]; then what is to be
/// found.
struct Held {
  double until, rate, strain, sigma, zeta;
};

/// Largest error of strain, stress and zeta over their largest values, so many steps a part.
double error_of_holds(std::span<const Held> parts, bool of_stress, int n) {
  std::vector<LoadSegment> segments;
  double from = 0.0, at = 0.0, largest = 0.0;
  for (const Held& part : parts) {
    const Path path = [=](double t) { return at + part.rate * t; };
    LoadSegment segment = tension_path(path, n, part.until - from);
    if (of_stress) segment.conditions[0].condition = on_stress(0);
    segments.push_back(std::move(segment));
    at += part.rate * (part.until - from);
    from = part.until;
  }
  const HistoryResult result = run_history(creeping_law(), segments);
  EXPECT_TRUE(result.converged) << result.failure;
  const auto off = [](double found, double expected, double scale) { return std::abs(found - expected) / scale; };
  for (std::size_t i = 0; i < std::min(parts.size(), (result.points.size() - 1) / static_cast<std::size_t>(n)); ++i) {
    const HistoryPoint& point = result.points[(i + 1) * static_cast<std::size_t>(n)];
    largest =
        std::max({largest, off(point.state.strain[0], parts[i].strain, parts.back().strain),
                  off(point.stress[0], parts[i].sigma, 2e8), off(point.state.zeta, parts[i].zeta, parts.back().zeta)});
  }
  return largest;
}

// The rate form of the law with the larger of its roots, E (eps' - p') = 3 sum C_r p' - sum alpha_r sigma_r zeta'/f,
// integrated with scipy's LSODA at a tolerance of 1e-9: loaded at 0.01 /s, held for 1000 s, loaded again at 1e-4 /s.
TEST(EndochronicPaths, RelaxationAtConstantStrain) {
  constexpr Held parts[] = {
      {1.0, 0.01, 0.01, 2.107992325e+08, 0.0100408224},    {2.0, 0.0, 0.01, 1.875211327e+08, 0.0102844953},
      {11.0, 0.0, 0.01, 1.837531707e+08, 0.0103239380},    {101.0, 0.0, 0.01, 1.837527231e+08, 0.0103239427},
      {1001.0, 0.0, 0.01, 1.837527231e+08, 0.0103239427},  {1011.0, 1e-4, 0.011, 1.677183003e+08, 0.0117165344},
      {1021.0, 1e-4, 0.012, 1.635160529e+08, 0.0129852680}};
  const double coarse = error_of_holds(parts, false, 100), middle = error_of_holds(parts, false, 400),
               fine = error_of_holds(parts, false, 1600);
  fmt::print("relaxation: {:.2g}, {:.2g}, {:.2g} with 100, 400, 1600 steps a part\n", coarse, middle, fine);
  EXPECT_LT(fine, 1e-6);
  EXPECT_LT(fine, 0.08 * middle);  // second order: 1/16
}

// Likewise: loaded at 140 MPa/s, and the stress held for 1000 s.
TEST(EndochronicPaths, CreepAtConstantStress) {
  constexpr Held parts[] = {{1.0, 140e6, 0.002500466653, 140e6, 0.0015969270},
                            {2.0, 0.0, 0.003096934676, 140e6, 0.0023274482},
                            {11.0, 0.0, 0.004172123007, 140e6, 0.0036442796},
                            {101.0, 0.0, 0.006567610339, 140e6, 0.0065781404},
                            {1001.0, 0.0, 0.007221928498, 140e6, 0.0073795132}};
  const double coarse = error_of_holds(parts, true, 100), middle = error_of_holds(parts, true, 400),
               fine = error_of_holds(parts, true, 1600);
  fmt::print("creep: {:.2g}, {:.2g}, {:.2g} with 100, 400, 1600 steps a part\n", coarse, middle, fine);
  EXPECT_LT(fine, 1e-6);
  EXPECT_LT(fine, 0.08 * middle);  // second order: 1/16
}

}  // namespace
}  // namespace pfdm::this_file
