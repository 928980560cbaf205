#pragma once
// Beams with a crack, corrected for the rotation at its tip: force and displacement as the crack grows.
// Plane strain, of width 1. Lengths and forces of arms of height h, crack a, half span L, E' = E/(1 - nu^2):
//
//   chi = sqrt(E'/(11 mu) (3 - 2 (Gamma/(1 + Gamma))^2)), Gamma = 1.18 E'/mu
//   peeled by P:   D = 8 P (a + chi h)^3 / (E' h^3),                             G = 12 P^2 (a + chi h)^2 / (E' h^3)
//   sheared by P:  D = P ((3 (a + 0.42 chi h)^3 + 2 L^3) / (8 E' h^3) + 3 L / (10 mu h)),
//                  G = 9 P^2 (a + 0.42 chi h)^2 / (16 E' h^3)
//
// Hashemi, Kinloch, Williams, Proc. R. Soc. A 427 (1990) 173; Wang, Williams, Compos. Sci. Technol. 43 (1992) 251. On
// one leg: both, peeled by P/4, so that G_I/G_II is about 4/3 (Davidson, Sundararaman, Int. J. Fract. 78 (1996) 193).

#include "tests/verification/cohesive_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace pfdm::verification {

struct CorrectedBeam {
  static constexpr double E = 126e9, nu = 0.3, height = 2e-3;
  double plane_modulus = E / (1.0 - nu * nu), shear = E / (2.0 * (1.0 + nu)), h3 = std::pow(height, 3), chi = 0.0;

  CorrectedBeam() {
    const double gamma = 1.18 * plane_modulus / shear;
    chi = std::sqrt(plane_modulus / (11.0 * shear) * (3.0 - 2.0 * std::pow(gamma / (1.0 + gamma), 2)));
  }
  double peeled_length(double a) const { return a + chi * height; }
  double sheared_length(double a) const { return a + 0.42 * chi * height; }
  double peel_compliance(double a) const { return 8.0 * std::pow(peeled_length(a), 3) / (plane_modulus * h3); }
  double shear_compliance(double a, double L) const {
    return (3.0 * std::pow(sheared_length(a), 3) + 2.0 * std::pow(L, 3)) / (8.0 * plane_modulus * h3) +
           3.0 * L / (10.0 * shear * height);
  }
  double peel_release(double a) const { return 12.0 * std::pow(peeled_length(a), 2) / (plane_modulus * h3); }
  double shear_release(double a) const { return 9.0 * std::pow(sheared_length(a), 2) / (16.0 * plane_modulus * h3); }
};

/// A crack that grows as the displacement does: force at a displacement. `compliance` and `release` (G over the force's
/// square) by the crack's length, which grows from `from` to `to`.
struct GrowingCrack {
  double from, to, Gc;
  std::function<double(double)> compliance, release;

  double force(double a) const { return std::sqrt(Gc / release(a)); }
  double displacement(double a) const { return force(a) * compliance(a); }
  /// Elastic, or at the length that this displacement has opened; the displacement grows with it.
  double force_at(double D) const {
    if (D <= displacement(from)) return D / compliance(from);
    double low = from, high = to;
    for (int i = 0; i < 60; ++i) (displacement(0.5 * (low + high)) < D ? low : high) = 0.5 * (low + high);
    return force(low);
  }
};

/// Largest differences of computed forces.
struct Errors {
  double stiffness = 0.0, peak = 0.0, growing = 0.0;
};

/// A curve of displacements and forces; the crack has left its beginning at `beyond` times its first displacement.
inline Errors errors_of(const std::vector<std::pair<double, double>>& curve, const GrowingCrack& crack, double beyond) {
  Errors errors;
  double largest = 0.0, due = 0.0;
  const double first = crack.displacement(crack.from), last = crack.displacement(crack.to);
  for (const auto& [D, force] : curve) {
    if (D <= 0.0 || D > last) continue;
    if (D < 0.5 * first) errors.stiffness = force / crack.force_at(D) - 1.0;
    largest = std::max(largest, force);
    due = std::max(due, crack.force_at(D));
    const double error = force / crack.force_at(D) - 1.0;
    if (D > beyond * first && std::abs(error) > std::abs(errors.growing)) errors.growing = error;
  }
  errors.peak = largest / std::max(due, crack.force(crack.from)) - 1.0;
  return errors;
}

inline void report_and_expect(const char* what, const Errors& errors, double growing = 0.025) {
  report_row(what, {{"error of the stiffness", errors.stiffness},
                    {"of the peak", errors.peak},
                    {"largest while the crack grows", errors.growing}});
  EXPECT_NEAR(errors.stiffness, 0.0, 0.01);
  EXPECT_NEAR(errors.peak, 0.0, 0.03);
  EXPECT_NEAR(errors.growing, 0.0, growing);
}

inline const TractionSeparationLaw& linear() { return find_by_name(traction_separation_laws(), "linear", "law"); }

/// Two arms of 2 mm on supports at x = 0 and 2 L, loaded at L; supports and loads on single faces of 0.5 mm, so that
/// they hold no rotation. A step ends where the beam's crack begins to grow, at its peak. Faces of 0.2 mm from 27.75
/// to 46.75 mm.
struct ThreePoints {
  static constexpr double half_span = 50e-3, width = 1e-3, h = CorrectedBeam::height;
  static BoxHexesSettings box() {
    BoxHexesSettings settings;
    settings.origin = {-0.25e-3, 0.0, 0.0};
    settings.axes[0] = {{28e-3, 56, 1.0}, {19e-3, 95, 1.0}, {53.5e-3, 107, 1.0}};
    settings.axes[1] = {{2.0 * h, 12, 1.0}};
    settings.axes[2] = {{width, 1, 1.0}};
    const auto face = [](double x, bool top) {
      const double y = top ? 2.0 * h : 0.0;
      return std::pair{Vector(x - 1e-4, y - 1e-9, -1.0), Vector(x + 1e-4, y + 1e-9, 1.0)};
    };
    for (const auto& [name, x, top] : {std::tuple{"left", 0.0, false}, std::tuple{"right", 2.0 * half_span, false},
                                       std::tuple{"middle", half_span, true}, std::tuple{"lifted", 0.0, true}}) {
      const auto [lower, upper] = face(x, top);
      settings.patches.push_back({.name = name, .lower = lower, .upper = upper});
    }
    return settings;
  }
  /// On the right and on a support of this name.
  static FractureModel model(const char* support) {
    const auto zero = [](const Vector&, double) -> Vector { return Vector::Zero(); };
    return elastic_model({from_young_poisson(CorrectedBeam::E, CorrectedBeam::nu)},
                         {plane_on("zmin"), plane_on("zmax"), moved(support, {false, true, false}, zero),
                          moved("right", {true, true, false}, zero)});
  }
};

}  // namespace pfdm::verification
