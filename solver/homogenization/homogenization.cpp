#include "solver/homogenization/homogenization.h"

#include "physics/elasticity/effective_stiffness.h"
#include "physics/error.h"
#include "physics/registry.h"
#include "solver/homogenization/box_sides.h"
#include "solver/momentum/body/box_means.h"
#include "solver/momentum/solution/force_balance.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pfdm {
namespace {

// The k-th of the six unit strains or stresses.
Tensor unit(std::size_t k) { return to_tensor(Mandel::Unit(static_cast<Index>(k))); }

ElasticBody body_of(const Mesh& mesh, const LinearComposite& composite, const BoxSides& sides, const Loading& loading) {
  ElasticBody body{.elasticity = composite.elasticity, .zone = composite.zone, .boundary = {}};
  body.stiffness = composite.stiffness;
  body.has_pressure = !composite.stiffness;
  if (loading.by_traction) {
    body.motion.held = three_two_one_supports(mesh, sides);
    return body;
  }
  // Load case k is reached at the load parameter k.
  body.motion.displacement = [centre = sides.centre()](const Vector& x, double load) -> Vector {
    return unit(static_cast<std::size_t>(std::lround(load))) * (x - centre);
  };
  if (loading.repeats) {
    body.motion.periodic = match_opposite_sides(mesh, sides);
    body.motion.held = {{body.motion.periodic.front().face, Tensor::Identity()}};
    return body;
  }
  for (const Index face : sides.all()) body.motion.held.push_back({face, Tensor::Identity()});
  return body;
}

CellField<IsotropicElasticity> moduli_of(const Mesh& mesh, const LinearComposite& composite) {
  if (composite.cells.size() > 0) return composite.cells;
  CellField<IsotropicElasticity> moduli(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) moduli[c] = composite.elasticity[mesh.region[c]];
  return moduli;
}

class BoxInLoadCases {
 public:
  BoxInLoadCases(const Mesh& mesh, const LinearComposite& composite, const HomogenizationSettings& settings)
      : mesh_(mesh),
        settings_(settings),
        loading_(settings.loading != nullptr ? *settings.loading : homogenization_loadings().front()),
        sides_(find_box_sides(mesh)),
        unknowns_(place_unknowns(mesh, body_of(mesh, composite, sides_, loading_))),
        moduli_(moduli_of(mesh, composite)),
        solver_(mesh, unknowns_, settings.linear) {
    const CellField<double> sound(mesh.n_cells(), 1.0);
    if (unknowns_.stiffness)
      solver_.set_law(strain_law(), sound, std::vector<Vector>(unknowns_.n_unknowns(), Vector::Zero()));
    else
      solver_.set_moduli(moduli_, sound);
  }

  LoadCase solve(std::size_t k);
  LoadCaseFields fields(std::size_t k) const;
  void add_energies(Homogenized& result) const;

  double volume() const { return sides_.volume(); }
  Index n_unknowns() const { return unknowns_.n_unknowns(); }

 private:
  MandelMatrix stiffness(Index cell) const {
    const MandelMatrix* directed = unknowns_.stiffness_of(mesh_, cell);
    return directed != nullptr ? *directed : stiffness_matrix(moduli_[cell]);
  }
  StrainLaw strain_law() const {
    return {.tangent = [this](Index cell, const Tensor&) { return stiffness(cell); },
            .degradable = [](Index, const Tensor&) -> Tensor { return Tensor::Zero(); }};
  }
  std::vector<Vector> forces_on_sides(std::size_t k) const;
  std::vector<Vector> first_guess(std::size_t k) const;
  double tolerance_to_balance(double load, double tolerance, const std::vector<Vector>& u) const;
  void average(const std::vector<Vector>& u, LoadCase& result) const;
  std::vector<double> energies(const std::vector<Vector>& u) const;

