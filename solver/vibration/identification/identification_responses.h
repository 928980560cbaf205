#pragma once
// What a fit of the output compares: the conditioned responses of the recorded tests, measured and simulated from the
// recorded base acceleration, all records one below the other.

#include "physics/point/mass_material.h"
#include "solver/vibration/identification/identification_conditioning.h"
#include "solver/vibration/identification/identification_intervals.h"
#include "solver/vibration/simulation/vibration_excitation.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <span>
#include <utility>
#include <vector>

namespace pfdm {

/// The base accelerations of all records at the nodes of an integration.
using Drives = std::vector<BaseNodes>;

class Responses {
 public:
  /// Of records that begin in motion what a free motion of the model `about` changes, in whatever way, is not compared.
  Responses(std::span<const VibrationRecord> records, double crop, const MassMaterial& about);
  Eigen::Index size() const { return size_; }

  /// To simulate at the records' own rates. Steps as short as the model needs them; likewise in reduced_drives.
  Drives full_drives(const MassMaterial& model) const;
  /// To simulate with no more samples than the conditioned signals have. Harmonics beyond the compared band are folded
  /// back into it, which is little; where next to nothing is saved, the same as full_drives.
  Drives reduced_drives(const MassMaterial& model) const;

  /// Weighted conditioned responses of the models, a column each; NaN in a record where one is unbounded.
  Eigen::MatrixXd simulated(std::span<const MassMaterial> models, const Drives& drives) const;
  /// Subtracts what was measured.
  Eigen::VectorXd residuals(Eigen::VectorXd response) const;

  /// Norm of the residuals of each record over that of its measured output.
  std::vector<double> misfits(const Eigen::VectorXd& residuals) const;
  /// First and last residual of blocks, within a record each, longer than what residuals have in common.
  std::vector<ResidualBlock> blocks() const;

 private:
  struct Output {
    Conditioner condition;
    Eigen::VectorXd base;  // that drives
    double rate = 0.0;
    Eigen::VectorXd measured;
    double weight = 1.0;
    Eigen::Index first = 0;
    InitialMotion start{};
    Eigen::MatrixXd free{};  // orthonormal columns: conditioned free motions, of a record that begins in motion
    Eigen::VectorXd compared(const Eigen::Ref<const Eigen::VectorXd>& response) const;
  };
  std::vector<Output> outputs_;
  Eigen::Index size_ = 0;
};

/// The base's acceleration as what drives the model, at the record's rate.
struct DrivingBase {
  Eigen::VectorXd acceleration;  ///< [m/s^2]
  bool swept = false;            ///< one frequency drives at a time; noise beside it has been taken off
};
DrivingBase driving_base(const VibrationRecord& record);

constexpr double tracking_width = 5.0;  ///< about the driving frequency [Hz]

/// What is compared of a record: the excited band and three harmonics of it.
Conditioner output_condition(const VibrationRecord& record, double crop);

/// The model's answer z'' to the record's base acceleration [m/s^2]; NaN where it is unbounded. It begins at rest, or
/// with the motion that a record has which begins in motion (identification_initial_motion.h).
Eigen::VectorXd predicted_response(const MassMaterial& model, const VibrationRecord& record, double crop = 0.05);

/// Relative misfit of the model's response to the record's base acceleration: norm of the difference of z'' over that
/// of the measured one, within the excited band and its harmonics.
double prediction_misfit(const MassMaterial& model, const VibrationRecord& record, double crop);

}  // namespace pfdm
