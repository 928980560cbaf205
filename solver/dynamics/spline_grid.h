#pragma once
// Quadratic B-splines on a grid of equal boxes around a body: the products of three functions along x, y and z, of
// which 27 differ from zero in a box. On one interval they are all parabolas. Their linear and quadratic fields are
// exact, so that a few of them across a plate bend as the plate does.

#include "physics/tensor.h"

#include <array>

namespace pfdm {

class SplineGrid {
 public:
  static constexpr int n_per_box = 27;

  /// Around the box of the two corners. Boxes are about cubes as thick as the body: finer ones if so few functions are
  /// less than `wanted`, wider ones if they would be more than `most`.
  SplineGrid(const Vector& lower, const Vector& upper, Index wanted, Index most);

  Index n_boxes() const { return axes_[0].n * axes_[1].n * axes_[2].n; }
  Index n_functions() const { return (axes_[0].n + 2) * (axes_[1].n + 2) * (axes_[2].n + 2); }
  /// The box that holds x, or the nearest one.
  Index box_of(const Vector& x) const;
  /// The functions of a box, ascending.
  std::array<Index, n_per_box> functions_of(Index box) const;
  std::array<double, n_per_box> values(Index box, const Vector& x) const;
  std::array<Vector, n_per_box> gradients(Index box, const Vector& x) const;  ///< [1/m]

 private:
  struct Axis {
    double from = 0.0, width = 1.0;  // of an interval [m]
    Index n = 1;                     // intervals
  };
  struct OnAxes {
    std::array<std::array<double, 3>, 3> value, slope;  // of the three functions along each axis
  };
  std::array<Index, 3> place_of(Index box) const;
  OnAxes on_axes(Index box, const Vector& x) const;

  std::array<Axis, 3> axes_;
};

}  // namespace pfdm
