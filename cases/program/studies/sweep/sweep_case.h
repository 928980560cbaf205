#pragma once
// Reads [sweep] of a case of any kind: which values are changed, and which sets of values are run.

#include "cases/program/input/case_files/case_parameter.h"
#include "cases/program/studies/runs/case_runs.h"
#include "cases/program/studies/runs/slurm.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pfdm {

struct SweepSettings {
  std::vector<CaseParameter> parameters;
  std::vector<std::vector<double>> points;  ///< a value of each parameter [SI]
  bool is_of_changes = false;               ///< the only parameter is the change (sweep_changes.h)
  SlurmSettings slurm;
};

/// Nothing if there is no [sweep]. Throws InputError that names file and line.
std::optional<SweepSettings> read_sweep(const CaseFile& file);

/// What the sweep runs, a case of each point. Throws InputError where a change names a key that the case has not.
std::vector<CaseVariant> variants_of(const SweepSettings& settings, const CaseFile& file);

/// Samples of the unit cube: each of the n intervals of each dimension holds one. McKay, Beckman, Conover,
/// Technometrics 21 (1979) 239.
std::vector<std::vector<double>> latin_hypercube(std::size_t n, std::size_t n_dimensions, std::uint64_t seed);

}  // namespace pfdm
