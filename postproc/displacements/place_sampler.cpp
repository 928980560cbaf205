#include "postproc/displacements/place_sampler.h"

#include <algorithm>
#include <limits>
#include <map>

namespace pfdm {
namespace {

std::vector<Box> boxes_of(const Mesh& mesh) {
  std::vector<Box> boxes;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Box box{mesh.cell_centre[c], mesh.cell_centre[c]};
    for (const Index p : mesh.points_of_cell(c))
      box = {box.low.cwiseMin(mesh.points[p]), box.high.cwiseMax(mesh.points[p])};
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

CellLocator::CellLocator(const Mesh& mesh) : mesh_(mesh), tree_(boxes_of(mesh)) {}

double CellLocator::beyond(Index cell, const Vector& x) const {
  double most = 0.0;
  for (const Index f : mesh_.faces_of_cell(cell))
    most = std::max(most, mesh_.outward_area(f, cell).normalized().dot(x - mesh_.face_centre[f]));
  return most;
}

std::pair<Index, double> CellLocator::cell_at(const Vector& x) const {
  std::pair<Index, double> best{-1, std::numeric_limits<double>::infinity()};
  tree_.search(x, [&](Index cell) {
    const double distance = beyond(cell, x);
    if (distance < best.second) best = {cell, distance};
    return best.second;
  });
  return best;
}

PlaceSampler::PlaceSampler(const Mesh& mesh, const std::vector<FieldPlace>& places) {
  const CellLocator locator(mesh);
  for (const FieldPlace& place : places) {
    std::map<Index, Share> shares;
    const double weight = 1.0 / static_cast<double>(place.points.size());
    for (const Vector& x : place.points) {
      const Index cell = locator.cell_at(x).first;
      Share& share = shares.try_emplace(cell, Share{cell, 0.0, Vector::Zero()}).first->second;
      share.weight += weight;
      share.arm += weight * (x - mesh.cell_centre[cell]);
    }
    std::vector<Share>& of_place = shares_.emplace_back();
    for (const auto& [cell, share] : shares) of_place.push_back(share);
  }
}

std::vector<Vector> PlaceSampler::operator()(const CellField<Vector>& displacement,
                                             const CellField<Tensor>& gradient) const {
  std::vector<Vector> means;
  for (const std::vector<Share>& place : shares_) {
    Vector mean = Vector::Zero();
    for (const Share& s : place) mean += s.weight * displacement[s.cell] + gradient[s.cell] * s.arm;
    means.push_back(mean);
  }
  return means;
}

}  // namespace pfdm
