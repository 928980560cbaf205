#pragma once
// The case on a finer mesh or with finer steps, by which a fit tells what its discretisation does to the estimates.

#include "cases/program/input/config.h"
#include "cases/program/studies/case_runs.h"

#include <optional>

namespace pfdm {

/// The case with the values of [fit] `finer`: keys of the case and numbers or texts in their place. Nothing if there is
/// no such table. Throws InputError if a key is not there.
std::optional<CaseVariant> finer_case(const ConfigTable& fit, const CaseFile& file);

}  // namespace pfdm
