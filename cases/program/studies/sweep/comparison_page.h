#pragma once
// The page that sets runs side by side: what came out of them in tables, curves over each other, bodies in step.

#include "cases/program/studies/sweep/compared_runs.h"

#include <string>
#include <vector>

namespace pfdm {

/// Takes the bodies out of the runs. `command`: that makes the page again. Throws InputError if the runs have neither a
/// curve nor a figure in common.
BrowserPage comparison_page(std::vector<ComparedRun> runs, const std::string& version, const std::string& command);

/// Writes index.html and compared.json to the session's results. Throws InputError if that folder holds anything but an
/// earlier comparison.
void report_compared(const std::vector<std::string>& places, Session& session);

}  // namespace pfdm
