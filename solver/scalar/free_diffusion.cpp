#include "solver/scalar/free_diffusion.h"

#include "physics/error.h"
#include "solver/parallel.h"
#include "solver/scalar/diffusion_exchanges.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

std::vector<DiffusionBoundary> homogeneous(std::vector<DiffusionBoundary> boundary) {
  for (DiffusionBoundary& on : boundary) on.value = 0.0;
  return boundary;
}

}  // namespace

FreeDiffusion::FreeDiffusion(const Mesh& mesh, const CellField<double>& conductivity, const CellField<double>& capacity,
                             std::vector<DiffusionBoundary> boundary, double dt, double precision)
    : flux_(mesh, {.conductance = conductivity, .exchanges = exchanges_of(mesh, homogeneous(std::move(boundary)))}),
      stored_(mesh.n_cells()),
      precision_(precision) {
  for (Index c = 0; c < mesh.n_cells(); ++c) stored_[c] = capacity[c] * mesh.cell_volume[c] / dt;
  factors_.compute(two_point_part());
  if (factors_.info() != Eigen::Success) throw ComputationError("the matrix of a step of diffusion cannot be factored");
}

Eigen::SparseMatrix<double> FreeDiffusion::two_point_part() const {
  std::vector<Eigen::Triplet<double>> lower;
  for (Index c = 0; c < stored_.size(); ++c) lower.emplace_back(c, c, flux_.diagonal(c) + stored_[c]);
  for (const TwoPointFlux::Link& link : flux_.links())
    lower.emplace_back(std::max(link.P, link.N), std::min(link.P, link.N), -link.coefficient);
  Eigen::SparseMatrix<double> matrix(stored_.size(), stored_.size());
  matrix.setFromTriplets(lower.begin(), lower.end());
  return matrix;
}

// The deferred flux is updated until the field no longer changes.
bool FreeDiffusion::step(CellField<double>& u) {
  constexpr int most_updates = 100;
  const CellField<double> start = u;
  Eigen::VectorXd left(u.size());
  for (int update = 0; update < most_updates; ++update) {
    flux_.renew_correction(u);
    parallel_for(u.size(), [&](Index c) { left[c] = -flux_.balance(c, u, stored_[c] * (u[c] - start[c])); });
    const Eigen::VectorXd change = factors_.solve(left);
    double most = 0.0, size = 0.0;
    for (Index c = 0; c < u.size(); ++c) {
      u[c] += change[c];
      most = std::max(most, std::abs(change[c]));
      size = std::max(size, std::abs(u[c]));
    }
    if (!change.allFinite()) return false;
    if (most <= precision_ * size) return true;
  }
  return false;
}

}  // namespace pfdm
