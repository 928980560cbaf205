#pragma once
// The page of a sweep: its runs in a table, and their figures against what was changed.

#include "cases/program/session/session.h"

#include <filesystem>
#include <string>

namespace pfdm {

inline constexpr const char* sweep_file = "sweep.csv";

/// Whether the folder has a run of its own, and not those of a sweep alone.
bool has_own_run(const std::filesystem::path& results);

/// From sweep.csv in the session's results: report/report.pdf and .png there; beside a run's own page report/sweep/.
/// `title`: of the page. Throws InputError if the file is no table of a sweep.
void report_sweep(const std::string& title, Session& session);

}  // namespace pfdm
