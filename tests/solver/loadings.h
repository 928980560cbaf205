#pragma once
// Loadings of a material point for the tests.

#include <cmath>
#include <functional>

#include "solver/point/mixed_control.h"

namespace pfdm {

inline ControlCondition on_strain(int k) { return {Mandel::Zero(), Mandel::Unit(k) / mandel_factor(k)}; }
inline ControlCondition on_stress(int k) { return {Mandel::Unit(k) / mandel_factor(k), Mandel::Zero()}; }

using Path = std::function<double(double t)>;

/// n equal increments from time 0 to `end`; component k of the strain follows strain[k] where there is such a path, the
/// others are free of stress.
inline LoadSegment strain_paths(const std::array<Path, 6>& strain, int n, double end) {
  LoadSegment segment;
  for (int i = 0; i <= n; ++i) segment.times.push_back(end * i / n);
  for (int k = 0; k < n_components; ++k) {
    const Path& path = strain[k];
    auto& condition = segment.conditions[k];
    condition.condition = path ? on_strain(k) : on_stress(k);
    condition.pace = Pace::follow;
    for (const double t : segment.times) condition.values.push_back(path ? path(t) : 0.0);
  }
  return segment;
}

inline LoadSegment tension_path(const Path& strain, int n, double end = 1.0) {
  return strain_paths({strain, {}, {}, {}, {}, {}}, n, end);
}

}  // namespace pfdm
