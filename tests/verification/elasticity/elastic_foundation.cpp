// Bodies on elastic foundations (Winkler foundation; Hetenyi, Beams on elastic foundation, 1946): t = -K u on a
// surface.

#include "tests/verification/finite.h"

#include "physics/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

BoundaryCondition on_springs(const char* patch, double across, double along) {
  BoundaryCondition condition{.patch = patch, .kind = BoundaryCondition::Kind::elastic_foundation, .value = {}};
  condition.foundation = [=](const Vector&) { return FoundationStiffness{.across = across, .along = along}; };
  return condition;
}

Vector moved(const Mesh& mesh, const ElasticSolution& solution, const char* patch) {
  return solution.solver->balance().patch_displacements(solution.u)[mesh.patch_index(patch)];
}

Mesh box(const Vector& size, const std::array<Index, 3>& n, std::vector<SurfacePart> patches = {}) {
  return make_box_hexes({.axes = {{{{size[0], n[0], 1.0}}, {{size[1], n[1], 1.0}}, {{size[2], n[2], 1.0}}}},
                         .regions = {},
                         .slits = {},
                         .holes = {},
                         .patches = std::move(patches)});
}

// sigma/k_n at the foundation, and sigma x/E beyond it.
TEST(ElasticFoundation, CarriesABarAtItsEnd) {
  static constexpr double E = 210e9, nu = 0.3, k = 3e12, sigma = 80e6, L = 0.2;
  const Mesh mesh = box({L, 0.05, 0.03}, {5, 3, 2});
  const auto solution = solve_elastic(
      mesh,
      elastic_model({from_young_poisson(E, nu)},
                    {on_springs("xmin", k, 0.0), symmetry_on("ymin"), symmetry_on("zmin"),
                     traction_on("xmax", [](const Vector&) -> Vector { return sigma * Vector::UnitX(); })}),
      {}, 1e-13);
  const auto exact = [](const Vector& x) -> Vector {
    return Vector(sigma / k + sigma * x[0] / E, -nu * sigma * x[1] / E, -nu * sigma * x[2] / E);
  };
  const double error = displacement_error(mesh, *solution, exact);
  const Vector reaction = reactions(mesh, *solution)[mesh.patch_index("xmin")];
  report_row("bar", {{"error", error}, {"imbalance", reaction_imbalance(mesh, *solution)}});
  EXPECT_LT(error, 1e-10);
  EXPECT_NEAR(reaction.x(), -sigma * 0.05 * 0.03, 1e-10 * sigma * 0.05 * 0.03);
  EXPECT_LT(energy_imbalance(mesh, *solution), 1e-10);
}

