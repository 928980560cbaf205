// The bimetal strip of Timoshenko (J. Opt. Soc. Am. 11 (1925) 233), of few and many, short and long cells.

#include "mesh/generators/sphere_sector.h"
#include "physics/materials/hyperelastic.h"
#include "solver/fracture/words/bending_words.h"
#include "tests/verification/bar.h"
#include "tests/verification/layers/eigenstrain_bodies.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

struct Strip {
  double curvature = 0.0, exact = 0.0;
};

enum class StripIn { plane_stress, space, finite };

struct StripOf {
  Index along = 0;
  std::array<Index, 2> layers{4, 6};  // of the lower and the upper material
  double E_lower = 200e9, E_upper = 90e9;
  StripIn in = StripIn::plane_stress;
};

// Of two layers, 0.4 and 0.6 of the height; plane stress, or half of a narrow strip in space. The last cells at its
// ends do not count. `warning`: what is said of it.
Strip bend_by_heat(const StripOf& of, std::string* warning = nullptr) {
  constexpr double length = 12.0, alpha_lower = 12e-6, alpha_upper = 30e-6;
  constexpr double lower = 0.4, upper = 0.6, dT = 1.0;
  const StripIn in = of.in;
  const IsotropicElasticity steel = from_young_poisson(of.E_lower, 0.3), zinc = from_young_poisson(of.E_upper, 0.3);
  BoxHexesSettings box;
  box.axes[0] = {{length, of.along, 1.0}};
  box.axes[1] = {{lower, of.layers[0], 1.0}, {upper, of.layers[1], 1.0}};
  box.axes[2] = {{0.2, 1, 1.0}};
  box.regions = {{.name = "upper", .lower = {-1.0, lower, -1.0}, .upper = {length + 1.0, 2.0, 1.0}}};
  box.patches = {{"pin", {-1e-9, -1e-9, -1.0}, {1e-9, lower / static_cast<double>(of.layers[0]) + 1e-9, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  std::vector<BoundaryCondition> boundary{
      symmetry_on("xmin"),
      moved("pin", {true, true, in != StripIn::space}, [](const Vector&, double) -> Vector { return Vector::Zero(); })};
  if (in == StripIn::space)
    boundary.push_back(symmetry_on("zmin"));
  else
    boundary.insert(boundary.end(), {plane_stress_on("zmin"), plane_stress_on("zmax")});
  FractureModel model = elastic_model({steel, zinc}, std::move(boundary));
  if (in == StripIn::finite)
    for (RegionModel& region : model.regions)
      region.material = make_hyperelastic("neo_hookean", {.elasticity = region.elasticity});
  model.regions[0].expansion = alpha_lower * Tensor::Identity();
  model.regions[1].expansion = alpha_upper * Tensor::Identity();
  model.loads.temperature = [](const Vector&, double t) { return t * dT; };
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10},
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  const FractureState state = run_to_end(run, [](const FractureState&, const StepReport&) {});
  const OutputFields fields = run.output(state);
  // Slope of eps_xx over y by least squares, in the columns at mid-span.
  double sy = 0.0, se = 0.0, syy = 0.0, sye = 0.0, n = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    if (std::abs(x[0] - 0.5 * length) > 0.1 * length) continue;
    const double e = fields.strain[c](0, 0);
    sy += x[1], se += e, syy += x[1] * x[1], sye += x[1] * e, n += 1.0;
  }
  if (warning != nullptr) *warning = bending_warning(mesh, model).value_or("");
  const double m = lower / upper,
               ratio = of.E_lower / of.E_upper;  // Timoshenko's m and n, of the lower to the upper layer
  const double exact =
      6.0 * (alpha_upper - alpha_lower) * dT * (1.0 + m) * (1.0 + m) /
      ((lower + upper) * (3.0 * (1.0 + m) * (1.0 + m) + (1.0 + m * ratio) * (m * m + 1.0 / (m * ratio))));
  return {(n * sye - sy * se) / (n * syy - sy * sy), exact};
}

// What the layers exchange near the free end decides, within a length of the thickness.
TEST(Eigenstrains, BimetalStripBendsAsTimoshenkosDoes) {
  std::vector<double> errors;
  for (const Index along : {20, 60, 120}) {
    const Strip strip = bend_by_heat({.along = along, .layers = {2, 3}});
    report_row(fmt::format("{} x 5 cells", along), {{"curvature over Timoshenko's", strip.curvature / strip.exact}});
    errors.push_back(std::abs(strip.curvature / strip.exact - 1.0));
  }
  EXPECT_LT(errors[1], 0.02);
  EXPECT_LT(errors[2], 0.01);
}

// Gradients are those along lines of cells.
TEST(Eigenstrains, BimetalStripsOfFewOrLongCellsBendAsTimoshenkosDoes) {
  for (const StripIn in : {StripIn::plane_stress, StripIn::space, StripIn::finite})
    for (const Index along : {60, 30, 15}) {
      const Strip strip = bend_by_heat({.along = along, .in = in});
      report_row(fmt::format("{} x 10 cells, {}", along,
                             in == StripIn::space ? "in space" : (in == StripIn::finite ? "finite strain" : "plane")),
                 {{"curvature over Timoshenko's", strip.curvature / strip.exact}});
      EXPECT_NEAR(strip.curvature / strip.exact, 1.0, 0.03);
    }
}

// Fits to smooth fields, which plane bodies without eigenstrains have, bend the last four by 0.76 to 0.91 in 15 cells
// along. With a tenth of the stiffness in one material the forces are exchanged over several cells of it.
TEST(Eigenstrains, PlaneStripsOfFewLayersBendAsTimoshenkosDo) {
  for (const auto& [layers, E_lower, E_upper, bound] : {std::tuple{std::array<Index, 2>{2, 2}, 200e9, 90e9, 0.03},
                                                        {{3, 3}, 200e9, 200e9, 0.03},
                                                        {{2, 6}, 200e9, 90e9, 0.03},
                                                        {{3, 3}, 50e9, 200e9, 0.045},
                                                        {{4, 6}, 200e9, 20e9, 0.035},
                                                        {{2, 3}, 20e9, 200e9, 0.06}})
    for (const Index along : {60, 15}) {
      std::string warning;
      const Strip strip =
          bend_by_heat({.along = along, .layers = layers, .E_lower = E_lower, .E_upper = E_upper}, &warning);
      report_row(
          fmt::format("{} x {} + {} cells, {} to {} GPa", along, layers[0], layers[1], E_lower / 1e9, E_upper / 1e9),
          {{"curvature over Timoshenko's", strip.curvature / strip.exact}});
      EXPECT_NEAR(strip.curvature / strip.exact, 1.0, bound);
      EXPECT_EQ(warning, "");
    }
}

// A material of one cell bends within the cell, which its gradient does not see. Both have a quarter of the bending
// stiffness about their own middles.
TEST(Eigenstrains, PlaneStripsOfOneCellAMaterialAreWarnedOf) {
  std::string warning;
  const Strip strip = bend_by_heat({.along = 60, .layers = {1, 1}}, &warning);
  const double excess = strip.curvature / strip.exact - 1.0;
  report_row("60 x 1 + 1 cells", {{"curvature over Timoshenko's, less 1", excess}});
  EXPECT_NEAR(1.0 - 1.0 / (1.0 + excess), 0.65 * 0.25, 0.06);
  EXPECT_NE(warning.find("their stiffness is about 16 % too low (materials of one cell across have 25 % of it about"),
            std::string::npos)
      << warning;
}

}  // namespace
}  // namespace pfdm::verification::this_file
