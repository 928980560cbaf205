#include "solver/dynamics/vibrating_body.h"

#include "physics/error.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

MomentumOperator balance_of(const Mesh& mesh, const Unknowns& unknowns) {
  MomentumOperator balance(mesh, unknowns);
  CellField<IsotropicElasticity> moduli(as_size(mesh.n_cells()));
  for (Index c = 0; c < mesh.n_cells(); ++c) moduli[c] = unknowns.sound[as_size(unknowns.zone[c])];
  balance.relax_flat_cells();
  balance.set_moduli(moduli, CellField<double>(as_size(mesh.n_cells()), 1.0));
  return balance;
}

Eigen::VectorXd masses(const Mesh& mesh, const Unknowns& unknowns, const std::vector<double>& density) {
  for (const double rho : density)
    if (!(rho > 0.0)) throw InputError(fmt::format("the density has to be positive, found {:.4g} kg/m^3", rho));
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(3 * Eigen::Index{unknowns.n_unknowns()});
  for (Index c = 0; c < mesh.n_cells(); ++c)
    mass.segment<3>(3 * Eigen::Index{c}).setConstant(density[as_size(mesh.region[c])] * mesh.cell_volume[c]);
  return mass;
}

}  // namespace

VibratingBody::VibratingBody(const Mesh& mesh, const ElasticBody& body, const std::vector<double>& density)
    : mesh_(mesh),
      unknowns_(place_unknowns(mesh, body)),
      balance_(balance_of(mesh, unknowns_)),
      mass_(masses(mesh, unknowns_, density)),
      total_mass_(mass_.sum() / 3.0),
      stiffness_(matrix_of(mesh, unknowns_, balance_)),
      factors_(stiffness_) {}

Eigen::VectorXd VibratingBody::answer(Eigen::VectorXd force) const {
  for (std::size_t k = 0; k < unknowns_.free_directions.size(); ++k) {
    auto on_node = force.segment<3>(3 * (Eigen::Index{unknowns_.n_cells} + static_cast<Eigen::Index>(k)));
    on_node = (unknowns_.free_directions[k] * on_node).eval();
  }
  return factors_.solve(force);
}

Eigen::VectorXd VibratingBody::rigid(const Vector& direction) const {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(size());
  for (Index c = 0; c < mesh_.n_cells(); ++c) motion.segment<3>(3 * Eigen::Index{c}) = direction;
  return motion;
}

std::vector<Vector> as_vectors(const Eigen::VectorXd& u) {
  std::vector<Vector> vectors(static_cast<std::size_t>(u.size() / 3));
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = u.segment<3>(3 * static_cast<Eigen::Index>(i));
  return vectors;
}

}  // namespace pfdm
