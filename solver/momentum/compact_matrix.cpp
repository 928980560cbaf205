// The compact matrix of the momentum balance (momentum.h).

#include "solver/momentum/momentum.h"

#include <numeric>

namespace pfdm {
namespace {

// Makes the matrix diagonal in the direction n. Nothing else may hold the body there, so it could be singular.
void decouple(const Vector& n, BlockTriplets& matrix) {
  const Tensor along = n * n.transpose(), across = Tensor::Identity() - along;
  for (Tensor& block : matrix.diagonal) {
    const Tensor kept = across * block * across;
    block = kept + (block.trace() - kept.trace()) * along;
  }
  for (auto& entry : matrix.off_diagonal) entry.value = across * entry.value * across;
}

// Row of each node: that of an image is the one of its node.
std::vector<Index> rows(const Unknowns& unknowns) {
  std::vector<Index> row(unknowns.n_nodes());
  std::iota(row.begin(), row.end(), Index{0});
  for (const PeriodicNodes& pair : unknowns.periodic) row[pair.image] = pair.node;
  return row;
}

void add_links(const FaceSkeleton& skeleton, const FaceTractions& tractions, BlockTriplets& matrix) {
  for (std::size_t i = 0; i < skeleton.links.size(); ++i) {
    const momentum_faces::Link& link = skeleton.links[i];
    const Tensor c = tractions.compact_link(i);
    matrix.diagonal[link.P] += c;
    matrix.diagonal[link.N] += c;
    matrix.off_diagonal.push_back({link.P, link.N, -c});
  }
}

void add_sides(const FaceSkeleton& skeleton, const FaceTractions& tractions, BlockTriplets& matrix) {
  const std::vector<Index> row = rows(skeleton.unknowns);
  for (std::size_t i = 0; i < skeleton.sides.size(); ++i) {
    const momentum_faces::Side& side = skeleton.sides[i];
    const Tensor a = tractions.compact_side(i);
    const Tensor& is_free = skeleton.unknowns.free_directions[skeleton.number_of(side.node)];
    const Index node = row[side.node];
    matrix.diagonal[side.cell] += a;
    matrix.diagonal[node] += is_free * a * is_free + a.trace() / 3.0 * (Tensor::Identity() - is_free);
    if (!is_free.isZero()) matrix.off_diagonal.push_back({side.cell, node, -a * is_free});
    if (node != side.node) matrix.diagonal[side.node] = a.trace() / 3.0 * Tensor::Identity();
  }
}

// Adds the pull of the stretch across the sector, which a displacement along r makes.
void add_sector(const FaceSkeleton& skeleton, const FaceTractions& tractions, BlockTriplets& matrix) {
  const Vector& r = skeleton.unknowns.radial;
  for (Index c = 0; c < skeleton.sector_area.size(); ++c)
    matrix.diagonal[c] += skeleton.sector_area[c].norm() * tractions.hoop_modulus(c) /
                          r.dot(skeleton.mesh.cell_centre[c]) * r * r.transpose();
}

}  // namespace

BlockTriplets MomentumOperator::compact_matrix() const {
  const Unknowns& unknowns = skeleton_->unknowns;
  BlockTriplets matrix;
  matrix.diagonal.assign(unknowns.n_nodes(), Tensor::Zero());
  matrix.off_diagonal.reserve(skeleton_->n_forces());
  add_links(*skeleton_, *tractions_, matrix);
  add_sides(*skeleton_, *tractions_, matrix);
  springs_.add_to(matrix);
  loads_.add_to(matrix);
  add_sector(*skeleton_, *tractions_, matrix);
  if (!unknowns.plane_normal.isZero()) decouple(unknowns.plane_normal, matrix);
  return matrix;
}

}  // namespace pfdm
