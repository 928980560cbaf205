// Beams that are glued by cohesive faces, with a slit or a crack that is there already: peeled (double cantilever),
// sheared (end-notched flexure) and both (single-leg bending), against beams corrected for the rotation at the crack's
// tip (corrected_beams.h).

#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/corrected_beams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

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

}  // namespace
}  // namespace pfdm::verification::this_file
