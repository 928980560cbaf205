#pragma once
// What the jobs of a mass-material case share.

#include "cases/program/mass_material_case.h"
#include "cases/program/session.h"
#include "cases/program/vibration_reader.h"

#include <filesystem>
#include <string>

namespace pfdm {

struct MassMaterialProgram {
  MassMaterialCase parsed;
  std::string name;
  std::string hash;
  std::string text;  ///< of case.toml
  std::filesystem::path directory;
};

/// Identifies the model from the records of the tests; writes fit.json and case.fitted.toml.
void fit_mass_material(const MassMaterialProgram& program, Session& session);

}  // namespace pfdm
