#pragma once
// The motion with which a record begins, of mass and base that were not at rest before its first sample.

#include "physics/point/mass_material.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace pfdm {

/// Derivatives of the conditioned response by the displacement [1/s^2] and the velocity [1/s] with which the record
/// begins, about `record.start`: (n, 2), n as of output_condition(). NaN where the motion is unbounded.
Eigen::MatrixXd free_motions(const MassMaterial& model, const VibrationRecord& record, double crop);

/// Orthonormal columns that span those of A, without what depends on the others. A: (m, 2).
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A);

/// The initial motion with which the model's response to the record is nearest to the measured one (least squares,
/// within the compared band and away from the ends). Nothing of a record that begins at rest: the motion must take off
/// a tenth of the squares that are left otherwise, thirty times what noise would let it, and a thousandth of the
/// response.
std::optional<InitialMotion> begun_motion(const MassMaterial& model, const VibrationRecord& record, double crop);

/// A linear model with this mass [kg] that rings down as the record does: with the frequency of its strongest line in
/// the excited band, and the damping of a coarse list with which the free motion is nearest. Nothing where the base
/// moves a twentieth as much as the mass, or the free motion leaves half of the response or more.
std::optional<MassMaterial> ringing_model(const VibrationRecord& record, double mass, double crop);

/// Sets `start` of all records. Returns the largest change, relative to the motion; 0 if all begin at rest as before.
double update_starts(std::span<VibrationRecord> records, const MassMaterial& model, double crop);

}  // namespace pfdm
