#pragma once
// Means of recorded frames over squares of their plane, at places that frames with missing points have in common.

#include "postproc/displacements/displacement_field.h"
#include "postproc/displacements/field_outliers.h"

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace pfdm {

/// The places of a field. The points of a square that at least half of the frames have are one place. A frame that
/// lacks up to a quarter of them keeps that place: its mean is carried from the middle of its own points to that of the
/// place by the plane through them. Otherwise, or where they differ from a plane by more than noise (a crack, a curved
/// field), it has a place of its own, as each point has where `side` is 0.
class FieldSquares {
 public:
  /// The noise is the deviation of the field, or of each frame the noise_of it. Keeps references to field and places,
  /// behind which new ones come.
  FieldSquares(const MeasuredField& field, const std::vector<RecordedFrame>& frames, double side,
               std::vector<FieldPlace>& places);
  FieldFrame means(const RecordedFrame& frame);
  std::size_t n_carried() const { return n_carried_; }  ///< means so far
  std::size_t n_own() const { return n_own_; }          ///< means so far that are of other points than their square has

 private:
  using Point = std::array<double, 3>;
  using Members = std::vector<std::size_t>;
  /// Of the points of a frame in a square.
  struct Mean {
    std::vector<Vector> points;
    Vector middle = Vector::Zero(), u = Vector::Zero();                        ///< [m]
    double n = 0.0;                                                            ///< points that would be as exact
    Eigen::Matrix<double, 2, 3> slopes = Eigen::Matrix<double, 2, 3>::Zero();  ///< of the plane through them [-]
    Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();  ///< of the sum of squares of their distances [1/m^2]
    double squares = 0.0;                               ///< sum of what it leaves [m^2]
  };
  /// The points of a place.
  struct Common {
    std::vector<Point> sorted;
    Vector middle = Vector::Zero();
    std::vector<Vector> points;
  };
  std::map<Square, Members> squares_of(const RecordedFrame& frame) const;
  static Mean mean_of(const RecordedFrame& frame, const Members& members);
  /// `key`: the points, sorted.
  std::size_t number_of(const std::vector<Point>& key, const std::vector<Vector>& points);
  /// Whether it leaves no more than noise of that standard deviation [m], and rounding, would.
  bool is_plane(const Mean& mean, double noise, double rounding) const;
  /// The number of the place of a mean, which is carried to its middle.
  std::size_t place_of(const Square& square, double noise, double rounding, Mean& mean);

  const MeasuredField& field_;
  double side_;
  std::vector<FieldPlace>& places_;
  std::map<std::vector<Point>, std::size_t> known_;  // numbers of places by their points
  std::map<Square, Common> common_;
  std::size_t n_carried_ = 0, n_own_ = 0;
};

}  // namespace pfdm
