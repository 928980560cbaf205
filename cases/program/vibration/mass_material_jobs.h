#pragma once
// What the jobs of a mass-material case share.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"
#include "cases/program/vibration/mass_material_case.h"
#include "cases/program/vibration/vibration_reader.h"

#include <string>

namespace pfdm {

struct MassMaterialProgram {
  CaseFile file;
  MassMaterialCase parsed;
  std::string name;
  std::string hash;
};

/// What a test recorded, or what `run` left of it in the results. Throws InputError.
VibrationRecord record_of(const VibrationTest& test, const std::filesystem::path& results, Log& log);

/// Identifies the model from the records of the tests; writes fit.json and case.fitted.toml.
void fit_mass_material(const MassMaterialProgram& program, Session& session);

}  // namespace pfdm
