#pragma once
// Cell gradients by weighted least squares, exact for linear fields: grad u = sum_j (u_j - u_P) (x) c_j.
//
// Samples are neighbours of the same zone and the nodes on the cell's faces. Tetrahedra, and on request the triangles
// of a plane mesh, use two rings of face neighbours with weight |d|^-2, all other cells one ring with |d|^-3: two rings
// on flat curved prisms give wrong stresses. With one ring tetrahedra do not converge, and elasticity on flat triangles
// is indefinite. The weight of a neighbour is multiplied by min(1, g_j/g_P), so that a broken cell does not bridge into
// a sound one; g_j is that of the cell between, where this is less, so that nothing is sampled across a crack. For a
// polyhedron the factor is min(g_P/g_j, g_j/g_P), small for
// any neighbour of very different damage: its jump term, weaker than the averaged tractions (momentum.h), does not
// cancel a wrong gradient of the broken cell either.

#include "mesh/mesh.h"

#include <vector>

namespace pfdm {

struct GradientSettings {
  CellField<Index> zone;                 ///< cells of the same zone sample each other
  FaceField<Index> node_of_face;         ///< sample nodes on faces (-1: none), numbered from n_cells on; or empty
  FaceField<Index> neighbour_node{};     ///< of the neighbour's side, where the sides have nodes of their own; likewise
  FaceField<char> cut{};                 ///< nonzero: the cells beside the face do not sample each other; or empty
  CellField<Vector> shift{};             ///< of the point of a cell's value from the cell's centre [m]; or empty
  Vector plane_normal = Vector::Zero();  ///< direction in which the gradient is zero, if any
  bool wide_triangles = false;           ///< two rings for prisms whose triangles are normal to plane_normal
  std::vector<char> wanted;              ///< nonzero for cells whose gradient is needed; empty: all
  bool zero_if_deficient = false;        ///< too few neighbours: gradient zero; otherwise InputError
};

/// A value that a gradient is made of.
struct GradientSample {
  Index node = 0;
  Index through = -1;  ///< the cell of the ring before, if that is not the cell itself
};

class Gradient {
 public:
  Gradient(const Mesh& mesh, const GradientSettings& settings);

  /// Rebuilds the coefficients where a stiffness factor g in a cell's neighbourhood has changed by more than this
  /// fraction since they were built. Any weights are exact for linear fields.
  void update(const CellField<double>& g, double part = 0.0);

  Tensor of(const Vector* u, Index cell) const {
    Tensor gradient = Tensor::Zero();
    const Vector here = u[cell];
    for (std::size_t s = begin(cell); s < end(cell); ++s)
      gradient.noalias() += (u[sample_[s]] - here) * coefficient_[s].transpose();
    return gradient;
  }

  /// The transpose: adds to v what forces that do the work B : grad u are at the samples and at the cell.
  void spread(Index cell, const Tensor& B, std::vector<Vector>& v) const {
    for (std::size_t s = begin(cell); s < end(cell); ++s) {
      const Vector force = B * coefficient_[s];
      v[sample_[s]] += force;
      v[cell] -= force;
    }
  }

  Vector of(const double* d, Index cell) const {
    Vector gradient = Vector::Zero();
    for (std::size_t s = begin(cell); s < end(cell); ++s) gradient += (d[sample_[s]] - d[cell]) * coefficient_[s];
    return gradient;
  }

  Index n_cells() const { return count_of(offsets_) - 1; }

 private:
  std::size_t begin(Index cell) const { return offsets_[cell]; }
  std::size_t end(Index cell) const { return offsets_[cell + 1]; }
  void build(Index cell, const CellField<double>* g);
  double trust(Index cell, std::size_t sample, const CellField<double>& g) const;
  bool has_full_rank(Index cell, const std::vector<GradientSample>& samples) const;

  std::vector<std::size_t> offsets_;
  std::vector<Index> sample_;
  std::vector<Index> through_;       // GradientSample::through
  std::vector<Vector> coefficient_;  // [1/m]
  std::vector<Vector> node_;         // position of every node [m]
  std::vector<bool> wide_;           // two rings, |d|^-2
  std::vector<bool> polyhedron_;
  CellField<double> g_;  // that the coefficients were built for
  Vector plane_normal_;
};

}  // namespace pfdm
