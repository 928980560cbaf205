// Beams that are glued by cohesive faces, with a slit or a crack that is there already: peeled (double cantilever),
// sheared (end-notched flexure) and both (single-leg bending), against beams corrected for the rotation at the crack's
// tip. Plane strain, of width 1. Lengths and forces of arms of height h, crack a, half span L, E' = E/(1 - nu^2):
//
//   chi = sqrt(E'/(11 mu) (3 - 2 (Gamma/(1 + Gamma))^2)), Gamma = 1.18 E'/mu
//   peeled by P:   D = 8 P (a + chi h)^3 / (E' h^3),                             G = 12 P^2 (a + chi h)^2 / (E' h^3)
//   sheared by P:  D = P ((3 (a + 0.42 chi h)^3 + 2 L^3) / (8 E' h^3) + 3 L / (10 mu h)),
//                  G = 9 P^2 (a + 0.42 chi h)^2 / (16 E' h^3)
//
// Hashemi, Kinloch, Williams, Proc. R. Soc. A 427 (1990) 173; Wang, Williams, Compos. Sci. Technol. 43 (1992) 251. On
// one leg: both, peeled by P/4, so that G_I/G_II is about 4/3 (Davidson, Sundararaman, Int. J. Fract. 78 (1996) 193).
// Mixed-mode bending: a lever on the middle and on the upper arm's end, loaded by P at c beyond the middle, lifts the
// end by P c/L and presses on the middle by P (c + L)/L: peeled by P (3 c - L)/(4 L), sheared by P (c + L)/L (Reeder,
// Crews, AIAA J. 28 (1990) 1270).

#include "tests/verification/cohesive_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

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
Errors errors_of(const std::vector<std::pair<double, double>>& curve, const GrowingCrack& crack, double beyond) {
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

void report_and_expect(const char* what, const Errors& errors, double growing = 0.025) {
  report_row(what, {{"error of the stiffness", errors.stiffness},
                    {"of the peak", errors.peak},
                    {"largest while the crack grows", errors.growing}});
  EXPECT_NEAR(errors.stiffness, 0.0, 0.01);
  EXPECT_NEAR(errors.peak, 0.0, 0.03);
  EXPECT_NEAR(errors.growing, 0.0, growing);
}

const TractionSeparationLaw& linear() { return find_by_name(traction_separation_laws(), "linear", "law"); }

TEST(BeamsWithCohesiveFaces, PeelAsTheCorrectedBeam) {
  const CorrectedBeam beam;
  constexpr double width = 1e-3, h = CorrectedBeam::height, slit = 30e-3, Gc = 281.0;
  BoxHexesSettings box;
  box.axes[0] = {{29e-3, 55, 1.0}, {9e-3, 36, 1.0}, {22e-3, 15, 10.0}};
  box.axes[1] = {{2.0 * h, 12, 1.0}};
  box.axes[2] = {{width, 1, 1.0}};
  box.slits = {{.name = "slit", .lower = {-1.0, h, -1.0}, .upper = {slit, h, 1.0}}};
  box.patches = {{.name = "upper", .lower = {-1.0, h, -1.0}, .upper = {1e-9, 3.0 * h, 1.0}},
                 {.name = "lower", .lower = {-1.0, -h, -1.0}, .upper = {1e-9, h, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  const GrowingCrack crack{.from = slit,
                           .to = 38e-3,
                           .Gc = Gc,
                           .compliance = [&](double a) { return beam.peel_compliance(a); },
                           .release = [&](double a) { return beam.peel_release(a); }};
  const double end = 1.4 * crack.displacement(slit);
  FractureModel model =
      elastic_model({from_young_poisson(CorrectedBeam::E, CorrectedBeam::nu)}, {plane_on("zmin"), plane_on("zmax")});
  for (const double side : {1.0, -1.0})
    model.boundary.push_back(moved(side > 0.0 ? "upper" : "lower", {false, true, false},
                                   [=](const Vector&, double t) { return Vector(0.0, 0.5 * side * end * t, 0.0); }));
  model.boundary.push_back(displacement_on("xmax", [](const Vector&) -> Vector { return Vector::Zero(); }));
  glue(model, mesh, law_of(linear()), {.strength = 120e6, .toughness = Gc}, Vector::UnitY(),
       [&](const Vector& x) { return std::abs(x.y() - h) < 1e-9; });
  FractureRun run(mesh, model, {}, {.end = 1.0, .initial_increment = 0.04, .maximum_increment = 0.04, .stops = {}});
  EXPECT_TRUE(run.interface_warnings().empty());
  std::vector<std::pair<double, double>> curve;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    curve.emplace_back(end * state.load, report.reaction[mesh.patch_index("upper")].y() / width);
  });
  report_and_expect("double cantilever beam", errors_of(curve, crack, 1.2));
}

// Two arms of 2 mm on supports at x = 0 and 2 L, loaded at L; supports and loads on single faces of 0.5 mm, so that
// they hold no rotation. A step ends where the beam's crack begins to grow, at its peak. Faces of 0.2 mm from 27.75
// to 46.75 mm.
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

// The arms touch along the crack: an interface that has nearly no strength, and resists compression.
TEST(BeamsWithCohesiveFaces, ShearAsTheCorrectedBeam) {
  const CorrectedBeam beam;
  constexpr double h = CorrectedBeam::height, L = ThreePoints::half_span, from = 34.95e-3, Gc = 700.0;
  const Mesh mesh = make_box_hexes(ThreePoints::box());
  const GrowingCrack crack{.from = from,
                           .to = 46e-3,
                           .Gc = Gc,
                           .compliance = [&](double a) { return beam.shear_compliance(a, L); },
                           .release = [&](double a) { return beam.shear_release(a); }};
  const double end = crack.displacement(crack.to);
  FractureModel model = ThreePoints::model("left");
  model.boundary.push_back(
      moved("middle", {false, true, false}, [=](const Vector&, double t) { return Vector(0.0, -end * t, 0.0); }));
  const auto is_on = [&](const Vector& x) { return std::abs(x.y() - h) < 1e-9; };
  glue(model, mesh, law_of(linear()), {.strength = 250e6, .toughness = Gc}, Vector::UnitY(),
       [&](const Vector& x) { return is_on(x) && x.x() > from; });
  glue(model, mesh, law_of(linear()), {.strength = 1e3, .toughness = 1e-3}, Vector::UnitY(),
       [&](const Vector& x) { return is_on(x) && x.x() < from; });
  FractureRun run(
      mesh, model, {},
      {.end = 1.0, .initial_increment = 0.05, .maximum_increment = 0.05, .stops = {crack.displacement(from) / end}});
  std::vector<std::pair<double, double>> curve;
  double deepest = 0.0;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    curve.emplace_back(end * state.load, -report.reaction[mesh.patch_index("middle")].y() / ThreePoints::width);
    const OutputFields fields = run.output(state);
    for (const double opening : fields.interfaces[1].opening) deepest = std::min(deepest, opening);
  });
  EXPECT_LT(std::abs(deepest), 1e-3 * end);  // the arms do not pass through each other
  report_and_expect("end-notched flexure", errors_of(curve, crack, 1.02));
}

