// The pressures of nearly incompressible cells (cell_pressure.h) in the momentum balance: their rows and their
// preconditioner.

#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

namespace pfdm {

// u_f.S of a link from what its traction is made of, [m^3].
double MomentumOperator::link_flux(std::size_t i, const Vector& u_P, const Vector& jump,
                                   const Vector& stress_jump) const {
  const Link& link = links_[i];
  const double softness = link.weight_n * (1.0 - link.weight_n) / link.c_n;
  const double u_n = link.n.dot(u_P) + link.weight_n * link.n.dot(jump) + softness * link.n.dot(stress_jump);
  const Tensor G = 0.5 * (gradients_[link.P] + gradients_[link.N]);
  return link.area * u_n + pressure_.flux_of_warp(link.face, G);
}

double MomentumOperator::side_flux(const Side& side, const Vector& u_f) const {
  const double sign = mesh_.owner[side.face] == side.cell ? 1.0 : -1.0;
  return side.area * side.n.dot(u_f) + sign * pressure_.flux_of_warp(side.face, gradients_[side.cell]);
}

// V q / (lambda - lambda_s) - sum of u_f.S. There is no flux through the sector's own faces.
void MomentumOperator::balance_pressures(std::vector<Vector>& out) const {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    double sum = 0.0;
    for (std::size_t j = cell_offsets_[as_size(c)]; j < cell_offsets_[as_size(c) + 1]; ++j)
      sum += cell_forces_[j].sign * flux_[as_size(cell_forces_[j].force)];
    out[as_size(unknowns_.n_nodes() + k)] =
        (mesh_.cell_volume[c] * pressure_.mean(c) / pressure_.modulus(c) - sum) * Vector::UnitX();
  });
}

// What eigenstrains add to these rows: V tr eps*, less the fluxes of what their tractions move the faces by.
void MomentumOperator::take_away_initial_volumes(std::vector<Vector>& load) const {
  std::vector<double> flux(forces_.size(), 0.0);
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) {
    const Link& link = links_[as_size(i)];
    const double softness = link.weight_n * (1.0 - link.weight_n) / link.c_n;
    const Vector apart = (initial_stress(link.N) - initial_stress(link.P)) * link.n;
    flux[as_size(i)] = link.area * softness * link.n.dot(apart);
  });
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    double sum = 0.0;
    for (std::size_t j = cell_offsets_[as_size(c)]; j < cell_offsets_[as_size(c) + 1]; ++j)
      sum += cell_forces_[j].sign * flux[as_size(cell_forces_[j].force)];
    const double freely = mesh_.cell_volume[c] * to_tensor(eigenstrain_[c]).trace();
    load[as_size(unknowns_.n_nodes() + k)] -= (freely - sum) * Vector::UnitX();
  });
}

std::vector<double> MomentumOperator::pressure_compliance() const {
  // Of the displacements' response to a pressure, times lambda_s + 2 mu: between 1, of smooth pressures in the
  // continuum, and what the damping of rough ones adds. Measured: 3 to 5 take the fewest iterations, 1 half as many
  // again.
  constexpr double answer = 4.0;
  std::vector<double> compliance;
  for (std::size_t k = 0; k < unknowns_.pressure_cells.size(); ++k) {
    const Index c = unknowns_.pressure_cells[k];
    const double own = is_finite() ? volume_rows_[k].slope : 1.0 / pressure_.modulus(c);
    const IsotropicElasticity& moduli = is_finite() ? finite_[c].face : moduli_[c];
    compliance.push_back(mesh_.cell_volume[c] * (own + answer / moduli.constrained_modulus()));
  }
  return compliance;
}

void MomentumOperator::take_away_pressure_forces(const std::vector<Vector>& q, std::vector<Vector>& r) const {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  CellField<double> tension(as_size(mesh_.n_cells()), 0.0);
  for (std::size_t k = 0; k < cells.size(); ++k) tension[cells[k]] = q[as_size(unknowns_.n_nodes()) + k][0];
  if (is_finite())
    find_finite_pressure_forces(tension);
  else
    find_pressure_forces(tension);
  std::vector<Vector> of_pressures(r.size());
  sum_forces(of_pressures);
  parallel_for(unknowns_.n_nodes(), [&](Index i) { r[as_size(i)] -= of_pressures[as_size(i)]; });
}

void MomentumOperator::find_pressure_forces(const CellField<double>& tension) const {
  const auto n_links = static_cast<Index>(links_.size());
  parallel_for(n_links, [&](Index i) {
    const Link& link = links_[as_size(i)];
    const double on_face = tension[link.N] + link.weight_n * (tension[link.P] - tension[link.N]);
    forces_[as_size(i)] = (link.area * on_face) * link.n;
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    forces_[as_size(n_links + i)] = (side.area * tension[side.cell]) * side.n;
  });
  parallel_for(sector_stress_.size(), [&](Index c) { sector_stress_[c] = tension[c]; });
}

}  // namespace pfdm
