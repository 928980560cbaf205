#include "cases/program/session/whole_run.h"

#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/session/earlier_results.h"
#include "cases/program/session/head_line.h"
#include "cases/program/session/report_parts.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/new_results.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// A killed run may have left some of its results, and no summary.
bool has_results(const WholeRun& run, const fs::path& folder) {
  return fs::exists(folder / summary_file) ||
         std::ranges::any_of(run.results, [&](const std::string& name) { return fs::exists(folder / name); });
}

void remove_earlier(const WholeRun& run, const fs::path& folder) {
  if (run.remove_more) run.remove_more();
  std::error_code ignored;
  fs::remove(folder / summary_file, ignored);
  for (const std::string& name : run.results) fs::remove_all(folder / name, ignored);
  remove_report(folder);
}

}  // namespace

FiguresSummary complete_summary(const std::string& name, const std::string& hash, const Session& session) {
  return {.case_name = name,
          .status = "complete",
          .version = session.version,
          .case_hash = hash,
          .threads = session.threads,
          .wall_seconds = 0.0,
          .figures = {},
          .tests = {}};
}

RunSummary complete_run(const std::string& name, const std::string& hash, const Session& session, double seconds) {
  RunSummary summary;
  summary.case_name = name;
  summary.status = "complete";
  summary.version = session.version;
  summary.case_hash = hash;
  summary.threads = session.threads;
  summary.wall_seconds = seconds;
  summary.cpu_seconds = cpu_seconds();
  summary.peak_memory = peak_memory();
  return summary;
}

void run_whole(const WholeRun& run, Session& session) {
  const Stopwatch watch;
  const FolderLock lock(session.results);
  NewResults place(session.results, has_results(run, session.results));
  Log& log = session.log;
  log.open_file(place.folder() / "run.log", false);
  log.say(head_line(session, fmt::format("case {}: {}", run.name, run.title)));
  if (session.restart) log.say("this kind of case cannot be restarted: starting from the beginning");
  if (place.wait()) say_what_is_replaced(session, run.file, run.hash, false);
  if (!session.figures_only) keep_case(run.file, session.version, session.results, place.folder());
  const std::string ending = run.compute(place.folder(), watch);
  place.take_place([&] { remove_earlier(run, session.results); }, summary_file);
  log.say(fmt::format("{} after {:.1f} s; results in {}", ending, watch.seconds(), session.results.string()));
}

}  // namespace pfdm
