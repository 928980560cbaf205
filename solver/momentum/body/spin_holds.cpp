#include "solver/momentum/body/spin_holds.h"

#include "solver/momentum/body/unknowns.h"
#include "solver/parallel.h"

#include <Eigen/Eigenvalues>

namespace pfdm {
namespace {

constexpr double unseen = 1e-6;         // square of a lever, over the sum of those of all faces
constexpr double torsion_share = 0.14;  // of a square's area squared: its torsion constant

Tensor cross_matrix(const Vector& b) {
  Tensor K;
  K << 0.0, -b[2], b[1], b[2], 0.0, -b[0], -b[1], b[0], 0.0;
  return K;
}

Tensor prescribed_on(const Unknowns& unknowns, Index node) {
  return node < 0 ? Tensor::Zero() : Tensor(Tensor::Identity() - unknowns.free_directions[node - unknowns.n_cells]);
}

// Projector onto the rotations of a cell that no face resists; zero almost everywhere.
Tensor unseen_spins(const Mesh& mesh, const Unknowns& unknowns, Index c) {
  if (mesh.shape[c] == CellShape::tetrahedron) return Tensor::Zero();
  Tensor seen = Tensor::Zero();
  double levers = 0.0;
  for (const Index f : mesh.faces_of_cell(c)) {
    const Vector d = mesh.face_centre[f] - mesh.cell_centre[c];
    const Tensor K = cross_matrix(d);
    levers += d.squaredNorm();
    seen += K.transpose() *
            (mesh.is_interior(f) ? Tensor::Identity() : prescribed_on(unknowns, unknowns.node_of_face[f])) * K;
  }
  const Vector& n = unknowns.plane_normal;
  if (!n.isZero()) seen += levers * (Tensor::Identity() - n * n.transpose());
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(seen);
  Tensor free = Tensor::Zero();
  for (Index i = 0; i < 3; ++i)
    if (eigen.eigenvalues()[i] <= unseen * levers)
      free += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose();
  return free;
}

class Holds {
 public:
  Holds(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns), free_(mesh.n_cells()) {
    parallel_for(mesh.n_cells(), [&](Index c) { free_[c] = unseen_spins(mesh, unknowns, c); });
  }

  std::vector<SpinHold> find() {
    for (Index c = 0; c < mesh_.n_cells(); ++c) {
      if (free_[c].isZero()) continue;
      for (const Index f : mesh_.faces_of_cell(c)) mesh_.is_interior(f) ? join(c, f) : hold(c, f);
    }
    return std::move(holds_);
  }

 private:
  // About each of the directions in which the cell is free to turn.
  void join(Index c, Index f) {
    const Index other = mesh_.across(f, c);
    const bool is_cut = unknowns_.is_split(f);
    if (is_cut || (!free_[other].isZero() && mesh_.owner[f] != c)) return;
    const double area = mesh_.face_area[f].norm(), apart = (mesh_.cell_centre[other] - mesh_.cell_centre[c]).norm();
    for (const Vector& b : axes_of(free_[c]))
      holds_.push_back({.cell = c,
                        .beyond = other,
                        .of_cell = 0.5 * cross_matrix(b),
                        .stiffness = torsion_share * area * area / apart});
  }

  void hold(Index c, Index f) {
    const Vector n = mesh_.face_area[f].normalized();
    const double area = mesh_.face_area[f].norm(), h = std::abs((mesh_.face_centre[f] - mesh_.cell_centre[c]).dot(n));
    for (const Vector& held : axes_of(prescribed_on(unknowns_, unknowns_.node_of_face[f])))
      for (const Vector& along : axes_of(Tensor::Identity() - n * n.transpose())) {
        const Vector lever = free_[c] * along.cross(held);
        if (lever.squaredNorm() < unseen) continue;
        holds_.push_back({.cell = c,
                          .of_cell = held * along.transpose(),
                          .stiffness = area * area / (6.0 * h),
                          .lever = lever,
                          .face = f,
                          .held = held,
                          .along = along});
      }
  }

  static std::vector<Vector> axes_of(const Tensor& projector) {
    const Eigen::SelfAdjointEigenSolver<Tensor> eigen(projector);
    std::vector<Vector> axes;
    for (Index i = 0; i < 3; ++i)
      if (eigen.eigenvalues()[i] > 0.5) axes.emplace_back(eigen.eigenvectors().col(i));
    return axes;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  CellField<Tensor> free_;
  std::vector<SpinHold> holds_;
};

}  // namespace

std::vector<SpinHold> spin_holds(const Mesh& mesh, const Unknowns& unknowns) { return Holds(mesh, unknowns).find(); }

}  // namespace pfdm
