#pragma once
// Faces of hexahedra and ends of prisms along which all of the displacement is prescribed, as those of a body that is
// bonded to a stiff one. Their displacements say what the tangential derivatives on the surface are; those of the cell,
// half a cell away, are others. With G the gradient of the cell, the one on the surface is
//
//   H = G + sum_j (u_j - u_f - G (x_j - x_f)) (x) c_j,
//
// j being the faces of the patch that share a point with it and c_j the coefficients of least squares within the
// tangent plane. It is G where the displacement is linear. The traction follows from H and twice the stiffness a of
// other faces: t = sigma(H) n + 2 a (u_f - u_c - H d). This is the slope at the wall of a parabola through it and two
// cells, as G is its slope at the cell's centre and (u_f - u_c)/d that half-way.

#include "solver/momentum/body/momentum_faces.h"
#include "solver/momentum/body/unknowns.h"
#include "solver/momentum/faces/surface_slopes.h"

#include <functional>
#include <vector>

namespace pfdm {

class BondedSides {
 public:
  static constexpr double stiffer = 2.0;  // a over that of other sides

  BondedSides() = default;
  /// Bonded sides of cells with a pressure, where `may_be` allows it.
  BondedSides(const Mesh& mesh, const Unknowns& unknowns, const std::vector<momentum_faces::Side>& sides,
              const std::function<bool(Index cell)>& may_be);

  std::size_t size() const { return side_.size(); }
  /// Number of a side among them; -1: it is none.
  Index number(std::size_t side) const { return number_.empty() ? -1 : number_[side]; }
  std::size_t side(std::size_t number) const { return side_[number]; }

  /// H of number k.
  Tensor gradient(std::size_t k, const std::vector<Vector>& u, const Tensor& in_cell) const {
    Tensor gradient = in_cell;
    const Vector& here = u[node_[k]];
    for (std::size_t s = offsets_[k]; s < offsets_[k + 1]; ++s) {
      const Sample& of = samples_[s];
      gradient.noalias() += (u[of.node] - here - in_cell * of.d) * of.coefficient.transpose();
    }
    if (!radius_.empty()) gradient += (radial_.dot(here) / radius_[k] - across_.dot(in_cell * across_)) * hoop_;
    return gradient;
  }

 private:
  struct Sample {
    Index node;
    Vector d;            // from the face's centre [m]
    Vector coefficient;  // [1/m]
  };
  void add(const Mesh& mesh, const Unknowns& unknowns, const momentum_faces::Side& side, const SurfaceSlopes& slopes);

  std::vector<Index> number_;      // of each side
  std::vector<std::size_t> side_;  // of each of them
  std::vector<Index> node_;        // of each of them
  std::vector<std::size_t> offsets_{0};
  std::vector<Sample> samples_;
  // Terms of axisymmetric meshes, whose hoop strain is that on the surface too.
  std::vector<double> radius_;  // of each of them [m]; else empty
  Vector radial_ = Vector::Zero(), across_ = Vector::Zero();
  Tensor hoop_ = Tensor::Zero();
};

}  // namespace pfdm
