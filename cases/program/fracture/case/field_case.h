#pragma once
// Reads [[experiment.fields]]: displacements measured on a face of the specimen, as by digital image correlation.

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "postproc/curves/measured_curve.h"
#include "postproc/displacements/field_thinning.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

const KeyTable& measured_field_keys();

struct FieldSettings {
  RecordedField field;       ///< without its frames
  FieldSelection selection;  ///< of its points
  ConfigTable where;         ///< for messages, and what the frames are read by
  ConfigTable of_specimen;   ///< [[experiment.specimens]], whose file may say when frames were taken
};

/// `experiment`: the table that holds the fields. Throws InputError that names file and line. Their files are of no
/// concern: runs and comparisons do without them.
std::vector<FieldSettings> read_field_settings(const ConfigTable& experiment,
                                               const std::vector<MeasuredCurve>& specimens);

/// With the frames of its files, in the order of their displacements. Throws InputError that names file and line: for
/// columns without a unit, frames that no displacement belongs to, and files without points.
RecordedField read_recorded_field(const FieldSettings& settings, const std::vector<MeasuredCurve>& specimens,
                                  const std::filesystem::path& case_directory);

}  // namespace pfdm
