#include "solver/momentum/faces/bonded_sides.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pfdm {
namespace {

// Hexahedra and prisms behind their ends have another face opposite to this one, with the same direction across both.
bool has_opposite(const Mesh& mesh, const momentum_faces::Side& side) {
  const CellShape shape = mesh.shape[side.cell];
  return shape == CellShape::hexahedron || (shape == CellShape::wedge && mesh.points_of_face(side.face).size() == 3);
}

// Faces of each point, of one patch.
class FacesOfPoints {
 public:
  FacesOfPoints(const Mesh& mesh, const Patch& patch) : mesh_(mesh), faces_(mesh.points.size()) {
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      for (const Index p : mesh.points_of_face(f)) faces_[p].push_back(f);
  }

  std::vector<Index> around(Index face) const {
    std::vector<Index> all;
    for (const Index p : mesh_.points_of_face(face))
      for (const Index f : faces_[p])
        if (f != face) all.push_back(f);
    std::ranges::sort(all);
    const auto rest = std::ranges::unique(all);
    all.erase(rest.begin(), rest.end());
    return all;
  }

 private:
  const Mesh& mesh_;
  std::vector<std::vector<Index>> faces_;
};

// Its inverse where it has one.
Tensor pseudo_inverse(const Tensor& moment) {
  constexpr double least = 1e-3;
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(moment);
  Tensor inverse = Tensor::Zero();
  for (Index i = 0; i < 3; ++i) {
    const double value = eigen.eigenvalues()[i];
    const Vector along = eigen.eigenvectors().col(i);
    if (value > least * eigen.eigenvalues()[2]) inverse += along * along.transpose() / value;
  }
  return inverse;
}

}  // namespace

BondedSides::BondedSides(const Mesh& mesh, const Unknowns& unknowns, const std::vector<momentum_faces::Side>& sides,
                         const std::function<bool(Index cell)>& may_be) {
  if (unknowns.pressure_cells.empty()) return;
  std::vector<char> has_pressure(mesh.n_cells(), 0);
  for (const Index c : unknowns.pressure_cells) has_pressure[c] = may_be(c) ? 1 : 0;
  number_.assign(sides.size(), -1);
  if (unknowns.is_axisymmetric()) {
    radial_ = unknowns.radial, across_ = unknowns.plane_normal;
    hoop_ = across_ * across_.transpose();
  }
  std::vector<Index> side_of_face(mesh.n_faces(), -1);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!mesh.is_interior(sides[i].face) && has_pressure[sides[i].cell] != 0 && has_opposite(mesh, sides[i]) &&
        unknowns.free_within(sides[i].node).isZero())
      side_of_face[sides[i].face] = static_cast<Index>(i);
  for (const Patch& patch : mesh.patches) {
    const Index end = patch.first_face + patch.n_faces;
    if (std::all_of(side_of_face.begin() + patch.first_face, side_of_face.begin() + end, [](Index i) { return i < 0; }))
      continue;
    const FacesOfPoints faces(mesh, patch);
    for (Index f = patch.first_face; f < end; ++f) {
      const Index i = side_of_face[f];
      if (i < 0) continue;
      number_[i] = static_cast<Index>(size());
      side_.push_back(i);
      add(mesh, unknowns, sides[i], faces.around(f));
    }
  }
  if (size() == 0) number_.clear();
}

void BondedSides::add(const Mesh& mesh, const Unknowns& unknowns, const momentum_faces::Side& side,
                      const std::vector<Index>& neighbours) {
  const Tensor within = Tensor::Identity() - side.n * side.n.transpose();
  constexpr double cosine = 0.7;  // of faces beyond an edge of the patch
  node_.push_back(side.node);
  if (unknowns.is_axisymmetric()) radius_.push_back(radial_.dot(mesh.face_centre[side.face]));
  Tensor moment = Tensor::Zero();
  const std::size_t first = samples_.size();
  for (const Index f : neighbours) {
    const Index node = unknowns.node_of_face[f];
    if (node < 0 || !unknowns.free_within(node).isZero()) continue;
    if (std::abs(mesh.face_area[f].normalized().dot(side.n)) < cosine) continue;
    const Vector d = mesh.face_centre[f] - mesh.face_centre[side.face], along = within * d;
    const double weight = 1.0 / d.squaredNorm();
    samples_.push_back({.node = node, .d = d, .coefficient = weight * along});
    moment += weight * along * along.transpose();
  }
  const Tensor inverse = pseudo_inverse(moment);
  for (std::size_t s = first; s < samples_.size(); ++s) samples_[s].coefficient = inverse * samples_[s].coefficient;
  offsets_.push_back(samples_.size());
}

}  // namespace pfdm