// Every direction of a turned cube that springs hold on all sides: u is uniform under a body force, of the sum of the
// foundations.
TEST(ElasticFoundation, HoldsATurnedBodyByItsNormals) {
  constexpr double across = 4e9, along = 1e9;
  const Tensor turn = arbitrary_rotation();
  const Mesh mesh = rotated(box({1.0, 1.0, 1.0}, {2, 2, 2}), turn);
  FractureModel model = elastic_model({from_young_poisson(1e15, 0.3)}, {});
  for (const char* patch : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
    model.boundary.push_back(on_springs(patch, across, along));
  const Vector force = turn * Vector(1e6, -2e6, 3e6);
  const auto solution = solve_elastic(mesh, model, {}, 1e-13, [&](const Vector&) { return force; });
  const Vector expected = force / (2.0 * across + 4.0 * along);
  for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_LT((solution->u[c] - expected).norm(), 2e-5 * expected.norm());
}

// A stiff block under a pressure p_0 + p_1 x: the springs under it bear the same pressure, so that it settles by p_0/k
// and turns by p_1/k, which is M/(k I).
TEST(ElasticFoundation, TurnsAStiffBlock) {
  static constexpr double k = 1e8, p_0 = 1e5, p_1 = 2e5;
  for (const std::array<Index, 3> n : {std::array<Index, 3>{2, 2, 2}, {7, 2, 2}, {2, 7, 2}, {2, 2, 7}}) {
    const Mesh mesh = box({1.0, 0.4, 0.5}, n);
    const auto solution = solve_elastic(
        mesh,
        elastic_model(
            {from_young_poisson(1e13, 0.2)},
            {on_springs("ymin", k, 0.3 * k),
             traction_on("ymax", [](const Vector& x) -> Vector { return Vector(0.0, -p_0 - p_1 * x[0], 0.0); })}),
        {}, 1e-10);
    const auto exact = [](const Vector& x) -> Vector { return Vector(p_1 / k * x[1], -(p_0 + p_1 * x[0]) / k, 0.0); };
    const double error = displacement_error(mesh, *solution, exact);
    report_row(std::to_string(mesh.n_cells()), {{"error", error}});
    EXPECT_TRUE(solution->equilibrium.converged);
    EXPECT_LT(error, 1e-5);
  }
}

// Half of a long beam, pressed at its middle over 2 a: w = q/k (1 - exp(-lambda a) cos(lambda a)) of Hetenyi, times
// what the shear of the beam adds to the deflection under a point force,
//
//   w_0 = P/(2 EI) (1/sqrt(c) + r)/sqrt(2 sqrt(c) + a_s),  c = k b/EI, r = EI/(kappa G A), a_s = k b/(kappa G A).
struct WinklerBeam {
  double E = 70e9, nu = 0.3, h = 0.01, k = 0.0, q = 1e6, a = 0.005;
  double lambda_h = 0.15;

  double EI() const { return E * h * h * h / 12.0; }  // per width
  double stiffness() const { return 4.0 * EI() * std::pow(lambda_h / h, 4); }
  double length() const { return 2.0 * std::numbers::pi / (lambda_h / h); }
  double deflection() const {
    const double c = stiffness() / EI(), G = E / (2.0 * (1.0 + nu)), kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    const double r = EI() / (kappa * G * h), sheared = stiffness() / (kappa * G * h), s = std::sqrt(c);
    const double more = (1.0 + r * s) / std::sqrt(1.0 + sheared / (2.0 * s));
    const double la = lambda_h * a / h;
    return q / stiffness() * (1.0 - std::exp(-la) * std::cos(la)) * more;
  }
};

// Deflection of the section at the middle, over the closed form.
double pressed(const WinklerBeam& beam, Index n_x, Index n_y) {
  const Index at_load = 2;
  const Mesh mesh = make_box_hexes(
      {.axes = {{{{beam.a, at_load, 1.0}, {beam.length() - beam.a, n_x, 6.0}}, {{beam.h, n_y, 1.0}}, {{0.01, 1, 1.0}}}},
       .regions = {},
       .slits = {},
       .holes = {},
       .patches = {{"load", {0.0, beam.h, 0.0}, {beam.a, beam.h, 0.01}}}});
  const auto solution = solve_elastic(
      mesh, elastic_model({from_young_poisson(beam.E, beam.nu)},
                          {plane_stress_on("zmin"), plane_stress_on("zmax"), symmetry_on("xmin"),
                           on_springs("ymin", beam.stiffness(), 0.0),
                           traction_on("load", [&](const Vector&) -> Vector { return -beam.q * Vector::UnitY(); })}));
  EXPECT_LT(energy_imbalance(mesh, *solution), 1e-8);
  EXPECT_LT(reaction_imbalance(mesh, *solution), 1e-8);
  return -moved(mesh, *solution, "xmin").y() / beam.deflection();
}

TEST(ElasticFoundation, BearsABeamAsHetenyiSays) {
  const WinklerBeam beam;
  std::vector<double> along, across;
  for (const Index n : {12, 24, 48}) along.push_back(pressed(beam, n, 4));
  for (const Index n : {2, 4, 8}) across.push_back(pressed(beam, 24, n));
  report_row("cells along the beam", {{"12", along[0]}, {"24", along[1]}, {"48", along[2]}});
  report_row("layers", {{"2", across[0]}, {"4", across[1]}, {"8", across[2]}});
  for (const double over : along) EXPECT_NEAR(over, 1.0, 0.02);
  for (const double over : across) EXPECT_NEAR(over, 1.0, 0.02);
}

// At finite strain the foundation moves by P/k_n, and what it carries as one that is held; the account closes.
TEST(ElasticFoundation, CarriesABarOfRubberAtItsEnd) {
  static constexpr double mu = 1e6, k = 4e7, P = 1.5e6;
  const Mesh mesh = mapped_box({4, 2, 2}, [](const Vector& x) { return x; });
  const auto material = make_hyperelastic("neo_hookean", {.elasticity = {.lambda = 4.0 * mu, .mu = mu}});
  const auto pulled = [&](const BoundaryCondition& end) {
    BoundaryCondition load{.patch = "xmax", .value = {}};
    load.value = [](const Vector&, double t) -> Vector { return t * P * Vector::UnitX(); };
    return draw(mesh, finite_body(mesh, material, {end, symmetry_on("ymin"), symmetry_on("zmin"), load}), 4, 1e-11);
  };
  const Drawn springs = pulled(on_springs("xmin", k, 0.0)), held = pulled(symmetry_on("xmin"));
  double error = 0.0, stretch = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector &a = springs.state.displacement[c], &b = held.state.displacement[c];
    error = std::max(error, (a - b - P / k * Vector::UnitX()).norm());
    stretch = std::max(stretch, b.x());
  }
  const double stored = springs.state.energy.elastic - held.state.energy.elastic;
  report_row("rubber", {{"largest displacement", stretch}, {"error", error}});
  EXPECT_GT(stretch, 0.3);
  EXPECT_LT(error, 1e-8);
  EXPECT_NEAR(springs.force(mesh, "xmin").x(), -P, 1e-8 * P);
  EXPECT_NEAR(stored, 0.0, 1e-8 * held.state.energy.elastic);
  // The springs' energy P^2/(2 k) is no part of the work on the body.
  EXPECT_NEAR(springs.state.energy.external_work, held.state.energy.external_work,
              1e-8 * held.state.energy.external_work);
}

TEST(ElasticFoundation, HoldsABodyInTheDirectionsInWhichItIsStiff) {
  const Mesh mesh = box({1.0, 1.0, 1.0}, {2, 2, 2});
  const auto place = [&](std::vector<BoundaryCondition> boundary) {
    return place_unknowns(mesh, elastic_body(elastic_model({from_young_poisson(1e9, 0.3)}, std::move(boundary))));
  };
  EXPECT_NO_THROW(place({on_springs("xmin", 1e9, 1e9)}));
  EXPECT_NO_THROW(place({on_springs("xmin", 1e9, 0.0), on_springs("ymin", 1e9, 0.0), on_springs("zmin", 1e9, 0.0)}));
  EXPECT_THROW(place({on_springs("xmin", 1e9, 0.0)}), InputError);
  EXPECT_THROW(place({on_springs("xmin", 1e9, 0.0), on_springs("ymin", 1e9, 0.0)}), InputError);
}

}  // namespace
}  // namespace pfdm::verification::this_file
