#pragma once
// [fit] of a case of kind "endochronic": experiments, method, bounds.

#include "cases/program/input/config/config.h"
#include "solver/point/endochronic_identification.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

struct EndochronicFit {
  const IdentificationMethod* method = nullptr;
  EndochronicIdentificationSettings settings;
  bool divides_steps = true;  ///< the program chooses how many steps an increment is; false: the case does
  std::vector<MaterialExperiment> experiments;  ///< that the law is fitted to
  std::vector<MaterialExperiment> predicted;    ///< that only judge it
  std::vector<std::filesystem::path> data_files;
};

/// `law`: the first guess. Throws InputError with the place of what is wrong.
EndochronicFit read_endochronic_fit(const ConfigTable& fit, const EndochronicLaw& law,
                                    const std::filesystem::path& case_directory);

}  // namespace pfdm