  const Mesh& mesh_;
  const HomogenizationSettings& settings_;
  const Loading& loading_;
  BoxSides sides_;
  Unknowns unknowns_;
  CellField<IsotropicElasticity> moduli_;
  MomentumSolver solver_;
  std::array<std::vector<Vector>, 6> u_;
};

// Unit stress; the supports carry what falls on them.
std::vector<Vector> BoxInLoadCases::forces_on_sides(std::size_t k) const {
  std::vector<Vector> force(unknowns_.n_nodes(), Vector::Zero());
  for (const Index face : sides_.all()) {
    const Index node = unknowns_.node_of_face[face];
    force[node] = unknowns_.free_directions[node - unknowns_.n_cells] * (unit(k) * mesh_.face_area[face]);
  }
  return force;
}

std::vector<Vector> BoxInLoadCases::first_guess(std::size_t k) const {
  if (loading_.by_traction) return std::vector<Vector>(unknowns_.n_unknowns(), Vector::Zero());
  return unknowns_.moved_with_box(mesh_, static_cast<double>(k));
}

LoadCase BoxInLoadCases::solve(std::size_t k) {
  if (loading_.by_traction) solver_.set_body_force(forces_on_sides(k));
  std::vector<Vector> u = first_guess(k);
  const double load = static_cast<double>(k);
  LoadCase result{};
  const auto converges = [&](double tolerance) {
    const Equilibrium found =
        solver_.solve(load, {.ceiling = tolerance, .floor = tolerance, .most_iterations = 4000}, u);
    result.iterations += found.iterations;
    result.residual = found.residual;
    return found.converged;
  };
  double tolerance = settings_.tolerance;
  if (!converges(tolerance))
    throw NoConvergence(fmt::format("load case {} did not converge: residual {:.2g} after {} iterations",
                                    component_names[k], result.residual, result.iterations));
  for (bool goes_on = true; goes_on;) {
    const double before = std::exchange(tolerance, tolerance_to_balance(load, tolerance, u));
    goes_on = tolerance < before && converges(tolerance);
  }
  average(u, result);
  u_[k] = std::move(u);
  return result;
}

// The tolerance with which the forces on the parts of the box balance.
double BoxInLoadCases::tolerance_to_balance(double load, double tolerance, const std::vector<Vector>& u) const {
  const CellMechanics cells = solver_.balance().mechanics(u, MomentumOperator::Wanted::without_gradient);
  const double force = force_through(mesh_, solver_.balance().boundary_forces(u), cells.stress);
  const double imbalance = unbalanced_force(solver_, load, u) / std::max(force, 1e-300);
  if (!(imbalance > bearable_imbalance)) return tolerance;
  return std::max(least_tolerance, tolerance * needed_tightening(imbalance));
}

void BoxInLoadCases::average(const std::vector<Vector>& u, LoadCase& result) const {
  const BoxMeans means = box_means(mesh_, unknowns_, sides_.all(), solver_.balance().boundary_forces(u), u);
  result.stress = to_mandel(means.stress);
  result.strain = to_mandel(means.strain);
  const CellMechanics cells = solver_.balance().mechanics(u, MomentumOperator::Wanted::without_gradient);
  Tensor constitutive = Tensor::Zero();
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    constitutive += mesh_.cell_volume[c] * (unknowns_.stiffness ? to_tensor(stiffness(c) * to_mandel(cells.strain[c]))
                                                                : pfdm::stress(moduli_[c], cells.strain[c]));
  result.constitutive_stress = to_mandel(constitutive / volume());
}

LoadCaseFields BoxInLoadCases::fields(std::size_t k) const {
  CellMechanics cells = solver_.balance().mechanics(u_[k]);
  LoadCaseFields fields{.displacement = CellField<Vector>(mesh_.n_cells()),
                        .gradient = std::move(cells.gradient),
                        .strain = std::move(cells.strain),
                        .stress = std::move(cells.stress)};
  std::copy_n(u_[k].begin(), mesh_.n_cells(), fields.displacement.begin());
  return fields;
}

// By region [J].
std::vector<double> BoxInLoadCases::energies(const std::vector<Vector>& u) const {
  const CellMechanics cells = solver_.balance().mechanics(u, MomentumOperator::Wanted::without_gradient);
  std::vector<double> sum(mesh_.region_names.size(), 0.0);
  for (Index c = 0; c < mesh_.n_cells(); ++c) sum[mesh_.region[c]] += cells.energy[c];
  return sum;
}

// The energies are a quadratic form of the load cases: eps_i : C : eps_j V = e(u_i + u_j) - e(u_i) - e(u_j).
void BoxInLoadCases::add_energies(Homogenized& result) const {
  const std::size_t n_regions = mesh_.region_names.size();
  result.of_region.assign(n_regions, MandelMatrix::Zero());
  std::array<std::vector<double>, 6> own;
  for (std::size_t i = 0; i < 6; ++i) own[i] = energies(u_[i]);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      std::vector<Vector> both = u_[i];
      for (std::size_t n = 0; n < both.size(); ++n) both[n] += u_[j][n];
      const std::vector<double> together = i == j ? own[i] : energies(both);
      for (std::size_t r = 0; r < n_regions; ++r) {
        const double form = i == j ? 2.0 * own[i][r] : together[r] - own[i][r] - own[j][r];
        const auto row = static_cast<Index>(i), column = static_cast<Index>(j);
        result.of_region[r](row, column) = result.of_region[r](column, row) = form / volume();
      }
    }
}

