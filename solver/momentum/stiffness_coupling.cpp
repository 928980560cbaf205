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
      by_stiffness_(skeleton_.unknowns.n_unknowns()) {
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
                                 tractions_.gap(cell, d, turn, u_f - u[cell], u, *sweep));
  };
  parallel_for(count_of(tau_P_), [&](Index i) {
    const momentum_faces::Link& link = skeleton_.links[i];
    const Vector u_f = tractions_.link_displacement(i, u, *sweep);
    tau_P_[i] = link.area * traction(link.P, link.n, link.d_P, u_f, FaceSkeleton::turn_P(i));
    tau_N_[i] = link.area * traction(link.N, link.n, link.d_N, u_f, FaceSkeleton::turn_N(i));
  });
  parallel_for(count_of(tau_), [&](Index i) {
    const momentum_faces::Side& side = skeleton_.sides[i];
    tau_[i] = side.area * traction(side.cell, side.n, side.d, u[side.node], skeleton_.turn_of_side(i));
  });
}

void StiffnessCoupling::apply(const CellField<double>& dg, std::vector<Vector>& force) const {
  const auto forces = balance_.sweep();
  std::ranges::fill(forces->sector_stress, 0.0);
  const Index n_links = count_of(tau_P_);
  parallel_for(n_links, [&](Index i) {
    const momentum_faces::Link& link = skeleton_.links[i];
    const Vector of_N = dg[link.N] * tau_N_[i];
    forces->force[i] = of_N + tractions_.weigh(i, dg[link.P] * tau_P_[i] - of_N);
  });
  parallel_for(count_of(tau_), [&](Index i) { forces->force[n_links + i] = dg[skeleton_.sides[i].cell] * tau_[i]; });
  skeleton_.sum_forces(*forces, force);
}

void StiffnessCoupling::apply(const std::vector<Vector>& du, const CellField<double>& dg, std::vector<Vector>& force,
                              CellField<double>& energy) {
  const auto sweep = balance_.sweep();
  balance_.apply(du, force, *sweep);
  const Index n_links = count_of(tau_P_);
  parallel_for(n_links, [&](Index i) {
    const momentum_faces::Link& link = skeleton_.links[i];
    const Vector &on_P = tau_P_[i], &on_N = tau_N_[i];
    const Vector more = dg[link.P] * on_P - dg[link.N] * on_N;
    const Vector du_f = tractions_.link_displacement(i, du, *sweep) - tractions_.give(i, more) / link.area;
    gain_P_[i] = on_P.dot(du_f - du[link.P]);
    gain_N_[i] = -on_N.dot(du_f - du[link.N]);
  });
  parallel_for(count_of(tau_), [&](Index i) {
    const momentum_faces::Side& side = skeleton_.sides[i];
    gain_[i] = tau_[i].dot(du[side.node] - du[side.cell]);
  });
  parallel_for(energy.size(), [&](Index c) {
    energy[c] = 0.0;
    for (const FaceSkeleton::SignedForce& on : skeleton_.forces_of(c)) {
      const Index i = on.force;
      energy[c] += i >= n_links ? gain_[i - n_links] : (on.sign > 0.0 ? gain_P_[i] : gain_N_[i]);
    }
  });
  apply(dg, by_stiffness_);
  parallel_for(count_of(force), [&](Index i) { force[i] += by_stiffness_[i]; });
}

}  // namespace pfdm
