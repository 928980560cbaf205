#pragma once
// Computed less measured displacements of a frame as residuals of a fit, and what their noise is.

#include "postproc/displacements/displacement_field.h"

#include <Eigen/Core>
#include <Eigen/QR>

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Computed less measured means along the plane's axes [m]: (places, components). `computed`: of all places there are,
/// three numbers each, in the body.
Eigen::MatrixXd frame_difference(const MeasuredField& field, const FieldFrame& frame,
                                 const std::vector<double>& computed);

/// What was measured, likewise [m].
Eigen::MatrixXd measured_of(const MeasuredField& field, const FieldFrame& frame);

/// The rigid motion of a frame: what it does to the places, with the square roots of their numbers of points as
/// weights.
class RigidMotion {
 public:
  RigidMotion(const MeasuredField& field, const FieldFrame& frame);
  /// The weighted difference without it, as independent numbers: n_data() of the frame, in no order of the places [m].
  Eigen::VectorXd reduced(const Eigen::MatrixXd& difference) const;
  /// The difference without it, by weighted least squares, place by place [m].
  Eigen::MatrixXd projected(const Eigen::MatrixXd& difference) const;
  /// (places x components, modes), orthonormal: places of the first component, of the second ...
  const Eigen::MatrixXd& modes() const { return modes_; }

 private:
  Eigen::VectorXd weighted(const Eigen::MatrixXd& difference) const;
  Eigen::VectorXd roots_;  // of the numbers of points
  Eigen::MatrixXd modes_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;  // of the motions: what its Q makes of a difference begins with them
};

/// What differences without their rigid motion show of their noise.
struct FieldScatter {
  double deviation = 0.0;    ///< of a component of one point, if points were independent [m]
  double inflation = 1.0;    ///< of the standard deviation of sums over parts of the face, by correlation; at least 1
  double over = 0.0;         ///< side of the parts that show it [m]
  bool over_frames = false;  ///< and of sums over all frames
  bool is_long_ranged = false;  ///< grows up to the largest parts there are: hardly noise
  double freedom = 0.0;         ///< data, less what parameters take
};

/// Of sums over squares of growing size, alone and over all frames, the largest ratio of their variance to that of
/// independent data, where independent data exceed it once in 5,000 at most. `left`: RigidMotion::projected() of
/// these frames. `taken`: of their data, by the parameters of a fit. Where no noise is stated the inflation is that of
/// overlapping subsets at least.
FieldScatter scatter_of(const MeasuredField& field, const std::vector<std::size_t>& frames,
                        const std::vector<Eigen::MatrixXd>& left, double taken = 0.0);

/// Fewer data do not tell their noise.
constexpr std::size_t fewest_for_noise = 20;
std::string too_few_for_noise(const std::string& field, std::size_t n_data);

/// The standard deviation that a component of one point stands for in sums over the face where subsets overlap: the
/// stated one times side of the subset over spacing of the points, where that is larger [m].
double stated_deviation(const MeasuredField& field);

}  // namespace pfdm
