#pragma once
// Cell gradients by weighted least squares, exact for linear fields: grad u = sum_j (u_j - u_P) (x) c_j.
//
// Samples are neighbours of the same zone and the nodes on the cell's faces. Tetrahedra use two rings of face
// neighbours with weight |d|^-2, as do on request the triangles of plane meshes, and flat ones in plane layers of
// prisms. All other cells use one ring with |d|^-3: two rings on flat curved prisms give wrong stresses. With one ring
// tetrahedra do not converge, and elasticity on flat triangles is indefinite. The weight of a neighbour is multiplied
// by min(1, g_j/g_P), so that a broken cell does not bridge into a sound one; in prisms g_j is that of the cell
// between, where this is less, so that little is sampled across a crack. For a polyhedron the factor is min(g_P/g_j,
// g_j/g_P), small for any neighbour of very different damage: its jump term, weaker than the averaged tractions
// (momentum.h), does not cancel a wrong gradient of the broken cell either.

#include "solver/scalar/gradient_samples.h"

#include <vector>

namespace pfdm {

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