constexpr Loading table[] = {
    {"periodic", "opposite sides move alike, apart from the mean strain: for boxes whose opposite sides are cut alike",
     false, true},
    {"uniform displacement", "the sides move as a homogeneous body's: stiffness from above (kinematic)", false},
    {"uniform traction", "the sides are loaded as a homogeneous body's: stiffness from below (static)", true},
};

}  // namespace

std::span<const Loading> homogenization_loadings() { return table; }

const Loading& homogenization_loading(std::string_view name) {
  return find_by_name(homogenization_loadings(), name, "boundary condition of a homogenisation");
}

MandelMatrix Homogenized::energy_stiffness() const {
  return std::accumulate(of_region.begin(), of_region.end(), MandelMatrix(MandelMatrix::Zero()));
}

double Homogenized::energy_difference() const { return (energy_stiffness() - stiffness).norm() / stiffness.norm(); }

double Homogenized::constitutive_difference() const {
  double largest = 0.0;
  for (const LoadCase& one : cases)
    largest = std::max(largest, (one.constitutive_stress - one.stress).norm() / one.stress.norm());
  return largest;
}

Index homogenization_unknowns(const Mesh& mesh, const LinearComposite& composite,
                              const HomogenizationSettings& settings) {
  const Loading& loading = settings.loading != nullptr ? *settings.loading : homogenization_loadings().front();
  return place_unknowns(mesh, body_of(mesh, composite, find_box_sides(mesh), loading)).n_unknowns();
}

Homogenized homogenize(const Mesh& mesh, const LinearComposite& composite, const HomogenizationSettings& settings,
                       const std::function<void(std::size_t, const LoadCase&)>& solved,
                       const std::function<void(std::size_t, const LoadCase&, const LoadCaseFields&)>& fields) {
  BoxInLoadCases box(mesh, composite, settings);
  Homogenized result;
  result.volume = box.volume();
  result.n_unknowns = box.n_unknowns();
  result.fraction.assign(mesh.region_names.size(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c) result.fraction[mesh.region[c]] += mesh.cell_volume[c] / result.volume;
  MandelMatrix stresses, strains;
  for (std::size_t k = 0; k < 6; ++k) {
    LoadCase& one = result.cases[k] = box.solve(k);
    stresses.col(k) = one.stress;
    strains.col(k) = one.strain;
    if (fields) fields(k, one, box.fields(k));
    if (solved) solved(k, one);
  }
  const MandelMatrix by_strain = strains.inverse(), C = stresses * by_strain;
  result.asymmetry = asymmetry(C);
  result.stiffness = 0.5 * (C + C.transpose());
  box.add_energies(result);
  for (MandelMatrix& region : result.of_region) region = by_strain.transpose() * region * by_strain;
  return result;
}

}  // namespace pfdm
