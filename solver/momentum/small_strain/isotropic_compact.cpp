// Coefficients of isotropic tractions, and what the preconditioner has of them: the compact matrix, and the rows of the
// pressures.

#include "solver/momentum/small_strain/isotropic_tractions.h"
#include "solver/parallel.h"

namespace pfdm {

using momentum_faces::bounded_height;
using momentum_faces::Link;
using momentum_faces::Side;

namespace {

Tensor scaling(double along, double across, const Vector& n) {
  return across * Tensor::Identity() + (along - across) * n * n.transpose();
}

}  // namespace

void IsotropicTractions::set_coefficients() {
  parallel_for(count_of(link_values_), [&](Index i) { link_values_[i] = values_of(i); });
  parallel_for(count_of(side_values_), [&](Index i) { side_values_[i] = values_of_side(i); });
}

IsotropicTractions::LinkValues IsotropicTractions::values_of(std::size_t i) const {
  const Link& link = skeleton_.links[i];
  const IsotropicElasticity &P = moduli_[link.P], &N = moduli_[link.N];
  const double h_P = link.h_P(), h_N = link.h_N();
  const double a_n = P.constrained_modulus() / h_P, b_n = N.constrained_modulus() / h_N;
  const double a_t = P.mu / h_P, b_t = N.mu / h_N;
  LinkValues by{.weight_n = b_n / (a_n + b_n), .weight_t = b_t / (a_t + b_t)};
  by.c_n = a_n * by.weight_n;
  by.c_t = a_t * by.weight_t;
  by.jump_n = jump_.along_normal(link.P, link.N, moduli_, h_P, h_N, by.c_n);
  by.jump_t = jump_.along_face(link.P, link.N, by.c_n, by.c_t);
  if (cells_.relaxes_flat_cells() && !cells_.is_of_third_order(i)) by.jump_t *= jump_.bending_part(link);
  return by;
}

IsotropicTractions::SideValues IsotropicTractions::values_of_side(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  const double h = side.h() / stiffer_at(skeleton_.turn_of_side(i));
  return {.a_n = jump_.modulus(side.cell, moduli_[side.cell]) / h, .a_t = moduli_[side.cell].mu / h};
}

Tensor IsotropicTractions::compact_link(std::size_t i) const {
  const Link& link = skeleton_.links[i];
  const double h_P = bounded_height(link.d_P, link.n), h_N = bounded_height(link.d_N, link.n);
  const IsotropicElasticity &P = moduli_[link.P], &N = moduli_[link.N];
  const double full = 1.0 / (h_P / P.constrained_modulus() + h_N / N.constrained_modulus());
  const double along = jump_.along_normal(link.P, link.N, moduli_, h_P, h_N, full);
  const double across = jump_.along_face(link.P, link.N, full, 1.0 / (h_P / P.mu + h_N / N.mu));
  return link.area * scaling(along, across, link.n);
}

Tensor IsotropicTractions::compact_side(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  const double h = bounded_height(side.d, side.n);
  return (stiffer_at(skeleton_.turn_of_side(i)) * side.area / h) *
         scaling(jump_.modulus(side.cell, moduli_[side.cell]), moduli_[side.cell].mu, side.n);
}

// u_f.S of a link from what its traction is made of, [m^3].
double IsotropicTractions::link_flux(std::size_t i, const Vector& u_P, const Vector& jump, const Vector& stress_jump,
                                     const IsotropicSweep& s) const {
  const Link& link = skeleton_.links[i];
  const LinkValues& by = link_values_[i];
  const double softness = by.weight_n * (1.0 - by.weight_n) / by.c_n;
  const double u_n = link.n.dot(u_P) + by.weight_n * link.n.dot(jump) + softness * link.n.dot(stress_jump);
  const Tensor G = 0.5 * (s.gradients[link.P] + s.gradients[link.N]);
  return link.area * u_n + cells_.pressure().flux_of_warp(link.face, G);
}

double IsotropicTractions::lag(std::size_t i, const Tensor& change) const {
  const Side& side = skeleton_.sides[i];
  if (skeleton_.mesh.is_interior(side.face)) return 0.0;
  const double free = side.n.dot(skeleton_.unknowns.free_within(side.node) * side.n);
  return free * side.n.dot(stress(of_stress_[side.cell], change) * side.n) / side_values_[i].a_n;
}

double IsotropicTractions::side_flux(std::size_t i, const Vector& u_f, const IsotropicSweep& s) const {
  const Side& side = skeleton_.sides[i];
  const double beyond = cells_.layers().any() ? lag(i, symmetric_part(s.layers[skeleton_.turn_of_side(i)])) : 0.0;
  return side.area * (side.n.dot(u_f) + beyond) + skeleton_.mesh.outwards(side.face, side.cell) *
                                                      cells_.pressure().flux_of_warp(side.face, s.gradients[side.cell]);
}

// V q / (lambda - lambda_s) - sum of u_f.S. There is no flux through the sector's own faces.
void IsotropicTractions::balance_pressures(const std::vector<Vector>&, Sweep& sweep, std::vector<Vector>& out) const {
  const IsotropicSweep& s = of(sweep);
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  parallel_for(count_of(cells), [&](Index k) {
    const Index c = cells[k];
    const double own = skeleton_.mesh.cell_volume[c] * s.pressure.mean(c) / cells_.pressure().modulus(c);
    out[skeleton_.unknowns.n_nodes() + k] = (own - skeleton_.out_of(c, s.flux)) * Vector::UnitX();
  });
}

// Takes away the terms of eigenstrains and histories in these rows: V tr eps* and V p_0/K, less the fluxes of the
// faces' moves by their tractions.
void IsotropicTractions::take_away_constant_volumes(std::vector<Vector>& load) const {
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  if (!has_initial_stress() || cells.empty()) return;
  std::vector<double> flux(skeleton_.n_forces(), 0.0);
  parallel_for(count_of(skeleton_.links), [&](Index i) {
    const Link& link = skeleton_.links[i];
    const LinkValues& by = link_values_[i];
    const double softness = by.weight_n * (1.0 - by.weight_n) / by.c_n;
    flux[i] = link.area * softness * link.n.dot(initial_jump(i));
  });
  if (varies_eigenstrain())
    parallel_for(count_of(skeleton_.sides), [&](Index i) {
      const double beyond = lag(i, eigenstrain_change(skeleton_.turn_of_side(i)));
      flux[skeleton_.links.size() + as_size(i)] = -skeleton_.sides[i].area * beyond;
    });
  parallel_for(count_of(cells), [&](Index k) {
    const Index c = cells[k];
    const double freely = skeleton_.mesh.cell_volume[c] * free_volume_change(c);
    load[skeleton_.unknowns.n_nodes() + k] -= (freely - skeleton_.out_of(c, flux)) * Vector::UnitX();
  });
}

IsotropicTractions::PressureRow IsotropicTractions::pressure_row(std::size_t k) const {
  const Index c = skeleton_.unknowns.pressure_cells[k];
  return {.slope = 1.0 / cells_.pressure().modulus(c), .modulus = moduli_[c].constrained_modulus()};
}

void IsotropicTractions::find_pressure_forces(const CellField<double>& tension, Sweep& s) const {
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Link& link = skeleton_.links[i];
    const double on_face = tension[link.N] + link_values_[i].weight_n * (tension[link.P] - tension[link.N]);
    s.force[i] = (link.area * on_face) * link.n;
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Side& side = skeleton_.sides[i];
    s.force[n_links + i] = (side.area * tension[side.cell]) * side.n;
  });
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] = tension[c]; });
}

}  // namespace pfdm
