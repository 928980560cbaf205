// Nearly incompressible rubber between two bonded plates, nu = 0.4995. A disc, R = 12 mm, 3 mm thick: forces of
// quadratic elements (rubber_disc.py, 40 x 8 Taylor-Hood; 80 x 16: the same within 6e-5). Square pads, six times as
// wide as thick, of three kinds of cells.

#include "mesh/generators/cylinder_sector.h"
#include "tests/verification/finite.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

constexpr double radius = 12e-3, height = 3e-3, mu = 1e6, nu = 0.4995, azimuth = std::numbers::pi / 36.0;
const double area = 0.5 * std::sin(azimuth) * radius * radius;  // of the sector, whose rim is straight

Mesh disc(Index in_radius, Index in_height) {
  return make_cylinder_sector(
      {.azimuth = azimuth, .radius = {{radius, in_radius, 1.0}}, .height = {{height, in_height, 1.0}}});
}

struct Pulled {
  double mean_stress = 0.0, on_axis = 0.0;  // [mu]
  double energy_error = 0.0;                // of the work
  Index steps = 0;
};

constexpr IsotropicElasticity rubber{.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu};

Pulled pull(const Mesh& mesh, double rise, Index steps) {
  const FractureModel model =
      finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}),
                  {axisymmetric_on("front"), axisymmetric_on("back"),
                   displacement_on("bottom", [](const Vector&) -> Vector { return Vector::Zero(); }),
                   moved("top", {true, true, true},
                         [=](const Vector&, double t) -> Vector { return rise * t * Vector::UnitZ(); })});
  const Drawn drawn = draw(mesh, model, steps, 1e-6);
  Pulled pulled{.mean_stress = drawn.force(mesh, "top").z() / area / mu,
                .energy_error = drawn.report.energy.elastic / drawn.report.energy.external_work - 1.0,
                .steps = drawn.report.step};
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k) {
    const double q = drawn.state.displacement[unknowns.n_nodes() + k][0] / mu;
    if (std::abs(q) > std::abs(pulled.on_axis)) pulled.on_axis = q;
  }
  return pulled;
}

void report(const char* what, const Mesh& mesh, const Pulled& pulled, double exact) {
  report_row(fmt::format("{}, {} cells", what, mesh.n_cells()),
             {{"mean stress over mu", pulled.mean_stress},
              {"of quadratic elements, less 1", pulled.mean_stress / exact - 1.0},
              {"stress on the axis over mu", pulled.on_axis},
              {"stored over work, less 1", pulled.energy_error},
              {"steps", double(pulled.steps)}});
}

// Elements: 3.44541 mu, on the axis 7.14 mu. With pressures on two area vectors a face, and the cells' tangential
// derivatives on the plates, no step was found beyond 0.25 to 0.5 mm, the earlier the shorter the steps.
TEST(RubberDisc, IsPulledToItsEndInSmallSteps) {
  const Mesh mesh = disc(40, 8);
  const Pulled pulled = pull(mesh, 0.6e-3, 60);
  report("disc, 0.60 mm in steps of 10 um", mesh, pulled, 3.44541);
  EXPECT_EQ(pulled.steps, 60);
  EXPECT_NEAR(pulled.mean_stress / 3.44541, 1.0, 0.015);
  EXPECT_GT(pulled.on_axis, 7.0);
  EXPECT_LT(std::abs(pulled.energy_error), 0.005);
}

// Elements: 0.41291 mu at 0.05 mm, 2.09924 mu at 0.3 mm. The work of so long steps is not compared. Refined in the
// height alone, too.
TEST(RubberDisc, IsAsStiffWithLongSteps) {
  for (const Index in_height : {8, 16}) {
    const Mesh mesh = disc(40, in_height);
    const Pulled once = pull(mesh, 0.05e-3, 1), more = pull(mesh, 0.3e-3, 3);
    report("disc, 0.05 mm", mesh, once, 0.41291);
    report("disc, 0.30 mm in steps of 100 um", mesh, more, 2.09924);
    EXPECT_NEAR(once.mean_stress / 0.41291, 1.0, 0.025);
    EXPECT_NEAR(more.mean_stress / 2.09924, 1.0, 0.015);
  }
}

