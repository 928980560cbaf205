// The damage equation where its solution is known, its bounds, and that it is the minimum of its energy.

#include "solver/fracture/damage/damage_equation.h"
#include "tests/solver/damaged_rows.h"
#include "tests/solver/solver_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

namespace pfdm::this_file {
namespace {

TEST(DamageEquation, HomogeneousResponseOfAt2) {
  const Mesh mesh = box(4, 3, 3, Vector::Constant(1e-4));
  const FractureModel model = model_of(mesh, "AT2");
  DamageEquation equation(mesh, model, Vector::Zero());
  for (const double psi : {0.0, 0.01 * unit, 0.5 * unit, 40.0 * unit}) {
    CellField<double> d = uniform(mesh, 0.0);
    EXPECT_TRUE(equation.solve(uniform(mesh, psi), uniform(mesh, 0.0), {}, d).converged);
    const double driving = (1.0 - model.residual_stiffness) * psi;
    for (const double value : d) EXPECT_NEAR(value, driving / (driving + 0.5 * unit), 1e-9) << psi;
  }
}

TEST(DamageEquation, HomogeneousResponseOfAt1HasAThreshold) {
  const Mesh mesh = box(4, 3, 3, Vector::Constant(1e-4));
  const FractureModel model = model_of(mesh, "AT1");
  DamageEquation equation(mesh, model, Vector::Zero());
  const double threshold = 3.0 / 16.0 * unit;  // sigma^2 / (2 E) at sigma = sqrt(3 E Gc / (8 ell))
  for (const double share : {0.0, 0.5, 0.999, 1.01, 2.0, 100.0}) {
    CellField<double> d = uniform(mesh, 0.0);
    const double psi = share * threshold / (1.0 - model.residual_stiffness);
    EXPECT_TRUE(equation.solve(uniform(mesh, psi), uniform(mesh, 0.0), {}, d).converged);
    for (const double value : d) EXPECT_NEAR(value, share > 1.0 ? 1.0 - 1.0 / share : 0.0, 1e-9) << share;
  }
}

// psi falls by a factor of 100 at d = 0.9: there Newton's steps go to and fro between the steep part of the slope and
// the flat ones on both sides. The field is uniform, the oracle a bisection.
TEST(DamageEquation, ADrivingEnergyThatFallsWithTheDamage) {
  const Mesh mesh = box(4, 3, 3, Vector::Constant(1e-4));
  const FractureModel model = model_of(mesh, "AT2");
  DamageEquation equation(mesh, model, Vector::Zero());
  for (const double width : {0.05, 0.01})
    for (const double start : {0.0, 0.5, 1.0}) {
      const auto psi = [&](double d) {
        const double t = std::tanh((d - 0.9) / width);
        return DrivingAt{.value = unit * (10.0 - 9.9 * 0.5 * (1.0 + t)),
                         .slope = -unit * 9.9 * 0.5 * (1.0 - t * t) / width};
      };
      const auto slope = [&](double d) {
        return unit * d - 2.0 * (1.0 - model.residual_stiffness) * (1.0 - d) * psi(d).value;
      };
      double below = 0.0, above = 1.0;
      for (int k = 0; k < 60; ++k) (slope(0.5 * (below + above)) < 0.0 ? below : above) = 0.5 * (below + above);
      CellField<double> d = uniform(mesh, start);
      const DrivingLaw law = [&](Index, double at) { return psi(at); };
      EXPECT_TRUE(equation.solve(law, uniform(mesh, 0.0), {}, d).converged) << width << " from " << start;
      for (const double value : d) EXPECT_NEAR(value, below, 1e-8) << width << " from " << start;
    }
}

TEST(DamageEquation, SoundCellsWiderThanTheirLengthStaySound) {
  const Mesh mesh = row(9, 20.0 * ell);
  FractureModel model = model_of(mesh, "Wu");
  model.degradation = degradation("rational");
  model.regions.front().degradation =
      rational_degradation(rational_coefficients(softening_law("linear"), 30e9, Gc, 30e6, ell));
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> d = uniform(mesh, 0.0);
  EXPECT_TRUE(equation.solve(uniform(mesh, 0.0), uniform(mesh, 0.0), {}, d).converged);
  for (const double value : d) EXPECT_EQ(value, 0.0);
}

// Driving energy from nothing to a thousand times what breaks a cell, and bounds anywhere.
CellField<double> random_driving_energy(const Mesh& mesh) {
  RandomNumbers random;
  CellField<double> psi = random.field(mesh.n_cells(), 0.0, 0.3 * unit);
  for (double& value : psi)
    if (random.between(0.0, 1.0) < 0.1) value = 1000.0 * unit;
  return psi;
}

TEST(DamageEquation, StaysBetweenItsLowerBoundAndOne) {
  for (const Mesh& mesh : {box(8, 8, 8, Vector::Constant(2e-4)), tetrahedra_and_prisms()})
    for (const std::string_view law : {"AT1", "AT2"}) {
      FractureModel model = model_of(mesh, law);
      if (mesh.n_cells() > 600)
        for (RegionModel& region : model.regions) region.ell = 0.3;  // the sphere's radius is 1
      DamageEquation equation(mesh, model, Vector::Zero());
      RandomNumbers random;
      const CellField<double> lower = random.field(mesh.n_cells(), 0.0, 0.7);
      CellField<double> psi = random_driving_energy(mesh), d = lower;
      for (double& value : psi) value *= ell / model.regions.front().ell;
      EXPECT_TRUE(equation.solve(psi, lower, {.corrections = 5}, d).converged) << law;
      Index at_bound = 0;
      for (Index c = 0; c < mesh.n_cells(); ++c) {
        ASSERT_GE(d[c], lower[c]);
        ASSERT_LE(d[c], 1.0);
        at_bound += d[c] == lower[c] ? 1 : 0;
      }
      EXPECT_GT(at_bound, mesh.n_cells() / 20) << law;
      EXPECT_LT(at_bound, mesh.n_cells()) << law;
    }
}

// On orthogonal cells the equation is the slope of an energy: no change of one cell within the bounds lowers it.
TEST(DamageEquation, IsTheMinimumOfItsEnergyWithinTheBounds) {
  const Mesh mesh = box(6, 6, 6, Vector::Constant(1.2e-4));
  for (const std::string_view law : {"AT1", "AT2"}) {
    const FractureModel model = model_of(mesh, law);
    DamageEquation equation(mesh, model, Vector::Zero());
    RandomNumbers random;
    const CellField<double> lower = random.field(mesh.n_cells(), 0.0, 0.5), psi = random_driving_energy(mesh);
    CellField<double> d = lower;
    equation.solve(psi, lower, {}, d);
    const auto energy = [&] {
      double sum = equation.fracture_energy(d);
      for (Index c = 0; c < mesh.n_cells(); ++c)
        sum += (1.0 - model.residual_stiffness) * model.degradation.g(d[c]) * psi[c] * mesh.cell_volume[c];
      return sum;
    };
    const double least = energy();
    for (Index c = 0; c < mesh.n_cells(); ++c)
      for (const double change : {-1e-4, 1e-4}) {
        const double solved = d[c];
        if (solved + change < lower[c] || solved + change > 1.0) continue;
        d[c] = solved + change;
        EXPECT_GE(energy(), least * (1.0 - 1e-12)) << law << ", cell " << c;
        d[c] = solved;
      }
  }
}

// AT2 with a broken cell amid 2n cells between undamageable ends. At a distance of j cells
// d_j = sinh(kappa (n + 1/2 - j)) / sinh(kappa (n + 1/2)), cosh(kappa) = 1 + h^2 / (2 ell^2): zero on the faces of the
// ends, which for h -> 0 is sinh((b - x)/ell) / sinh(b/ell), of energy Gc coth(b/ell).
TEST(DamageEquation, UndamageableNeighboursPinTheProfile) {
  constexpr Index n = 15;
  const double h = 0.1 * ell, half_width = (n + 0.5) * h, end = (2 * n + 5) * h;
  const Mesh mesh = row(2 * n + 5, h, {from_to("grip", -1.0, 2 * h), from_to("grip", end - 2 * h, 1.0)});
  FractureModel model = model_of(mesh, "AT2");
  model.regions[mesh.region_index("grip")].damageable = false;
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> psi = uniform(mesh, 0.0), d = uniform(mesh, 0.0);
  const std::vector<Index> cells = in_order_of_x(mesh);
  psi[cells[n + 2]] = 1e12 * unit;
  EXPECT_TRUE(equation.solve(psi, uniform(mesh, 0.0), {}, d).converged);
  const double kappa = std::acosh(1.0 + 0.5 * std::pow(h / ell, 2));
  for (Index i = 0; i < mesh.n_cells(); ++i) {
    const double distance = std::abs(i - n - 2);
    const double discrete = std::max(0.0, std::sinh(kappa * (n + 0.5 - distance)) / std::sinh(kappa * (n + 0.5)));
    const double smooth = std::max(0.0, std::sinh((half_width - distance * h) / ell) / std::sinh(half_width / ell));
    EXPECT_NEAR(d[cells[i]], discrete, 1e-8) << i;
    EXPECT_NEAR(d[cells[i]], smooth, 1e-3) << i;
  }
  EXPECT_NEAR(equation.fracture_energy(d) / (h * h * Gc) * std::tanh(half_width / ell), 1.0, 3e-3);
}

// AT2, crack amid a weak band of half-width b in a tough bulk: the flux Gc ell d' is continuous, and the least energy
// is G_i (G_b + G_i t) / (G_i + G_b t), t = tanh(b/ell) (literature.md 4.1).
double error_of_band_toughness(Index cells_per_length) {
  const Index n = 12 * cells_per_length + 1;
  const double h = ell / cells_per_length, middle = 0.5 * n * h;
  const double half_width = 0.5 * ell + 0.5 * h;  // of the band, with the broken cell in its middle
  const Mesh mesh = row(n, h, {from_to("band", middle - half_width, middle + half_width)});
  FractureModel model = model_of(mesh, "AT2");
  model.regions[mesh.region_index("body")].Gc = 10.0 * Gc;
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> psi = uniform(mesh, 0.0), d = uniform(mesh, 0.0);
  psi[in_order_of_x(mesh)[n / 2]] = 1e12 * unit;
  EXPECT_TRUE(equation.solve(psi, uniform(mesh, 0.0), {}, d).converged);
  const double t = std::tanh(half_width / ell);
  return equation.fracture_energy(d) / (h * h * Gc) - (10.0 + t) / (1.0 + 10.0 * t);
}

TEST(DamageEquation, FluxIsContinuousWhereTheToughnessJumps) {
  const double coarse = error_of_band_toughness(10), fine = error_of_band_toughness(20);
  EXPECT_NEAR(fine, 0.0, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4) << "second order";
}

// Driven about the origin, on tetrahedra and prisms around a sphere of radius 1.
CellField<double> damage_about_the_origin(const Mesh& mesh, const FractureModel& model) {
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> psi = uniform(mesh, 0.0), d = psi;
  for (Index c = 0; c < mesh.n_cells(); ++c) psi[c] = 3.0 * Gc * std::exp(-mesh.cell_centre[c].squaredNorm());
  EXPECT_TRUE(equation.solve(psi, uniform(mesh, 0.0), {.corrections = 5}, d).converged);
  return d;
}

FractureModel model_with(const Mesh& mesh, const std::function<double(const Vector&)>& toughness) {
  FractureModel model = model_of(mesh, "AT2");
  for (RegionModel& region : model.regions) region.ell = 0.5;
  model.cells = CellField<RegionModel>(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    model.cells[c] = model.regions[mesh.region[c]];
    model.cells[c].Gc = toughness(mesh.cell_centre[c]);
  }
  return model;
}

Mesh tetrahedra_and_prisms_of_one_region() {
  Mesh mesh = tetrahedra_and_prisms();
  mesh.region_names = {"body"};
  for (Index& region : mesh.region) region = 0;
  return mesh;
}

TEST(DamageEquation, AJumpOfTheToughnessWithinARegionIsThatBetweenTwo) {
  const Mesh one = tetrahedra_and_prisms_of_one_region();
  Mesh two = one;
  two.region_names = {"left", "right"};
  for (Index c = 0; c < two.n_cells(); ++c) two.region[c] = two.cell_centre[c][0] > 0.1 ? 1 : 0;
  FractureModel of_two = model_of(two, "AT2");
  for (RegionModel& region : of_two.regions) region.ell = 0.5;
  of_two.regions[1].Gc = 10.0 * Gc;
  const FractureModel of_one = model_with(one, [](const Vector& x) { return x[0] > 0.1 ? 10.0 * Gc : Gc; });
  EXPECT_EQ(damage_about_the_origin(one, of_one), damage_about_the_origin(two, of_two));
}

TEST(DamageEquation, GradientsReachAcrossASmoothToughness) {
  const Mesh mesh = tetrahedra_and_prisms_of_one_region();
  const CellField<double> plain = damage_about_the_origin(mesh, model_with(mesh, [](const Vector&) { return Gc; }));
  const CellField<double> varied =
      damage_about_the_origin(mesh, model_with(mesh, [](const Vector& x) { return Gc * (1.0 + 1e-9 * x[0]); }));
  for (Index c = 0; c < mesh.n_cells(); ++c) ASSERT_NEAR(varied[c], plain[c], 1e-7);
}

// A broken cell in a long sound bar: the profile must not grow by a cell per change of the active set.
TEST(DamageEquation, ProfilesOfManyCellsAreFoundAtOnce) {
  const Mesh mesh = row(401, 0.02 * ell);
  const FractureModel model = model_of(mesh, "AT2");
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> psi = uniform(mesh, 0.0), d = uniform(mesh, 0.0);
  psi[in_order_of_x(mesh)[200]] = 1e12 * unit;
  const ScalarSolution solution = equation.solve(psi, uniform(mesh, 0.0), {}, d);
  EXPECT_TRUE(solution.converged);
  EXPECT_LE(solution.active_set_iterations, 5);
  EXPECT_NEAR(equation.fracture_energy(d) / (Gc * std::pow(0.02 * ell, 2)), 1.0, 2e-3);
}

TEST(DamageEquation, LeavesWhatItCannotDamage) {
  const Mesh mesh = row(10, ell, {from_to("grip", -1.0, 5 * ell)});
  FractureModel model = model_of(mesh, "AT1");
  const Index grip = mesh.region_index("grip");
  model.regions[grip] = {.elasticity = {}, .damageable = false};  // without toughness or length
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> d = uniform(mesh, 0.0);
  equation.solve(uniform(mesh, 100.0 * unit), uniform(mesh, 0.0), {}, d);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_EQ(equation.is_damageable(c), mesh.region[c] != grip);
    if (mesh.region[c] == grip)
      EXPECT_EQ(d[c], 0.0);
    else
      EXPECT_GT(d[c], 0.9);
  }
}

using DamageThreads = WithThreads;

TEST_F(DamageThreads, SolutionsAreBitwiseTheSame) {
  const Mesh mesh = box(24, 24, 24, Vector::Constant(6e-4));
  const FractureModel model = model_of(mesh, "AT2");
  const CellField<double> psi = random_driving_energy(mesh);
  std::vector<CellField<double>> solutions;
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    DamageEquation equation(mesh, model, Vector::Zero());
    solutions.push_back(uniform(mesh, 0.0));
    equation.solve(psi, uniform(mesh, 0.0), {}, solutions.back());
  }
  EXPECT_EQ(solutions[1], solutions[0]);
  EXPECT_EQ(solutions[2], solutions[0]);
}

}  // namespace
}  // namespace pfdm::this_file
