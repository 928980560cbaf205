#pragma once
// What a fit leaves of a field: its figures in fit.json, and its table.

#include "postproc/displacements/displacement_field.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pfdm {

/// A frame of the fit.
struct MetFrame {
  const FieldFrame* frame = nullptr;
  Eigen::MatrixXd measured;       ///< along the plane's axes (places, components) [m]
  Eigen::MatrixXd left;           ///< computed less measured, without the rigid motion [m]
  double rms_without_motion = 0;  ///< of what was measured, without its rigid motion [m]
};

FittedField::Frame figures_of(const MetFrame& met);

/// A row for each place of each frame: frame from 1, displacement of the curve, coordinates of the measurement, and
/// displacements along its axes, measured, computed (with the rigid motion of the measured ones) and their difference.
CsvTable field_table(const MeasuredField& field, const std::vector<MetFrame>& frames, const std::string& case_name);

}  // namespace pfdm
