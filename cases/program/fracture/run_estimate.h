#pragma once
// What a run will cost, for pfdm check.

#include "cases/program/studies/fit/curve_fit_case.h"
#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

#include <filesystem>
#include <string>

namespace pfdm {

/// [bytes]
double estimated_memory(const Mesh& mesh);

/// "time: the complete run in cases/x/results took 68 s"; without one of the case with this hash an estimate of the
/// processor time by cells and steps, good to a factor of seven.
std::string time_words(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading,
                       const std::filesystem::path& results, const std::string& case_hash);

/// How many runs a fit makes, about.
std::string fit_words(const CurveFitSettings& fit);

}  // namespace pfdm
