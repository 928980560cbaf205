#include "solver/momentum/small_strain/isotropic_tractions.h"

#include "solver/momentum/small_strain/isotropic_sweep.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

using momentum_faces::bounded_height;
using momentum_faces::Link;
using momentum_faces::scale;
using momentum_faces::Side;

IsotropicTractions::IsotropicTractions(const FaceSkeleton& skeleton, CellReconstruction& cells,
                                       const CellEigenstrain& eigenstrain)
    : SmallTractions(skeleton, cells, eigenstrain),
      moduli_(skeleton.mesh.n_cells()),
      jump_(skeleton, jump_share_),
      bonded_(
          skeleton.mesh, skeleton.unknowns, skeleton.sides,
          [&](Index c) { return !cells.cubic().fits(c) && (cells.relaxes_flat_cells() || !cells.layers().cover(c)); }),
      link_values_(skeleton.links.size()),
      side_values_(skeleton.sides.size()) {}

std::unique_ptr<Sweep> IsotropicTractions::new_sweep() const {
  auto s = std::make_unique<IsotropicSweep>(skeleton_);
  if (cells_.cubic().any()) s->cubic.resize(skeleton_.n_turns());
  s->layers.assign(cells_.layers().has_lines() ? skeleton_.n_turns() : 0, Tensor::Zero());
  s->pressure = cells_.pressure().field();
  s->bonded.resize(bonded_.size());
  if (cells_.pressure().any()) s->flux.resize(skeleton_.n_forces());
  return s;
}

void IsotropicTractions::set(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part) {
  set_moduli(moduli, g, {}, {});
  cells_.weigh(g, part);
  cells_.weigh_third_order(g);
  extrapolate_eigenstrains();
  set_coefficients();
}

void IsotropicTractions::set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g,
                                    const CellField<IsotropicElasticity>& sound, const CellField<char>& relaxes) {
  moduli_ = moduli;
  jump_.renew(moduli_, sound);
  condense();
  cells_.take_over(moduli_, g, sound, relaxes);
  of_stress_ = moduli_;
  cells_.bear_closed_cracks(of_stress_);
  find_initial_stress();
}

void IsotropicTractions::condense() {
  if (!is_plane_stress()) return;
  strain_across_ = CellField<StrainAcross>(moduli_.size());
  if (eigenstrain_.any()) initial_stress_ = CellField<Tensor>(moduli_.size());
  parallel_for(moduli_.size(), [&](Index c) {
    LinearStress whole{.C = stiffness_matrix(moduli_[c]), .initial = Mandel::Zero()};
    if (eigenstrain_.any()) {
      whole.initial = -(whole.C * eigenstrain_[c]);
      initial_stress_[c] = to_tensor(plane_stress(whole, plane_normal()).initial);
    }
    strain_across_[c] = strain_across(whole, plane_normal());
    moduli_[c] = plane_stress(moduli_[c]);
  });
}

// In plane stress it is condensed with the moduli.
void IsotropicTractions::find_initial_stress() {
  if (!eigenstrain_.any() || is_plane_stress()) return;
  initial_stress_ = CellField<Tensor>(moduli_.size());
  parallel_for(moduli_.size(),
               [&](Index c) { initial_stress_[c] = -stress(of_stress_[c], to_tensor(eigenstrain_[c])); });
}

Vector IsotropicTractions::initial_traction(Index cell, const Vector& n, std::size_t turn) const {
  const Vector of_cell = initial_stress(cell) * n;
  return varies_eigenstrain() ? of_cell - stress(of_stress_[cell], eigenstrain_change(turn)) * n : of_cell;
}

void IsotropicTractions::reconstruct(const std::vector<Vector>& u, IsotropicSweep& s) const {
  cells_.find_gradients(u, s.gradients);
  if (cells_.cubic().any()) cells_.cubic().read(u, s.gradients, s.cubic);
  if (cells_.layers().any()) cells_.layers().correct(u, s.gradients, s.layers);
  if (cells_.pressure().any()) cells_.pressure().read(u, s.pressure);
  parallel_for(count_of(bonded_), [&](Index k) {
    const Index c = skeleton_.sides[bonded_.side(k)].cell;
    s.bonded[k] = bonded_.gradient(k, u, s.gradients[c]);
  });
}

void IsotropicTractions::find_linear(const std::vector<Vector>& u, Sweep& sweep) const {
  sweep_faces(u, of(sweep), IsotropicStress{of_stress_});
}

