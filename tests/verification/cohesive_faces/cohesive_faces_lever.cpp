// Glued beams under a lever, against corrected beams (corrected_beams.h).
// Mixed-mode bending: a lever on the middle and on the upper arm's end, loaded by P at c beyond the middle, lifts the
// end by P c/L and presses on the middle by P (c + L)/L: peeled by P (3 c - L)/(4 L), sheared by P (c + L)/L (Reeder,
// Crews, AIAA J. 28 (1990) 1270).

#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/corrected_beams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

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
