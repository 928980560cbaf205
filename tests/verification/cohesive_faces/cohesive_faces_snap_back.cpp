// Cohesive faces whose blocks give way: a snap-back traced by dissipation control, a jump at the peak, and cells that
// can be damaged beside the face.

#include "tests/verification/cohesive_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm::verification::this_file {
namespace {

Mesh long_blocks(double length) {
  BoxHexesSettings box;
  box.axes[0] = {{2.0 * length, 8, 1.0}};
  box.axes[1] = box.axes[2] = {{0.2 * length, 2, 1.0}};
  return make_box_hexes(box);
}

FractureModel long_model(const Mesh& mesh, const InterfaceLaw& law, double length, double end) {
  FractureModel model = elastic_model({block}, {});
  glue(model, mesh, law, glued, Vector::UnitX(),
       [&](const Vector& x) { return std::abs(x.x() - length) < 1e-9 * length; });
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {true, true, true},
                          [end](const Vector&, double t) -> Vector { return t * end * Vector::UnitX(); })};
  return model;
}

// Blocks so long that the end moves back while the face softens, u = delta + 2 L T/E: the whole branch is traced.
TEST(LongBlocks, SnapBackAlongTheLaw) {
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  const double block_length = 3.0 * toughness / strength * 1e9 / strength;  // 2 L/E is three times the slope's inverse
  const Mesh mesh = long_blocks(block_length);
  const double compliance = 2.0 * block_length / 1e9, area = 0.04 * block_length * block_length;
  const double peak = compliance * strength + strength / stiffness;
  const FractureModel model = long_model(mesh, law, block_length, peak);
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-9},
                  {.end = 1.3,
                   .initial_increment = 0.1,
                   .maximum_increment = 0.1,
                   .maximum_dissipation = 0.05 * toughness * area,
                   .stops = {}});
  double worst = 0.0, furthest_back = 1.0, dissipated = 0.0;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    const OutputFields fields = run.output(state);
    const double opening = fields.interfaces[0].opening[0],
                 traction = report.reaction[mesh.patch_index("xmax")].x() / area;
    const double due = law.respond(glued, Vector::UnitX(), opening * Vector::UnitX(), {}).traction.x();
    worst = std::max(
        {worst, std::abs(traction - due) / strength, std::abs(state.load * peak - opening - compliance * due) / peak});
    if (report.energy.interface_dissipation > 0.0) furthest_back = std::min(furthest_back, state.load);
    dissipated = report.energy.interface_dissipation;
  });
  const double final_opening = 2.0 * toughness / strength;
  report_row("long blocks", {{"largest error of traction and displacement", worst},
                             {"least load on the way back", furthest_back},
                             {"closed form", final_opening / peak},
                             {"dissipated/Gc", dissipated / (toughness * area)}});
  EXPECT_LE(worst, 5e-10);
  EXPECT_NEAR(furthest_back, final_opening / peak, 0.06);
  EXPECT_NEAR(dissipated, toughness * area, 1e-9 * toughness * area);
}

// Loaded beyond its strength a face lets go at once. Increments by released energy find the peak.
TEST(LongBlocks, LetGoAtThePeakIfIncrementsFollowTheReleasedEnergy) {
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  const double block_length = 3.0 * toughness / strength * 1e9 / strength;
  const Mesh mesh = long_blocks(block_length);
  const double peak = 2.0 * block_length / 1e9 * strength + strength / stiffness;
  const FractureModel model = long_model(mesh, law, block_length, peak);
  const auto largest_traction = [&](double energy_release) {
    FractureRun run(mesh, model, {},
                    {.end = 1.2,
                     .initial_increment = 0.15,
                     .maximum_increment = 0.15,
                     .energy_release = energy_release,
                     .stops = {}});
    double largest = 0.0, last = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      last = report.reaction[mesh.patch_index("xmax")].x() / (0.04 * block_length * block_length);
      largest = std::max(largest, last);
    });
    EXPECT_NEAR(last, 0.0, 1e-6 * strength);
    return largest;
  };
  EXPECT_NEAR(largest_traction(std::numeric_limits<double>::infinity()), 0.9 * strength, 1e-3 * strength);
  EXPECT_NEAR(largest_traction(0.05), strength, 2e-3 * strength);
}

// Cells that can be damaged (AT1) and a face: the weaker one of the two breaks.
class DamageableBlocks : public testing::TestWithParam<std::string_view> {};

TEST_P(DamageableBlocks, BreakWhereTheyAreWeaker) {
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  // With the other splits a bar does not bear sixteen times its strength in one step, with a face or without.
  const double increment = GetParam() == "none" ? 0.1 : 0.02;
  for (const double tough : {100.0, 1.0}) {  // strengths by AT1: 13.7 and 1.37 MPa; that of the face is 2 MPa
    BoxHexesSettings box;
    box.axes[0] = {{2.0 * edge, 40, 1.0}};
    box.axes[1] = box.axes[2] = {{0.2 * edge, 2, 1.0}};
    const Mesh mesh = make_box_hexes(box);
    FractureModel model = glued_blocks(mesh, law);
    model.regions[0] = {.elasticity = block, .Gc = tough, .ell = 0.2 * edge, .damageable = true};
    model.crack = &crack_geometry("AT1");
    model.split = energy_split(GetParam());
    model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                      moved("xmax", {true, true, true}, [](const Vector&, double t) -> Vector {
                        return 1.1 * t * 2.0 * toughness / strength * Vector::UnitX();
                      })};
    FractureRun run(mesh, model, {},
                    {.end = 1.0, .initial_increment = increment, .maximum_increment = increment, .stops = {}});
    const double area = 0.04 * edge * edge;
    double most_damage = 0.0, dissipated = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      most_damage = report.max_damage;
      dissipated = report.energy.interface_dissipation;
    });
    report_row("damageable blocks",
               {{"Gc", tough}, {"largest damage", most_damage}, {"by the face", dissipated / (toughness * area)}});
    if (tough > 10.0) {
      EXPECT_LT(most_damage, 1e-12);
      EXPECT_NEAR(dissipated, toughness * area, 1e-9 * toughness * area);
    } else {
      EXPECT_GT(most_damage, 0.99);
      EXPECT_LT(dissipated, 1e-12 * toughness * area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Splits, DamageableBlocks, testing::Values("none", "spectral", "no_tension"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace pfdm::verification::this_file
