#pragma once
// The case on a finer mesh or with finer steps, by which a fit tells what its discretisation does to the estimates; and
// on a coarser one, by which it finds them.

#include "cases/program/input/config/config.h"
#include "cases/program/studies/runs/case_runs.h"

#include <optional>

namespace pfdm {

/// The case with the values of a table of `where`: keys of the case and numbers or texts in their place. Nothing if
/// there is no such table. Throws InputError if a key is not there.
std::optional<CaseVariant> changed_case(const ConfigTable& where, const std::string& table, const CaseFile& file);
/// The case with the values of [fit] `finer`.
std::optional<CaseVariant> finer_case(const ConfigTable& fit, const CaseFile& file);
/// The same with those of [fit] `coarse`.
std::optional<CaseVariant> coarse_case(const ConfigTable& fit, const CaseFile& file);

}  // namespace pfdm
