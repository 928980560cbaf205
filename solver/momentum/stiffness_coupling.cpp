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
      tau_P_(balance.links_.size(), Vector::Zero()),
      tau_N_(balance.links_.size(), Vector::Zero()),
      tau_(balance.sides_.size(), Vector::Zero()),
      gain_P_(balance.links_.size()),
      gain_N_(balance.links_.size()),
      gain_(balance.sides_.size()),
      by_stiffness_(as_size(balance.unknowns_.n_unknowns())) {
  if (balance.unknowns_.plane_stress)
    parallel_for(part.size(), [&](Index c) {
      if (part[c].mu > 0.0) part[c] = plane_stress(part[c]);
    });
  balance.find_gradients(u);
  // Along n; d.n is negative on the side that n leads into.
  const auto traction = [&](Index cell, const Vector& n, const Vector& d, const Vector& u_f,
                            std::size_t turn) -> Vector {
    const IsotropicElasticity& p = part[cell];
    const Tensor G = balance.gradient_at(cell, turn);
    const double h = d.dot(n);
    return (p.lambda * G.trace()) * n + p.mu * (G * n + G.transpose() * n) +
           MomentumOperator::scale(p.constrained_modulus() / h, p.mu / h, n,
                                   balance.gap(cell, d, turn, u_f - u[as_size(cell)], u));
  };
  parallel_for(static_cast<Index>(tau_P_.size()), [&](Index i) {
    const auto& link = balance.links_[as_size(i)];
    const Vector u_f = balance.face_displacement(as_size(i), u);
    tau_P_[as_size(i)] = link.area * traction(link.P, link.n, link.d_P, u_f, balance.turn_P(as_size(i)));
    tau_N_[as_size(i)] = link.area * traction(link.N, link.n, link.d_N, u_f, balance.turn_N(as_size(i)));
  });
  parallel_for(static_cast<Index>(tau_.size()), [&](Index i) {
    const auto& side = balance.sides_[as_size(i)];
    tau_[as_size(i)] =
        side.area * traction(side.cell, side.n, side.d, u[as_size(side.node)], balance.turn_of_side(as_size(i)));
  });
}

void StiffnessCoupling::apply(const CellField<double>& dg, std::vector<Vector>& force) const {
  const std::size_t n_links = tau_P_.size();
  parallel_for(static_cast<Index>(n_links), [&](Index i) {
    const auto& link = balance_.links_[as_size(i)];
    const Vector of_N = dg[link.N] * tau_N_[as_size(i)];
    balance_.forces_[as_size(i)] = of_N + balance_.weigh(as_size(i), dg[link.P] * tau_P_[as_size(i)] - of_N);
  });
  parallel_for(static_cast<Index>(tau_.size()), [&](Index i) {
    balance_.forces_[n_links + as_size(i)] = dg[balance_.sides_[as_size(i)].cell] * tau_[as_size(i)];
  });
  balance_.sum_forces(force);
}

void StiffnessCoupling::apply(const std::vector<Vector>& du, const CellField<double>& dg, std::vector<Vector>& force,
                              CellField<double>& energy) {
  balance_.apply(du, force);  // finds the gradients of du
  const std::size_t n_links = tau_P_.size();
  parallel_for(static_cast<Index>(n_links), [&](Index i) {
    const auto& link = balance_.links_[as_size(i)];
    const Vector &on_P = tau_P_[as_size(i)], &on_N = tau_N_[as_size(i)];
    const Vector more = dg[link.P] * on_P - dg[link.N] * on_N;
    const Vector du_f = balance_.face_displacement(as_size(i), du) - balance_.give(as_size(i), more) / link.area;
    gain_P_[as_size(i)] = on_P.dot(du_f - du[as_size(link.P)]);
    gain_N_[as_size(i)] = -on_N.dot(du_f - du[as_size(link.N)]);
  });
  parallel_for(static_cast<Index>(tau_.size()), [&](Index i) {
    const auto& side = balance_.sides_[as_size(i)];
    gain_[as_size(i)] = tau_[as_size(i)].dot(du[as_size(side.node)] - du[as_size(side.cell)]);
  });
  parallel_for(energy.size(), [&](Index c) {
    energy[c] = 0.0;
    for (std::size_t k = balance_.cell_offsets_[as_size(c)]; k < balance_.cell_offsets_[as_size(c) + 1]; ++k) {
      const auto& on = balance_.cell_forces_[k];
      const auto i = as_size(on.force);
      energy[c] += i >= n_links ? gain_[i - n_links] : (on.sign > 0.0 ? gain_P_[i] : gain_N_[i]);
    }
  });
  apply(dg, by_stiffness_);
  parallel_for(static_cast<Index>(force.size()), [&](Index i) { force[as_size(i)] += by_stiffness_[as_size(i)]; });
}

}  // namespace pfdm
