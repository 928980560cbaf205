#pragma once
// Profiles of localised damage in a bar, from the first integrals of the one-dimensional problem
// (literature.md 3.3, 3.4), with the stress and the separation that belong to them.

#include "tests/verification/bar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfdm::verification {

struct Profile {
  std::vector<double> x, d;  // x [ell] from the middle outwards
  double stress;             // [Pa]
  double separation;         // [m]
  double far_damage;

  double at(double distance) const {
    const auto above = std::upper_bound(x.begin(), x.end(), distance);
    if (above == x.end()) return far_damage;
    const auto i = static_cast<std::size_t>(above - x.begin());
    const double share = (distance - x[i - 1]) / (x[i] - x[i - 1]);
    return d[i - 1] + share * (d[i] - d[i - 1]);
  }
};

/// ell d' = -sqrt((1-s)(s-s*)(s + s*/(1+s*)))/s with s = 1 - d; s = s* + (1-s*) sin^2 p takes the roots out.
inline Profile at1_profile(double d_max) {
  const double least = 1.0 - d_max;
  const BarPoint point = at1_softening(Bar::E, Bar::Gc, Bar::ell, d_max);
  Profile profile{.x = {0.0}, .d = {d_max}, .stress = point.stress, .separation = point.separation, .far_damage = 0.0};
  constexpr int n = 20000;
  const double step = 0.5 * std::numbers::pi / n;
  for (int i = 0; i < n; ++i) {
    const auto s_at = [&](double p) { return least + (1.0 - least) * std::pow(std::sin(p), 2); };
    const double s = s_at((i + 0.5) * step);
    profile.x.push_back(profile.x.back() + step * 2.0 * s / std::sqrt(s + least / (1.0 + least)));
    profile.d.push_back(1.0 - s_at((i + 1) * step));
  }
  return profile;
}

/// ell d' = -((1-D)-s) sqrt((s-s*)(s-s2))/s, s* = D + sqrt D, s2 = D - sqrt D; s = s* + y^2 takes the root out, and
// y = y_max (1 - exp(-z)) the logarithm at the far end.
inline Profile at2_profile(double D) {
  const double least = D + std::sqrt(D), other = D - std::sqrt(D);
  const BarPoint point = at2_softening(Bar::E, Bar::Gc, Bar::ell, D);
  Profile profile{
      .x = {0.0}, .d = {1.0 - least}, .stress = point.stress, .separation = point.separation, .far_damage = D};
  const double y_max = std::sqrt(1.0 - D - least);
  constexpr int n = 40000;
  constexpr double step = 20.0 / n;
  for (int i = 0; i < n; ++i) {
    const double z = (i + 0.5) * step, y = y_max * (1.0 - std::exp(-z)), s = least + y * y;
    // 1 - D - s = (y_max - y)(y_max + y), y_max - y = y_max exp(-z) = dy/dz
    profile.x.push_back(profile.x.back() + step * 2.0 * s / ((y_max + y) * std::sqrt(s - other)));
    profile.d.push_back(1.0 - least - std::pow(y_max * (1.0 - std::exp(-(i + 1) * step)), 2));
  }
  return profile;
}

}  // namespace pfdm::verification