// Only the upper arm is on its support: a quarter of the load peels, all of it shears. With a toughness that depends on
// the mode.
TEST(BeamsWithCohesiveFaces, BendOnOneLegAsTheCorrectedBeam) {
  const CorrectedBeam beam;
  constexpr double h = CorrectedBeam::height, L = ThreePoints::half_span, from = 29.75e-3, strength_of_glue = 150e6;
  constexpr double peel_Gc = 281.0, shear_Gc = 700.0, eta = 2.0;
  const auto peel_release = [&](double a) { return beam.peel_release(a) / 16.0; };
  const auto release = [&](double a) { return peel_release(a) + beam.shear_release(a); };
  const auto toughness_at = [&](double a) {
    return peel_Gc + (shear_Gc - peel_Gc) * std::pow(beam.shear_release(a) / release(a), eta);
  };
  const GrowingCrack crack{
      .from = from,
      .to = 43e-3,
      .Gc = 1.0,
      .compliance = [&](double a) { return beam.peel_compliance(a) / 16.0 + beam.shear_compliance(a, L); },
      .release = [&](double a) { return release(a) / toughness_at(a); }};
  const double end = crack.displacement(crack.to);
  BoxHexesSettings box = ThreePoints::box();
  box.slits = {{.name = "slit", .lower = {-1.0, h, -1.0}, .upper = {from, h, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  FractureModel model = ThreePoints::model("lifted");
  model.boundary.push_back(
      moved("middle", {false, true, false}, [=](const Vector&, double t) { return Vector(0.0, -end * t, 0.0); }));
  InterfaceLaw law = law_of(linear(), "benzeggagh_kenane");
  law.exponent = eta;
  glue(model, mesh, law,
       {.strength = strength_of_glue,
        .toughness = peel_Gc,
        .shear_strength = strength_of_glue * std::sqrt(shear_Gc / peel_Gc),
        .shear_toughness = shear_Gc},
       Vector::UnitY(), [&](const Vector& x) { return std::abs(x.y() - h) < 1e-9; });
  FractureRun run(
      mesh, model, {},
      {.end = 1.0, .initial_increment = 0.05, .maximum_increment = 0.05, .stops = {crack.displacement(from) / end}});
  std::vector<std::pair<double, double>> curve;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    curve.emplace_back(end * state.load, -report.reaction[mesh.patch_index("middle")].y() / ThreePoints::width);
  });
  report_row("single-leg bending", {{"share of shear in G", beam.shear_release(from) / release(from)},
                                    {"toughness over that in opening", toughness_at(from) / peel_Gc}});
  report_and_expect("single-leg bending", errors_of(curve, crack, 1.1), 0.03);
}

// The beam under a lever that ends c beyond the middle, whose load is P.
struct MixedModeBending {
  static constexpr double L = ThreePoints::half_span, peel_Gc = 281.0, shear_Gc = 700.0, eta = 2.0;
  CorrectedBeam beam{};
  double c, from;

  double peel_share() const { return (3.0 * c - L) / (4.0 * L); }
  double shear_share() const { return (c + L) / L; }
  double peel_release(double a) const { return std::pow(peel_share(), 2) * beam.peel_release(a); }
  double shear_release(double a) const { return std::pow(shear_share(), 2) * beam.shear_release(a); }
  double shear_part(double a) const { return shear_release(a) / (peel_release(a) + shear_release(a)); }
  double load(double a) const {  // that lets the crack grow
    const double Gc = peel_Gc + (shear_Gc - peel_Gc) * std::pow(shear_part(a), eta);
    return std::sqrt(Gc / (peel_release(a) + shear_release(a)));
  }
  // Of the upper arm's end, upwards, and of the middle, downwards, over the load.
  double end_compliance(double a) const { return peel_share() * beam.peel_compliance(a); }
  double middle_compliance(double a) const {
    return shear_share() * beam.shear_compliance(a, L) - 0.25 * end_compliance(a);
  }
};

// The path of the lever's two points: to where the crack begins to grow at t = 1/2, then as the beam's crack grows by
// `growth`.
struct LeverPath {
  MixedModeBending test;
  double growth;

  double length(double t) const { return test.from + growth * std::max(0.0, 2.0 * t - 1.0); }
  double load(double t) const { return std::min(1.0, 2.0 * t) * test.load(length(t)); }
  double end(double t) const { return load(t) * test.end_compliance(length(t)); }
  double middle(double t) const { return load(t) * test.middle_compliance(length(t)); }
};

FractureModel glued_under_lever(const Mesh& mesh, const LeverPath& path) {
  constexpr double h = CorrectedBeam::height, glue_strength = 150e6;
  FractureModel model = ThreePoints::model("left");
  model.boundary.push_back(
      moved("lifted", {false, true, false}, [=](const Vector&, double t) { return Vector(0.0, path.end(t), 0.0); }));
  model.boundary.push_back(moved("middle", {false, true, false},
                                 [=](const Vector&, double t) { return Vector(0.0, -path.middle(t), 0.0); }));
  InterfaceLaw law = law_of(linear(), "benzeggagh_kenane");
  law.exponent = MixedModeBending::eta;
  const double ratio = MixedModeBending::shear_Gc / MixedModeBending::peel_Gc;
  glue(model, mesh, law,
       {.strength = glue_strength,
        .toughness = MixedModeBending::peel_Gc,
        .shear_strength = glue_strength * std::sqrt(ratio),
        .shear_toughness = MixedModeBending::shear_Gc},
       Vector::UnitY(), [&](const Vector& x) { return std::abs(x.y() - h) < 1e-9; });
  return model;
}

// The lever's two points move as under a lever on the corrected beam. Their forces must be those of the lever: c/(c +
// L) of each other, and so large. A lever in the mesh would need hinges.
void expect_mixed_mode_bending(const char* what, double c, double from) {
  constexpr double h = CorrectedBeam::height;
  const LeverPath path{.test = {.c = c, .from = from}, .growth = 8e-3};
  BoxHexesSettings box = ThreePoints::box();
  box.slits = {{.name = "slit", .lower = {-1.0, h, -1.0}, .upper = {from, h, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  FractureRun run(mesh, glued_under_lever(mesh, path), {},
                  {.end = 1.0, .initial_increment = 0.05, .maximum_increment = 0.05, .stops = {0.5}});
  Errors errors;
  double largest = 0.0, most_off_ratio = 0.0;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    const double t = state.load, L = ThreePoints::half_span;
    if (t < 0.1) return;
    const double lifted = report.reaction[mesh.patch_index("lifted")].y() / ThreePoints::width;
    const double pressed = -report.reaction[mesh.patch_index("middle")].y() / ThreePoints::width;
    const double P = pressed - lifted, error = P / path.load(t) - 1.0;
    if (t < 0.25) errors.stiffness = error;
    largest = std::max(largest, P);
    if (t > 0.6 && std::abs(error) > std::abs(errors.growing)) errors.growing = error;
    const double off = lifted / pressed * (c + L) / c - 1.0;
    if ((t < 0.25 || t > 0.6) && std::abs(off) > std::abs(most_off_ratio)) most_off_ratio = off;
  });
  errors.peak = largest / path.test.load(from) - 1.0;
  report_row(what, {{"share of shear in G", path.test.shear_part(from)},
                    {"largest error of the ratio of the lever's forces", most_off_ratio}});
  EXPECT_NEAR(most_off_ratio, 0.0, 0.03);
  report_and_expect(what, errors);
}

// 82 % of G at the beginning is shear; and 50 %.
TEST(BeamsWithCohesiveFaces, BendUnderALeverMostlyShearedAsTheCorrectedBeam) {
  expect_mixed_mode_bending("mixed-mode bending, 82 % shear", 27e-3, 33.75e-3);
}

TEST(BeamsWithCohesiveFaces, BendUnderALeverHalfShearedAsTheCorrectedBeam) {
  expect_mixed_mode_bending("mixed-mode bending, 50 % shear", 43e-3, 29.75e-3);
}

}  // namespace
}  // namespace pfdm::verification::this_file
