// What drives the damage of a cell is the derivative of the energy by the cell's stiffness factor g. At prescribed
// displacements the energy is of first degree in all the factors together, so that by Euler's theorem
//
//   sum g_c psi_c V_c = E = half the work of the reactions,  psi_c V_c = dE/dg_c,
//
// however the strain varies from cell to cell; and each psi_c can be compared with a difference quotient of E.

#include "tests/verification/support.h"

#include "physics/materials/j2_plasticity.h"
#include "physics/materials/prony.h"
#include "solver/fracture/equilibrium/law_newton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pfdm::verification::this_file {
namespace {

const IsotropicElasticity sylgard = from_young_poisson(75e6, 0.44);
constexpr double residual_stiffness = 1e-6;

FractureModel damageable_model(const Mesh& mesh, const char* split, const IsotropicElasticity& elasticity) {
  const Tensor stretch = Vector(-0.002, -0.003, 0.01).asDiagonal();
  FractureModel model =
      elastic_model(std::vector<IsotropicElasticity>(mesh.region_names.size(), elasticity),
                    displacement_on_all(mesh, [=](const Vector& x) -> Vector { return stretch * x; }));
  for (RegionModel& region : model.regions) region.damageable = true;
  model.split = energy_split(split);
  model.residual_stiffness = residual_stiffness;
  return model;
}

// A body at given damage, whose closure has settled. A material with a history takes the place of the elastic one, and
// is strained within `duration`.
class Body {
 public:
  Body(const Mesh& mesh, const char* split, const IsotropicElasticity& elasticity = sylgard,
       const std::shared_ptr<const Material>& material = nullptr, double duration = 0.0)
      : mesh_(mesh),
        model_(damageable_model(mesh, split, elasticity)),
        unknowns_(place_unknowns(mesh, elastic_body(of(material)))),
        solver_(mesh, unknowns_),
        stiffness_(make_cell_stiffness(mesh, model_)) {
    state_.closure = CellField<double>(mesh.n_cells(), 0.0);
    state_.displacement.assign(unknowns_.n_unknowns(), Vector::Zero());
    state_.load = 1.0;
    state_.histories = virgin_ = stiffness_->virgin_histories();
    stiffness_->start_step(duration);
  }

  /// Energy [J] in equilibrium; with `settles` the closure follows.
  double energy(const CellField<double>& damage, bool settles) {
    state_.damage = damage;
    double energy = 0.0;
    for (int round = 0; round < 40; ++round) {
      stiffness_->set(state_, solver_);
      constexpr MomentumSolver::Tolerance tight{
          .reduction = 0.0, .ceiling = 1e-11, .floor = 1e-11, .most_iterations = 400};
      const Equilibrium on = stiffness_->is_linearised() ? solve_with_laws(*stiffness_, tight, solver_, state_)
                                                         : solver_.solve(state_.load, tight, state_.displacement);
      EXPECT_TRUE(on.converged);
      cells_ = solver_.balance().mechanics(state_.displacement, MomentumOperator::Wanted::without_gradient,
                                           stiffness_->degradable_part(state_));
      energy = 0.0;
      for (const double e : cells_.energy) energy += e;
      if (stiffness_->has_histories()) {
        FractureState start = state_;
        start.histories = virgin_;
        stiffness_->integrate(cells_, start, state_);
      }
      if (!settles || stiffness_->follow(cells_, state_) < 1e-9 * energy) break;
    }
    return energy;
  }

  double driving_energy(Index cell) const { return stiffness_->driving_energy(cell, cells_, state_); }
  double energy_of_mean_strain(Index cell) const {
    return model_.split.energy(model_.regions[0].elasticity, cells_.strain[cell]).psi_plus;
  }
  double g(Index cell) const {
    const double sound = 1.0 - state_.damage[cell];
    return (1.0 - residual_stiffness) * sound * sound + residual_stiffness;
  }

 private:
  const FractureModel& of(const std::shared_ptr<const Material>& material) {
    for (RegionModel& region : model_.regions)
      if (material) region.material = material, region.elasticity = material->elasticity();
    return model_;
  }

  const Mesh& mesh_;
  FractureModel model_;
  Unknowns unknowns_;
  MomentumSolver solver_;
  std::unique_ptr<CellStiffness> stiffness_;
  FractureState state_{};
  CellHistories virgin_{};
  CellMechanics cells_{};
};

CellField<double> random_damage(const Mesh& mesh) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 0.3);
  CellField<double> d(mesh.n_cells());
  for (double& value : d) value = any(random);
  return d;
}

class Cells : public ::testing::TestWithParam<bool> {};

// The damage jumps from cell to cell, so that the strains at the faces of a cell differ by factors.
TEST_P(Cells, DrivingEnergiesAddUpToTheEnergy) {
  const bool prisms = GetParam();
  const Mesh mesh =
      prisms ? extruded_triangles(6, {0.0, 0.1, 0.15, 0.3, 0.5, 0.6, 1.0}) : sphere_in_cube(3, 3, 3.0, 0.6);
  Body body(mesh, "none");
  const double energy = body.energy(random_damage(mesh), false);
  double sum = 0.0, of_mean_strain = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    sum += body.g(c) * body.driving_energy(c) * mesh.cell_volume[c];
    of_mean_strain += body.g(c) * body.energy_of_mean_strain(c) * mesh.cell_volume[c];
  }
  report_row("sum of g psi V over the energy",
             {{"driving energies", sum / energy}, {"those of the mean strains", of_mean_strain / energy}});
  EXPECT_NEAR(sum / energy, 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Energy, Cells, ::testing::Bool(),
                         [](const auto& which) { return which.param ? "Prisms" : "TetrahedraAndPrisms"; });