// Elements: -3.09563 mu at -10 %, where 13 % were missing with the cells' gradients on the plates.
TEST(RubberDisc, IsAsStiffInCompression) {
  const Mesh mesh = disc(40, 8);
  const Pulled pressed = pull(mesh, -0.3e-3, 12);
  report("disc, -10 %", mesh, pressed, -3.09563);
  EXPECT_NEAR(pressed.mean_stress / -3.09563, 1.0, 0.015);
  EXPECT_LT(std::abs(pressed.energy_error), 0.012);
}

// Elements: 25.5788 mu at a strain of 1e-5. With the cells' tangential derivatives on the plates -6.5, -4.5, -2.6 %.
// Refined in each direction alone, too.
TEST(RubberDisc, IsAsStiffAtSmallStrain) {
  for (const auto& [in_radius, in_height, tolerance] :
       {std::tuple{40, 8, 0.02}, {40, 16, 0.03}, {80, 8, 0.02}, {80, 16, 0.012}}) {
    const Mesh mesh = disc(in_radius, in_height);
    const auto solution = solve_elastic(
        mesh, elastic_model(
                  {rubber},
                  {axisymmetric_on("front"), axisymmetric_on("back"),
                   displacement_on("bottom", [](const Vector&) -> Vector { return Vector::Zero(); }),
                   displacement_on("top", [](const Vector&) -> Vector { return 1e-5 * height * Vector::UnitZ(); })}));
    const auto top = mesh.patch_index("top");
    const double modulus = reactions(mesh, *solution)[top].z() / area / mu / 1e-5;
    const double balance = energy_imbalance(mesh, *solution);
    report_row(fmt::format("disc at small strain, {} cells", mesh.n_cells()),
               {{"modulus over mu", modulus},
                {"of quadratic elements, less 1", modulus / 25.5788 - 1.0},
                {"stored over work, less 1", balance},
                {"Krylov iterations", double(solution->equilibrium.iterations)}});
    EXPECT_NEAR(modulus / 25.5788, 1.0, tolerance);
    EXPECT_LT(balance, 1e-9);
    EXPECT_LE(solution->equilibrium.iterations, 60);
  }
}

struct Pad {
  const char* cells;
  Mesh mesh;
};

// Height over half the width is 1/3.
std::vector<Pad> pads() {
  const auto flat = [](const Vector& s) -> Vector { return {s[0], s[1], s[2] / 3.0}; };
  return {{.cells = "hexahedra", .mesh = mapped_box({8, 8, 4}, flat)},
          {.cells = "prisms", .mesh = extruded_triangles(6, {0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25, 1.0 / 3.0})},
          {.cells = "tetrahedra", .mesh = mapped_box({5, 5, 3}, flat, BoxCells::tetrahedra)}};
}

// With the polygons of hexahedra on the free sides these hexahedra became unstable at 1.8 mu; with pressures on two
// areas a face none of the three got beyond 2.5 mu.
TEST(RubberPads, ArePulledTo40PercentWithHexahedraPrismsAndTetrahedra) {
  for (const Pad& pad : pads()) {
    const Mesh& mesh = pad.mesh;
    const FractureModel model =
        finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}),
                    {symmetry_on("xmin"), symmetry_on("ymin"),
                     displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                     moved("zmax", {true, true, true},
                           [](const Vector&, double t) -> Vector { return 0.4 / 3.0 * t * Vector::UnitZ(); })});
    const Drawn drawn = draw(mesh, model, 40, 1e-6);
    const double mean_stress = drawn.force(mesh, "zmax").z() / mu;
    const double balance = drawn.report.energy.elastic / drawn.report.energy.external_work - 1.0;
    report_row(fmt::format("pad of {} {}", mesh.n_cells(), pad.cells),
               {{"mean stress over mu", mean_stress},
                {"stored over work, less 1", balance},
                {"steps", double(drawn.report.step)},
                {"Krylov iterations", double(drawn.krylov_iterations)}});
    EXPECT_EQ(drawn.state.load, 1.0);
    EXPECT_NEAR(mean_stress, 3.1, 0.05 * 3.1);
    EXPECT_LT(std::abs(balance), 0.035);
  }
}

// A stretch of 1.9 with shear and rotation that leaves the volume but for 1e-3, on the whole surface.
Tensor affine(double t) {
  const Tensor H = (Tensor() << 1.0, 0.3, -0.2, 0.1, -0.3, 0.3, 0.25, -0.15, -0.2).finished();
  const Tensor F = Tensor::Identity() + t * H;
  return std::cbrt((1.0 + 1e-3 * t) / F.determinant()) * F - Tensor::Identity();
}

