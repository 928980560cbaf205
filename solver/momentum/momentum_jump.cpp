// The stiffness c of the jump term on faces between polyhedra (momentum.h), which differs from that of the tractions.

#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

// Tangential stiffness of the faces between polyhedra with closed cracks, over c along the normal. Measured on
// glass_bead_quick: with 0.01 some solves still do not converge, from 0.025 to 0.3 all do and the forces agree. Cells
// beside tetrahedra have none, which takes fewer staggered iterations.
constexpr double slip_share = 0.05;

}  // namespace

CellField<double> MomentumOperator::jump_shares(const Mesh& mesh, const Unknowns& unknowns) {
  CellField<double> share(as_size(mesh.n_cells()), 1.0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const IsotropicElasticity& sound = unknowns.sound[as_size(unknowns.zone[c])];
    const IsotropicElasticity seen = unknowns.plane_stress ? plane_stress(sound) : sound;
    if (mesh.shape[c] == CellShape::polyhedron)
      share[c] = std::min(1.0, (moderate_lambda + 2.0) * seen.mu / seen.constrained_modulus());
  }
  for (const Index c : unknowns.pressure_cells) share[c] = 1.0;
  return share;
}

// From 0 in undamaged polyhedra and open cracks to 1 in closed cracks, which keep only the bulk modulus. Computed from
// the given moduli, before plane stress or pressures change them.
void MomentumOperator::renew_liquidity() {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (mesh_.shape[c] != CellShape::polyhedron) return;
    const IsotropicElasticity& sound = unknowns_.sound[as_size(unknowns_.zone[c])];
    const double stiffer = moduli_[c].bulk_modulus() * sound.mu / (sound.bulk_modulus() * moduli_[c].mu);
    liquidity_[c] = std::max(0.0, 1.0 - 1.0 / stiffer);
  });
}

// lambda_s + 2 mu.
double MomentumOperator::jump_modulus(Index cell) const {
  const double share = jump_share_[cell] + liquidity_[cell] * (1.0 - jump_share_[cell]);
  return share * moduli_[cell].constrained_modulus();
}

// A part of the stiffness with the same share of lambda + 2 mu as the jump has of the whole. A pressure carries what is
// beyond lambda_s; it hardly varies within a cell.
IsotropicElasticity MomentumOperator::with_jump_modulus(Index cell, IsotropicElasticity part) const {
  if (part.lambda <= 0.0) return part;
  part.lambda = jump_share_[cell] * part.constrained_modulus() - 2.0 * part.mu;
  if (pressure_.modulus(cell) > 0.0) part.lambda = std::min(part.lambda, CellPressure::moderate_lambda * part.mu);
  return part;
}

// Along the normal of the face between P and N; `full` is the value with the full lambda.
double MomentumOperator::jump_stiffness(Index P, Index N, double h_P, double h_N, double full) const {
  if (mesh_.shape[P] != CellShape::polyhedron && mesh_.shape[N] != CellShape::polyhedron) return full;
  const double mu_P = moduli_[P].mu, mu_N = moduli_[N].mu;
  const double theta = 1.0 - std::min(mu_P, mu_N) / std::max(mu_P, mu_N);
  const double small = 1.0 / (h_P / jump_modulus(P) + h_N / jump_modulus(N));
  return small + theta * (full - small);
}

// Along the face.
double MomentumOperator::slip_stiffness(Index P, Index N, double c_n, double c_t) const {
  return c_t + slip_share * std::min(liquidity_[P], liquidity_[N]) * c_n;
}

void MomentumOperator::relax_flat_cells() {
  has_relaxed_flat_cells_ = true;
  // With two layers, modes of coarse meshes were far from orthogonal.
  constexpr Index least_layers = 3;
  std::vector<BendingCell> cells = cells_of_layers(mesh_, unknowns_);
  std::erase_if(cells, [&](const BendingCell& in) {
    return cubic_.fits(in.cell) || cells_through(mesh_, unknowns_, in.cell, in.across) < least_layers;
  });
  layers_ = LayerGradients(mesh_, unknowns_, sides_by_turn(), links_, cells);
}

// In bending, the shear strain on the faces across a plate and on those along it must agree. With the jump part alpha
// of the former they differ by alpha h_n^2/4 times the second derivative of the slope, h_n being the distance of the
// cells' centres across the face: the shear stiffness times that is added to the bending stiffness, 1.5 (1 - nu) alpha
// (h_n/h)^2 of it in a plate of thickness h. Layers of thickness t, on the other hand, leave out the bending within
// each of them and weight the free surface's gradient by two thirds instead of half: -(3 - 2 t/h) (t/h)^2. Both cancel
// for the alpha below, at any thickness of the plate. Cells that are not flat have alpha = 1.
double MomentumOperator::bending_part(const Link& link) const {
  constexpr double both = 1.8;  // 2 (1 - 2 t/(3 h)) with six to eight layers
  const auto thickness = [&](Index cell) {
    double largest = 0.0;
    for (const Index f : mesh_.faces_of_cell(cell)) largest = std::max(largest, mesh_.face_area[f].norm());
    return mesh_.cell_volume[cell] / largest;
  };
  const double across = (link.d_P - link.d_N).dot(link.n);
  const double flatness = std::min(thickness(link.P), thickness(link.N)) / across;
  const IsotropicElasticity& sound = unknowns_.sound[as_size(unknowns_.zone[link.P])];
  return std::min(1.0, both / (1.0 - sound.poisson_ratio()) * flatness * flatness);
}

}  // namespace pfdm
