#pragma once
// Reads [fit] of a case of kind "plate": which of its values are estimated, and the measured curves.

#include "cases/program/plate/plate_case.h"
#include "cases/program/studies/fit/curve_fit_case.h"

namespace pfdm {

/// H1 of a place.
struct MeasuredResponse {
  std::string name;
  Vector at = Vector::Zero();     ///< [m]
  std::vector<double> frequency;  ///< [Hz]
  std::vector<double> magnitude;  ///< [-]
  std::vector<double> phase;      ///< [rad]; may be empty
  double deviation = 0.0;         ///< standard deviation of the magnitude, relative, and of the phase [rad]
};

/// Rise of the surface's temperature.
struct MeasuredRise {
  std::string name;
  bool is_largest = false;   ///< over the surface; else the mean
  std::vector<double> time;  ///< [s], ascending
  std::vector<double> rise;  ///< [K]
  double deviation = 0.0;    ///< standard deviation [K]
};

struct PlateFit {
  std::vector<CurveFitParameter> parameters;
  std::vector<MeasuredResponse> responses;
  std::vector<MeasuredRise> rises;
  int starts = 1;
  ConfigTable where;  ///< [fit], for messages
};

/// Nothing if there is no [fit]. `c` is the case that `file` says. Throws InputError that names file and line.
std::optional<PlateFit> read_plate_fit(const CaseFile& file, const PlateCase& c);

}  // namespace pfdm
