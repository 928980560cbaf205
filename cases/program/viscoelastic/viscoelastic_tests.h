#pragma once
// [[fit.experiments]] of a case of kind "viscoelastic": a test over time, or DMA over frequency.

#include "cases/program/input/config/config.h"
#include "solver/point/viscoelastic_fit.h"

#include <filesystem>

namespace pfdm {

/// Throws InputError with the place of what is wrong.
ViscoelasticExperiment read_viscoelastic_test(const ConfigTable& test, const std::filesystem::path& case_directory);

}  // namespace pfdm
