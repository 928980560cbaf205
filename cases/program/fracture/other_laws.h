#pragma once
// A fracture case with other laws of its cracks: what a fit whose residuals are more than noise may lack.

#include "cases/program/studies/runs/case_runs.h"

#include <vector>

namespace pfdm {

/// The case with each other softening law of [fracture], if it states one, and with each other law of those interfaces
/// that share the first one's; the other keys as they are, so that some of them may be no case.
std::vector<CaseVariant> with_other_laws(const CaseFile& file);

}  // namespace pfdm
