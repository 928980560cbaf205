// Discs, a ring and a tube about an axis, of few or long cells, against quadratic elements about the axis (64 x 14, a
// modulus of 1 Pa, tractions of 1 Pa; 32 x 8 differ by at most 0.05 %).

#include "mesh/generators/cylinder_sector.h"
#include "solver/fracture/words/bending_words.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

constexpr double mm = 1e-3, thickness = 1.5 * mm;

struct Body {
  std::string name;
  double inner = 0.0, outer = 25.0 * mm, height = thickness;  // [m]
  std::string held{};
  std::array<bool, 3> how{true, true, true};
  std::string loaded{};
  Vector traction = Vector::Zero();
  std::array<double, 3> moved{};  // mean displacement of the loaded patch along the traction, nu = 0, 0.3, 0.45 [mm]
};

const std::vector<Body> bodies = {
    {.name = "clamped disc",
     .held = "outer",
     .loaded = "top",
     .traction = -Vector::UnitZ(),
     .moved = {7358.8, 6716.3, 5871.0}},
    {.name = "disc on a support",
     .held = "outer",
     .how = {false, false, true},
     .loaded = "top",
     .traction = -Vector::UnitZ(),
     .moved = {50762.0, 37047.0, 29701.0}},
    {.name = "ring",
     .inner = 5.0 * mm,
     .held = "inner",
     .loaded = "outer",
     .traction = -Vector::UnitZ(),
     .moved = {20018.0, 15373.0, 12561.0}},
    {.name = "tube",
     .inner = 20.0 * mm,
     .outer = 21.5 * mm,
     .height = 25.0 * mm,
     .held = "bottom",
     .loaded = "inner",
     .traction = Vector::UnitX(),
     .moved = {231.81, 236.31, 237.44}},
};

Mesh mesh_of(const Body& body, Index along, Index across) {
  const bool is_tube = body.height > body.outer - body.inner;
  return make_cylinder_sector({.azimuth = 0.05,
                               .inner_radius = body.inner,
                               .radius = {{body.outer - body.inner, is_tube ? across : along, 1.0}},
                               .height = {{body.height, is_tube ? along : across, 1.0}}});
}

std::vector<BoundaryCondition> conditions(const Body& body) {
  return {axisymmetric_on("front"), axisymmetric_on("back"),
          moved(body.held, body.how, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
          traction_on(body.loaded, [t = body.traction](const Vector&) -> Vector { return t; })};
}

// With gradients of one ring the clamped disc moved by 0.67 (12 x 4 cells) to 1.29 (25 x 2) of this.
TEST(DiscsAndTubes, BendAsElementsWhateverTheirCells) {
  constexpr std::array nu = {0.0, 0.3, 0.45};
  for (const Body& body : bodies)
    for (std::size_t k = 0; k < nu.size(); ++k)
      for (const auto& [along, across] : {std::pair{12, 4}, {25, 2}, {25, 4}, {50, 4}, {50, 6}, {100, 8}}) {
        const Mesh mesh = mesh_of(body, along, across);
        const FractureModel model = elastic_model({from_young_poisson(1.0, nu[k])}, conditions(body));
        const auto solution = solve_elastic(mesh, model, {}, 1e-8);
        EXPECT_TRUE(solution->equilibrium.converged);
        EXPECT_LT(energy_imbalance(mesh, *solution), 1e-5);
        const Vector mean = solution->solver->balance().patch_displacements(solution->u)[mesh.patch_index(body.loaded)];
        const double error = mean.dot(body.traction) / (body.moved[k] * mm) - 1.0;
        report_row(
            fmt::format("{}, nu {}, {} x {} cells", body.name, nu[k], along, across),
            {{"displacement, less 1", error}, {"iterations", static_cast<double>(solution->equilibrium.iterations)}});
        EXPECT_LT(std::abs(error), 0.03);
        EXPECT_LT(solution->equilibrium.iterations, 300);
        const bool is_long = along == 12 && nu[k] > 0.4 && body.name != "ring";  // warned of 3 %
        EXPECT_EQ(bending_warning(mesh, model).has_value(), is_long);
      }
}

// Stresses that are functions of the strain: the split does nothing without damage.
TEST(DiscsAndTubes, BendAsElementsByASplit) {
  for (const Body& body : bodies) {
    const Mesh mesh = mesh_of(body, 25, 4);
    FractureModel model = elastic_model({from_young_poisson(1.0, 0.3)}, conditions(body));
    model.split = energy_split("spectral");
    const double error =
        displacements_by_laws(mesh, model)[mesh.patch_index(body.loaded)].dot(body.traction) / (body.moved[1] * mm) -
        1.0;
    report_row(body.name + " by the spectral split", {{"displacement, less 1", error}});
    EXPECT_LT(std::abs(error), 0.03);
    EXPECT_FALSE(bending_warning(mesh, model).has_value());
  }
}

// A single cell across has gradients of one ring. What is said holds the error, of whatever sign.
TEST(DiscsAndTubes, OfASingleLayerAreWarnedOfByBothErrors) {
  const Mesh mesh = mesh_of(bodies.front(), 25, 1);
  const FractureModel model = elastic_model({from_young_poisson(1.0, 0.3)}, conditions(bodies.front()));
  const auto warning = bending_warning(mesh, model);
  ASSERT_TRUE(warning.has_value());
  EXPECT_NE(warning->find("their stiffness is up to 100 % too low (one cell across; 100 % too low by the number of "
                          "layers, 45 % too high by long cells"),
            std::string::npos)
      << *warning;
}

}  // namespace
}  // namespace pfdm::verification::this_file
