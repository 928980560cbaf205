#include "solver/momentum/stiffness_coupling.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

bool StiffnessCoupling::covers(const Mesh& mesh, const Unknowns& unknowns) {
  const auto is_polyhedron = [](CellShape shape) { return shape == CellShape::polyhedron; };
  return !unknowns.is_axisymmetric() && unknowns.pressure_cells.empty() &&
         std::none_of(mesh.shape.begin(), mesh.shape.end(), is_polyhedron);
}

StiffnessCoupling::StiffnessCoupling(const MomentumOperator& balance, CellField<IsotropicElasticity> part,
                                     const std::vector<Vector>& u)
    : balance_(balance),
      skeleton_(balance.skeleton()),
      tractions_(*balance.isotropic()),
      tau_P_(skeleton_.links.size(), Vector::Zero()),
      tau_N_(skeleton_.links.size(), Vector::Zero()),
      tau_(skeleton_.sides.size(), Vector::Zero()),
      gain_P_(skeleton_.links.size()),
      gain_N_(skeleton_.links.size()),
      gain_(skeleton_.sides.size()),
      by_stiffness_(as_size(skeleton_.unknowns.n_unknowns())) {
  if (skeleton_.unknowns.plane_stress)
    parallel_for(part.size(), [&](Index c) {
      if (part[c].mu > 0.0) part[c] = plane_stress(part[c]);
    });
  find_tractions(part, u);
}

void StiffnessCoupling::find_tractions(const CellField<IsotropicElasticity>& part, const std::vector<Vector>& u) {
  const auto sweep = balance_.sweep();
  tractions_.find_linear(u, *sweep);
  // Along n; d.n is negative on the side that n leads into.
  const auto traction = [&](Index cell, const Vector& n, const Vector& d, const Vector& u_f,
                            std::size_t turn) -> Vector {
    const IsotropicElasticity& p = part[cell];
    const Tensor G = tractions_.gradient_at(cell, turn, *sweep);
    const double h = d.dot(n);
    return (p.lambda * G.trace()) * n + p.mu * (G * n + G.transpose() * n) +
           momentum_faces::scale(p.constrained_modulus() / h, p.mu / h, n,
                                 tractions_.gap(cell, d, turn, u_f - u[as_size(cell)], u, *sweep));
  };
  parallel_for(static_cast<Index>(tau_P_.size()), [&](Index index) {
    const std::size_t i = as_size(index);
    const momentum_faces::Link& link = skeleton_.links[i];
    const Vector u_f = tractions_.link_displacement(i, u, *sweep);
    tau_P_[i] = link.area * traction(link.P, link.n, link.d_P, u_f, FaceSkeleton::turn_P(i));
    tau_N_[i] = link.area * traction(link.N, link.n, link.d_N, u_f, FaceSkeleton::turn_N(i));
  });
  parallel_for(static_cast<Index>(tau_.size()), [&](Index i) {
    const momentum_faces::Side& side = skeleton_.sides[as_size(i)];
    tau_[as_size(i)] =
        side.area * traction(side.cell, side.n, side.d, u[as_size(side.node)], skeleton_.turn_of_side(as_size(i)));
  });
}

void StiffnessCoupling::apply(const CellField<double>& dg, std::vector<Vector>& force) const {
  const auto forces = balance_.sweep();
  std::ranges::fill(forces->sector_stress, 0.0);
  const std::size_t n_links = tau_P_.size();
  parallel_for(static_cast<Index>(n_links), [&](Index index) {
    const std::size_t i = as_size(index);
    const momentum_faces::Link& link = skeleton_.links[i];
    const Vector of_N = dg[link.N] * tau_N_[i];
    forces->force[i] = of_N + tractions_.weigh(i, dg[link.P] * tau_P_[i] - of_N);
  });
  parallel_for(static_cast<Index>(tau_.size()), [&](Index i) {
    forces->force[n_links + as_size(i)] = dg[skeleton_.sides[as_size(i)].cell] * tau_[as_size(i)];
  });
  skeleton_.sum_forces(*forces, force);
}

void StiffnessCoupling::apply(const std::vector<Vector>& du, const CellField<double>& dg, std::vector<Vector>& force,
                              CellField<double>& energy) {
  const auto sweep = balance_.sweep();
  balance_.apply(du, force, *sweep);
  const std::size_t n_links = tau_P_.size();
  parallel_for(static_cast<Index>(n_links), [&](Index index) {
    const std::size_t i = as_size(index);
    const momentum_faces::Link& link = skeleton_.links[i];
    const Vector &on_P = tau_P_[i], &on_N = tau_N_[i];
    const Vector more = dg[link.P] * on_P - dg[link.N] * on_N;
    const Vector du_f = tractions_.link_displacement(i, du, *sweep) - tractions_.give(i, more) / link.area;
    gain_P_[i] = on_P.dot(du_f - du[as_size(link.P)]);
    gain_N_[i] = -on_N.dot(du_f - du[as_size(link.N)]);
  });
  parallel_for(static_cast<Index>(tau_.size()), [&](Index i) {
    const momentum_faces::Side& side = skeleton_.sides[as_size(i)];
    gain_[as_size(i)] = tau_[as_size(i)].dot(du[as_size(side.node)] - du[as_size(side.cell)]);
  });
  parallel_for(energy.size(), [&](Index c) {
    energy[c] = 0.0;
    for (const FaceSkeleton::SignedForce& on : skeleton_.forces_of(c)) {
      const auto i = as_size(on.force);
      energy[c] += i >= n_links ? gain_[i - n_links] : (on.sign > 0.0 ? gain_P_[i] : gain_N_[i]);
    }
  });
  apply(dg, by_stiffness_);
  parallel_for(static_cast<Index>(force.size()), [&](Index i) { force[as_size(i)] += by_stiffness_[as_size(i)]; });
}

}  // namespace pfdm
