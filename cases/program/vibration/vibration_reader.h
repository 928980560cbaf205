#pragma once
// Vibration records from files, in SI units, checked.

#include "cases/program/input/config/key.h"
#include "cases/program/session/terminal/log.h"
#include "cases/program/vibration/mass_material_case.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The test's record, offsets of the channels taken out. Where base and mass have files of their own: what both have,
/// by their times. Throws InputError that names the file and the fault; what can be lived with, left out or assumed is
/// said to the log.
VibrationRecord read_record(const VibrationTest& test, const RecordFile& source, Log& log);

/// One acceleration of a file [m/s^2] and the rate [Hz] by its times or as stated; for base accelerations that were
/// measured.
struct SampledChannel {
  Eigen::VectorXd values;
  double rate = 0.0;
  std::vector<std::string> notes{};  ///< for the log: what was assumed
};
SampledChannel read_channel(const RecordFile& source);

/// Rows of the keys of the file of a record or of a measured base acceleration; `only`: with these words of the key
/// that decides.
std::vector<Key> record_file_keys(std::string_view only);

}  // namespace pfdm