bool IsotropicTractions::add_constant(Sweep& s) const {
  if (!has_initial_stress()) return false;
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Link& link = skeleton_.links[i];
    const Vector on_P = initial_traction(link.P, link.n, FaceSkeleton::turn_P(i));
    const Vector on_N = initial_traction(link.N, link.n, FaceSkeleton::turn_N(i));
    s.force[i] += link.area * (on_N + weigh(i, on_P - on_N));
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Side& side = skeleton_.sides[i];
    s.force[n_links + i] += side.area * initial_traction(side.cell, side.n, skeleton_.turn_of_side(i));
  });
  const Vector& across = plane_normal();
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] += across.dot(initial_stress(c) * across); });
  return true;
}

Tensor IsotropicTractions::gradient_at(Index cell, std::size_t turn, const Sweep& sweep) const {
  const IsotropicSweep& s = of(sweep);
  Tensor gradient = mean_gradient_at(cell, turn, s);
  if (cells_.cubic().any()) gradient += s.cubic[turn].gradient;
  if (cells_.layers().any()) gradient += s.layers[turn];
  return gradient;
}

Vector IsotropicTractions::give(std::size_t i, const Vector& v) const {
  const LinkValues& by = link_values_[i];
  const double sum_n = by.c_n / (by.weight_n * (1.0 - by.weight_n));
  const double sum_t = by.c_t / (by.weight_t * (1.0 - by.weight_t));
  return scale(1.0 / sum_n, 1.0 / sum_t, skeleton_.links[i].n, v);
}

Vector IsotropicTractions::own_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                        const IsotropicSweep& s) const {
  return traction(cell, n, d, turn, s, IsotropicStress{of_stress_});
}

// Equal tractions on both sides: (a + b) u_f = a (u_P + G_P d_P) + b (u_N + G_N d_N) + (sigma_N - sigma_P) n.
Vector IsotropicTractions::link_displacement(std::size_t i, const std::vector<Vector>& u, const Sweep& sweep) const {
  const IsotropicSweep& s = of(sweep);
  const Link& link = skeleton_.links[i];
  const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Vector from_P = u[link.P] + rise(link.P, link.d_P, P, s);
  const Vector from_N = u[link.N] + rise(link.N, link.d_N, N, s);
  Vector stress_jump = own_traction(link.N, link.n, link.d_N, N, s) - own_traction(link.P, link.n, link.d_P, P, s);
  if (has_initial_stress()) stress_jump += initial_jump(i);
  return from_P + weigh(i, from_N - from_P) + give(i, stress_jump);
}

Vector IsotropicTractions::gap(Index cell, const Vector& d, std::size_t turn, const Vector& move,
                               const std::vector<Vector>& u, const Sweep& sweep) const {
  const IsotropicSweep& s = of(sweep);
  Vector gap = move - rise(cell, d, turn, s);
  if (skeleton_.is_side(turn) || !cells_.layers().weighs(turn / 2)) return gap;
  const std::size_t i = turn / 2, P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Link& link = skeleton_.links[i];
  const Vector jump = u[link.N] + rise(link.N, link.d_N, N, s) - u[link.P] - rise(link.P, link.d_P, P, s);
  const Vector idle = jump - cells_.layers().weight(i) * jump;
  return gap - FaceSkeleton::idle_share(turn, idle, weigh(i, idle));
}

Tensor IsotropicTractions::softness_of_side(std::size_t i) const {
  const Vector& n = skeleton_.sides[i].n;
  const Tensor along = n * n.transpose();
  return along / side_values_[i].a_n + (Tensor::Identity() - along) / side_values_[i].a_t;
}

Tensor IsotropicTractions::with_strain_across(Index cell, const Tensor& gradient) const {
  if (!is_plane_stress()) return gradient;
  const Vector& n = plane_normal();
  return gradient + strain_across_[cell](to_mandel(symmetric_part(gradient))) * n * n.transpose();
}

double IsotropicTractions::stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const {
  if (is_plane_stress()) return 0.0;
  const double by_strain = of_stress_[cell].lambda * strain.trace() + of(sweep).pressure.mean(cell);
  return eigenstrain_.any() ? by_strain + plane_normal().dot(initial_stress_[cell] * plane_normal()) : by_strain;
}

double IsotropicTractions::energy_of_part(Index cell, const IsotropicElasticity& part, const Tensor& strain,
                                          const FaceMoves& moves) const {
  if (!(part.mu > 0.0 || part.lambda > 0.0)) return 0.0;
  const IsotropicSweep& s = of(moves.sweep);
  const auto at = [&](std::size_t turn, const Vector& d, const Vector& n, const Vector& move) -> Tensor {
    const Tensor in_cell = varies_at(turn) ? gradient_at(cell, turn, s) : s.gradients[cell];
    const double h = bounded_height(d, n) / stiffer_at(turn);
    return in_cell + gap(cell, d, turn, move, moves.u, s) * n.transpose() / h;
  };
  return energy_over_faces(cell, with_jump_modulus(cell, part), strain, moves, at);
}

}  // namespace pfdm