TEST(RubberBlocks, AffineMapsAreExactOnEveryKindOfCell) {
  const IsotropicElasticity block = from_young_poisson(1.5e6, 0.4995);
  const auto material = make_hyperelastic("neo_hookean", {.elasticity = block});
  const Mesh layered = sphere_in_cube(2, 3, 2.0, 0.8);
  for (const Mesh& mesh :
       {mapped_box({3, 3, 3}, [](const Vector& s) { return s; }), layered, barycentric_dual(layered)}) {
    std::vector<BoundaryCondition> boundary;
    for (const Patch& patch : mesh.patches)
      boundary.push_back(
          moved(patch.name, {true, true, true}, [](const Vector& x, double t) -> Vector { return affine(t) * x; }));
    const FractureModel model = finite_body(mesh, material, boundary);
    const Drawn drawn = draw(mesh, model, 4, 1e-11);
    const Tensor H = affine(1.0);
    const double exact = block.lambda * 1e-3 * (1.0 - 2.5 * block.mu / block.lambda);  // q, the share beyond 2.5 mu
    const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
    double u = 0.0, q = 0.0, volume = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      u = std::max(u, (drawn.state.displacement[c] - H * mesh.cell_centre[c]).norm());
      volume += mesh.cell_volume[c];
    }
    for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k)
      q = std::max(q, std::abs(drawn.state.displacement[unknowns.n_nodes() + k][0] / exact - 1.0));
    const double W = dynamic_cast<const HyperelasticMaterial&>(*material).potential(H).energy;
    const double energy = std::abs(drawn.report.energy.elastic / (W * volume) - 1.0);
    report_row(fmt::format("affine map, {} cells", mesh.n_cells()), {{"u", u}, {"pressure", q}, {"energy", energy}});
    EXPECT_LE(u, 1e-9);
    EXPECT_LE(q, 1e-7);
    EXPECT_LE(energy, 1e-8);
  }
}

// A block on rollers, the displacement across which varies along them so that the block turns: it has no stress.
TEST(RubberBlocks, TurnOnRollersThatTurn) {
  const IsotropicElasticity block = from_young_poisson(1.5e6, 0.4995);
  const auto material = make_hyperelastic("neo_hookean", {.elasticity = block});
  const auto turned = [](double t) -> Tensor {
    return Eigen::AngleAxisd(0.4 * t, Vector(1.0, -0.5, 2.0).normalized()).toRotationMatrix() - Tensor::Identity();
  };
  const Mesh layered = sphere_in_cube(2, 3, 2.0, 0.8);
  const auto as_is = [](const Vector& s) { return s; };
  for (const auto& [name, mesh] : {std::pair{"hexahedra", mapped_box({4, 3, 3}, as_is)},
                                   {"prisms", mapped_box({4, 3, 3}, as_is, BoxCells::prisms)},
                                   {"tetrahedra", mapped_box({2, 2, 2}, as_is, BoxCells::tetrahedra)},
                                   {"tetrahedra around prisms", layered},
                                   {"polyhedra", barycentric_dual(layered)}}) {
    std::vector<BoundaryCondition> boundary;
    for (const Patch& patch : mesh.patches) {
      const Index axis = patch.name.front() - 'x';
      boundary.push_back(moved(patch.name, {axis == 0, axis == 1, axis == 2}, [=](const Vector& x, double t) -> Vector {
        return (turned(t) * x)[axis] * Vector::Unit(axis);
      }));
    }
    const FractureModel model = finite_body(mesh, material, boundary);
    const Drawn drawn = draw(mesh, model, 4, 1e-11);
    const Tensor H = turned(1.0);
    double u = 0.0, q = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c)
      u = std::max(u, (drawn.state.displacement[c] - H * mesh.cell_centre[c]).norm());
    const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
    for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k)
      q = std::max(q, std::abs(drawn.state.displacement[unknowns.n_nodes() + k][0]) / block.mu);
    report_row(fmt::format("turned on rollers, {} {}", mesh.n_cells(), name), {{"u", u}, {"q / mu", q}});
    EXPECT_LE(u, 1e-9);
    EXPECT_LE(q, 1e-7);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
