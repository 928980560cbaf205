#pragma once
// A run without steps that could be restarted. Its results take the place of earlier ones once all of them are there.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "postproc/curves/figures_summary.h"
#include "postproc/curves/summary.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pfdm {

struct WholeRun {
  const CaseFile& file;
  std::string name;   ///< of the case
  std::string title;  ///< of the case
  std::string hash;   ///< of the case and its data
  /// Writes everything into the folder, summary.json too, and returns how the run ended, as in "complete". What it
  /// throws leaves earlier results as they were.
  std::function<std::string(const std::filesystem::path& folder, const Stopwatch& watch)> compute;
  std::vector<std::string>
      results;  ///< files and folders of a run, beside summary.json: those of an earlier one go away
  std::function<void()> remove_more = nullptr;  ///< what else of an earlier run goes away; may be empty
};

/// What every run says of itself; time, figures and tests are to be added.
FiguresSummary complete_summary(const std::string& name, const std::string& hash, const Session& session);

/// Likewise, with the processor time and the memory of the program so far; `seconds`: how long the run took.
RunSummary complete_run(const std::string& name, const std::string& hash, const Session& session, double seconds);

/// Locks the results' folder, computes, and puts the results there. Throws ComputationError.
void run_whole(const WholeRun& run, Session& session);

}  // namespace pfdm