// A crack in the middle one of five layers of prisms around a sphere, and its front: damage that rises to 0.97 over two
// cells, with the profile of the phase field across the layers.
CellField<double> front(const Mesh& mesh, double radius) {
  CellField<double> d(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    const double polar = std::acos(x[2] / x.norm()), across = std::abs(x.norm() - radius);
    d[c] = 0.97 * 0.5 * (1.0 + std::tanh((0.9 - polar) / 0.06)) * std::exp(-across / 0.06);
  }
  return d;
}

class Splits : public ::testing::TestWithParam<const char*> {};

// Difference quotients over 2 % of 1 - d.
TEST_P(Splits, DrivingEnergyOfAFrontsCellsIsTheDerivativeOfTheEnergy) {
  const Mesh mesh = sphere_in_cube(8, 5, 3.0, 0.5);
  Body body(mesh, GetParam());
  const CellField<double> d = front(mesh, 1.2);
  body.energy(d, true);
  struct Seen {
    Index cell;
    double driving, of_mean_strain;
  };
  std::vector<Seen> cells;
  const Index every = energy_split(GetParam()).has_secant() ? 11 : 17;  // the others take longer
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (d[c] > 0.5 && d[c] < 0.93 && std::abs(mesh.cell_centre[c].norm() - 1.2) < 0.03 && c % every == 0)
      cells.push_back({c, body.driving_energy(c), body.energy_of_mean_strain(c)});
  ASSERT_GT(cells.size(), 5u);
  std::vector<double> ratio;
  double sum = 0.0, exact_sum = 0.0, worst_of_mean_strain = 0.0;
  for (const Seen& seen : cells) {
    const double step = 0.02 * (1.0 - d[seen.cell]), sound = 1.0 - d[seen.cell];
    CellField<double> more = d, less = d;
    more[seen.cell] += step, less[seen.cell] -= step;
    const double slope = (body.energy(less, false) - body.energy(more, false)) / (2.0 * step);
    const double exact = slope / (2.0 * (1.0 - residual_stiffness) * sound * mesh.cell_volume[seen.cell]);
    ratio.push_back(seen.driving / exact);
    worst_of_mean_strain = std::max(worst_of_mean_strain, std::abs(std::log(seen.of_mean_strain / exact)));
    sum += seen.driving, exact_sum += exact;
  }
  std::ranges::sort(ratio);
  report_row("driving energy over the derivative", {{"least", ratio.front()},
                                                    {"greatest", ratio.back()},
                                                    {"of the sums", sum / exact_sum},
                                                    {"of the mean strains, at worst", std::exp(worst_of_mean_strain)}});
  EXPECT_NEAR(sum / exact_sum, 1.0, 0.03);
  EXPECT_GT(ratio.front(), 0.9);
  EXPECT_LT(ratio.back(), 1.1);
}

INSTANTIATE_TEST_SUITE_P(Front, Splits, ::testing::Values("none", "volumetric_deviatoric", "spectral"),
                         [](const auto& which) { return std::string(which.param); });

struct Alike {
  const char* name;
  std::shared_ptr<const Material> material;
  double duration;  // [s]
};

const IsotropicElasticity binder = from_young_poisson(75e6, 0.3);  // whose cells have no pressure, relaxing or not

// Materials that answer as the elastic one: a plastic one that does not yield; one that relaxes by next to nothing; one
// whose branches have no time to relax, and store a part of what drives; one whose branches have long relaxed.
std::vector<Alike> materials_alike() {
  const double mu = binder.mu;
  const IsotropicElasticity half{.lambda = binder.bulk_modulus() - mu / 3.0, .mu = 0.5 * mu};
  return {
      {"plastic", make_j2_plasticity(binder, {.yield_stress = 1e12}), 1.0},
      {"branch of nothing", make_prony({.relaxed = binder, .shear = {{1e-9 * mu, 1.0}}}), 1.0},
      {"fast", make_prony({.relaxed = half, .shear = {{0.5 * mu, 1e12}}, .drive = PronyDrive::stored}), 1.0},
      {"slow", make_prony({.relaxed = binder, .shear = {{mu, 1e-9}}}), 1e3},
  };
}

class Histories : public ::testing::TestWithParam<const char*> {};

// By the energy of their mean strain beads in a matrix that relaxes debonded a quarter later than in the elastic one.
TEST_P(Histories, OfMaterialsThatAnswerAsTheElasticOneDriveAsIt) {
  const Mesh mesh = sphere_in_cube(8, 5, 3.0, 0.5);
  const CellField<double> d = front(mesh, 1.2);
  Body elastic(mesh, GetParam(), binder);
  elastic.energy(d, true);
  double largest = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) largest = std::max(largest, elastic.driving_energy(c));
  for (const Alike& alike : materials_alike()) {
    Body body(mesh, GetParam(), binder, alike.material, alike.duration);
    body.energy(d, true);
    double worst = 0.0, of_mean_strain = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const double due = elastic.driving_energy(c);
      if (due < 1e-3 * largest) continue;
      worst = std::max(worst, std::abs(body.driving_energy(c) / due - 1.0));
      of_mean_strain = std::max(of_mean_strain, std::abs(elastic.energy_of_mean_strain(c) / due - 1.0));
    }
    report_row(alike.name,
               {{"driving energy less the elastic one, at worst", worst}, {"that of the mean strain", of_mean_strain}});
    EXPECT_LT(worst, 1e-7) << alike.name;
    EXPECT_GT(of_mean_strain, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Front, Histories, ::testing::Values("none", "volumetric_deviatoric"),
                         [](const auto& which) { return std::string(which.param); });

}  // namespace
}  // namespace pfdm::verification::this_file
