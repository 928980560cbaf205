#pragma once
// [fit] of a case of kind "viscoelastic": tests on the bulk material, what is estimated, how many branches.

#include "cases/program/input/config/config.h"
#include "solver/point/viscoelastic_identification.h"

#include <filesystem>
#include <vector>

namespace pfdm {

struct ViscoelasticFitCase {
  PronyLaw first;  ///< guess
  ViscoelasticSettings settings;
  ViscoelasticExperiments experiments;
  std::vector<std::filesystem::path> data_files;
};

/// `law`: the first guess. Throws InputError with the place of what is wrong.
ViscoelasticFitCase read_viscoelastic_fit(const ConfigTable& fit, const PronyLaw& law,
                                          const std::filesystem::path& case_directory);

}  // namespace pfdm
