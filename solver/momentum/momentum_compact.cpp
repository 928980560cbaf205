// The compact matrix of the momentum balance (momentum.h).

#include "solver/momentum/acoustic_tensor.h"
#include "solver/momentum/momentum.h"

#include <numeric>

namespace pfdm {
namespace {

Tensor scaling(double along, double across, const Vector& n) {
  return across * Tensor::Identity() + (along - across) * n * n.transpose();
}

// Makes the matrix diagonal in the direction n. Nothing else may hold the body there, so it could be singular.
void decouple(const Vector& n, BlockTriplets& matrix) {
  const Tensor along = n * n.transpose(), across = Tensor::Identity() - along;
  for (Tensor& block : matrix.diagonal) {
    const Tensor kept = across * block * across;
    block = kept + (block.trace() - kept.trace()) * along;
  }
  for (auto& entry : matrix.off_diagonal) entry.value = across * entry.value * across;
}

}  // namespace

Tensor MomentumOperator::compact_link(std::size_t i) const {
  const Link& link = links_[i];
  const double h_P = bounded_height(link.d_P, link.n), h_N = bounded_height(link.d_N, link.n);
  if (has_law()) return link.area * in_series(side_laws_[turn_P(i)].acoustic, h_P, side_laws_[turn_N(i)].acoustic, h_N);
  if (!is_isotropic()) return link.area * jump_tensor(link, h_P, h_N);
  const IsotropicElasticity &P = moduli_[link.P], &N = moduli_[link.N];
  const double full = 1.0 / (h_P / P.constrained_modulus() + h_N / N.constrained_modulus());
  const double along = jump_stiffness(link.P, link.N, h_P, h_N, full);
  const double across = slip_stiffness(link.P, link.N, full, 1.0 / (h_P / P.mu + h_N / N.mu));
  return link.area * scaling(along, across, link.n);
}

Tensor MomentumOperator::compact_side(std::size_t i) const {
  const Side& side = sides_[i];
  const double h = bounded_height(side.d, side.n);
  if (has_law()) return (side.area / h) * side_laws_[turn_of_side(i)].acoustic;
  if (!is_isotropic()) return (side.area / h) * side_acoustic(i);
  return (stiffer_at(turn_of_side(i)) * side.area / h) *
         scaling(jump_modulus(side.cell), moduli_[side.cell].mu, side.n);
}

// What a displacement along r stretches across the sector pulls back.
Tensor MomentumOperator::compact_sector(Index cell) const {
  const Vector &r = unknowns_.radial, &across = unknowns_.plane_normal;
  const double modulus =
      is_isotropic() ? moduli_[cell].constrained_modulus() : across.dot(acoustic(cell, across) * across);
  return sector_area_[cell].norm() * modulus / r.dot(mesh_.cell_centre[cell]) * r * r.transpose();
}

BlockTriplets MomentumOperator::compact_matrix() const {
  std::vector<Index> row(as_size(unknowns_.n_nodes()));
  std::iota(row.begin(), row.end(), Index{0});
  for (const PeriodicNodes& pair : unknowns_.periodic) row[as_size(pair.image)] = pair.node;
  BlockTriplets matrix;
  matrix.diagonal.assign(as_size(unknowns_.n_nodes()), Tensor::Zero());
  matrix.off_diagonal.reserve(links_.size() + sides_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const Tensor c = compact_link(i);
    matrix.diagonal[as_size(link.P)] += c;
    matrix.diagonal[as_size(link.N)] += c;
    matrix.off_diagonal.push_back({link.P, link.N, -c});
  }
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    const Tensor a = compact_side(i);
    const Tensor& is_free = unknowns_.free_directions[as_size(side.node - unknowns_.n_cells)];
    const Index node = row[as_size(side.node)];
    matrix.diagonal[as_size(side.cell)] += a;
    matrix.diagonal[as_size(node)] += is_free * a * is_free + a.trace() / 3.0 * (Tensor::Identity() - is_free);
    if (!is_free.isZero()) matrix.off_diagonal.push_back({side.cell, node, -a * is_free});
    if (node != side.node) matrix.diagonal[as_size(side.node)] = a.trace() / 3.0 * Tensor::Identity();
  }
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const SplitFace& face = split_faces_[k];
    const Tensor s = face.area * springs_[k].secant;
    matrix.diagonal[as_size(face.node)] += s;
    matrix.diagonal[as_size(face.beyond)] += s;
    matrix.off_diagonal.push_back({face.node, face.beyond, -s});
  }
  for (Index c = 0; c < sector_area_.size(); ++c) matrix.diagonal[as_size(c)] += compact_sector(c);
  if (!unknowns_.plane_normal.isZero()) decouple(unknowns_.plane_normal, matrix);
  return matrix;
}

}  // namespace pfdm
