#pragma once
// pfdm report A B C: runs that are set side by side, each as it ran.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/report_parts.h"
#include "postproc/curves/summary.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr std::size_t most_compared = 24;
inline constexpr const char* compared_file = "compared.json";  ///< mark of the folder of such a page

struct ComparedRun {
  std::string name;  ///< that tells it from the others
  std::filesystem::path results;
  CaseFile file;  ///< as it ran, if the results have it
  BrowserPage page;
  std::optional<ReadSummary> summary;  ///< none of a fit, of a run that goes on
};

/// Of case directories, folders of results or runs of a sweep. Throws InputError that names what has no results, occurs
/// twice, or is a sweep.
std::vector<ComparedRun> open_compared(const std::vector<std::string>& places, const Session& session);

/// What a page of the case would have in its results, of a run in `folder`. Throws InputError.
CasePage page_of_results(const std::filesystem::path& folder, const Session& session);

/// A row for each key whose values differ, a column for each run; titles are left out, and all beyond `limit` rows but
/// their number.
Table differing_keys(const std::vector<ComparedRun>& runs, std::size_t limit = 60);

/// Names of paths by what differs in them: "a", "b" of cases/a/results and cases/b/results.
std::vector<std::string> short_names(const std::vector<std::string>& places);

}  // namespace pfdm
