#pragma once
// The greatest force of a curve between its rows, where it is smooth or a corner, and how it moves.

#include "cases/program/studies/sensitivity/curve_branches.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pfdm {

/// Smooth: second differences about it are alike. A corner: the parabolas through three rows to each side meet beside
/// the greatest row, and it lies on one of them, as of cohesive laws and AT1. Otherwise the greatest row is all that is
/// known.
class CurvePeak {
 public:
  /// Keeps references to the curve; `row` has its greatest force.
  CurvePeak(const SampledCurve& curve, const CurveBranches& branches, std::size_t row);

  enum class Shape { row, smooth, corner };
  Shape shape() const { return shape_; }

  struct Place {
    double x = 0.0, y = 0.0;
  };
  /// By polynomials through all rows about it, and through one row fewer of each.
  const std::array<Place, 2>& places() const { return places_; }

  /// How the places move where the force changes at fixed displacement, given at each row of the curve. Not of a row.
  std::array<Place, 2> moved_by(std::span<const double> change) const;

 private:
  /// Rows [first, last] of a polynomial.
  struct Rows {
    std::size_t first = 0, last = 0;
  };
  /// Value, slope and curvature.
  std::array<double, 3> polynomial(const Rows& rows, std::span<const double> of, double at) const;
  bool is_smooth(const Rows& rows) const;
  double top(const Rows& rows) const;
  /// Whether the polynomials meet beside the row; if so, where.
  bool meet(const Rows& left, const Rows& right, double& at) const;
  bool find_corner(std::size_t first, std::size_t end);
  bool lies_on_a_side() const;

  const SampledCurve& curve_;
  std::size_t row_;
  Shape shape_ = Shape::row;
  std::array<Rows, 2> left_{}, right_{};  // of a smooth peak `left_` alone
  std::array<Place, 2> places_{};
};

}  // namespace pfdm
