#include "solver/dynamics/vibrating_body.h"

#include "physics/error.h"
#include "solver/dynamics/spline_solver.h"
#include "solver/momentum/body/rigid_motion.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

Unknowns unknowns_of(const Mesh& mesh, ElasticBody body, bool may_float) {
  for (BoundaryCondition& condition : body.boundary) condition.value = {}, condition.pressure = {};
  return may_float ? place_floating_unknowns(mesh, body) : place_unknowns(mesh, body);
}

Eigen::VectorXd masses(const Mesh& mesh, const Unknowns& unknowns, const std::vector<double>& density) {
  for (const double rho : density)
    if (!(rho > 0.0)) throw InputError(fmt::format("the density has to be positive, found {:.4g} kg/m^3", rho));
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(3 * Eigen::Index{unknowns.n_unknowns()});
  for (Index c = 0; c < mesh.n_cells(); ++c)
    mass.segment<3>(3 * Eigen::Index{c}).setConstant(density[mesh.region[c]] * mesh.cell_volume[c]);
  return mass;
}

// Of a momentum balance or its solver.
template <class Balance>
void set_stiffness(const Mesh& mesh, const Unknowns& unknowns, Balance& balance) {
  balance.set_moduli(unknowns.sound_moduli(), CellField<double>(mesh.n_cells(), 1.0));
}

bool is_factored(const Mesh& mesh, const VibrationSettings& settings) {
  return settings.shift > 0.0 || mesh.n_cells() <= settings.most_factored || prefers_direct(mesh);
}

}  // namespace

VibratingBody::VibratingBody(const Mesh& mesh, const ElasticBody& body, const std::vector<double>& density,
                             const VibrationSettings& settings)
    : mesh_(mesh),
      settings_(settings),
      unknowns_(unknowns_of(mesh, body, settings.shift > 0.0)),
      mass_(masses(mesh, unknowns_, density)),
      total_mass_(mass_.sum() / 3.0) {
  if (!is_factored(mesh, settings)) {
    solver_.emplace(mesh, unknowns_, &multigrid_with_splines());
    solver_->balance().relax_flat_cells();
    set_stiffness(mesh, unknowns_, *solver_);
    return;
  }
  balance_.emplace(mesh, unknowns_);
  balance_->relax_flat_cells();
  set_stiffness(mesh, unknowns_, *balance_);
  Eigen::SparseMatrix<double> K = stiffness();
  if (settings.shift > 0.0) K += Eigen::SparseMatrix<double>((settings.shift * mass_).asDiagonal());
  factors_.emplace(std::move(K));
}

std::string VibratingBody::method() const {
  if (factors_) return fmt::format("{:.3g} entries of factors", factors_->n_entries());
  return fmt::format("{} solutions of {:.1f} iterations", n_solutions_,
                     static_cast<double>(n_iterations_) / std::max<Index>(1, n_solutions_));
}

Eigen::VectorXd VibratingBody::answer(Eigen::VectorXd force) const {
  for (std::size_t k = 0; k < unknowns_.free_directions.size(); ++k) {
    auto on_node = force.segment<3>(3 * (Eigen::Index{unknowns_.n_cells} + static_cast<Eigen::Index>(k)));
    on_node = (unknowns_.free_directions[k] * on_node).eval();
  }
  return factors_ ? factors_->solve(force) : iterative_answer(force);
}

Eigen::VectorXd VibratingBody::iterative_answer(const Eigen::VectorXd& force) const {
  std::vector<Vector> on_nodes = as_vectors(force), u(on_nodes.size(), Vector::Zero());
  on_nodes.resize(unknowns_.n_nodes());
  solver_->set_body_force(std::move(on_nodes));
  const Equilibrium done = solver_->solve(0.0, {.ceiling = settings_.tolerance, .floor = settings_.tolerance}, u);
  ++n_solutions_;
  n_iterations_ += done.iterations;
  if (!done.converged)
    throw ComputationError(
        fmt::format("the motion of a vibrating body was not found: after {} iterations a residual of {:.2g} is left",
                    done.iterations, done.residual));
  return Eigen::Map<const Eigen::VectorXd>(u.front().data(), force.size());
}

Eigen::VectorXd VibratingBody::rigid(const Vector& direction) const {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(size());
  for (Index c = 0; c < mesh_.n_cells(); ++c) motion.segment<3>(3 * Eigen::Index{c}) = direction;
  return motion;
}

std::vector<Vector> as_vectors(const Eigen::VectorXd& u) {
  std::vector<Vector> vectors(u.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = u.segment<3>(3 * static_cast<Eigen::Index>(i));
  return vectors;
}

}  // namespace pfdm
