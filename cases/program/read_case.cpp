#include "cases/program/kinds.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/studies/sweep/sweep.h"
#include "cases/program/studies/sweep/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {

namespace {

void add_sweep(const CaseFile& file, const SweepSettings& settings, RunnableCase& runnable) {
  runnable.sweep = [file, settings](Session& session) { run_sweep(file, settings, session); };
  runnable.check = [file, settings, check = runnable.check](Session& session) {
    say_sweep(file, settings, session);
    check(session);
  };
  const std::string title = fmt::format("{}: {}", case_name(file), runnable.title);
  runnable.report = [title, report = runnable.report](Session& session) {
    const bool has_sweep = std::filesystem::exists(session.results / sweep_file);
    if (has_sweep) report_sweep(title, session);
    if (report && (!has_sweep || has_own_run(session.results))) report(session);
  };
}

}  // namespace

bool knows_kind(const CaseFile& file) {
  const ConfigValue kind = file.config.root().at("kind");
  if (!kind.is_string() || std::ranges::count(all_kind_names, kind.string()) == 0) return true;
  return std::ranges::count(case_kinds(), kind.string(), &CaseKind::name) > 0;
}

std::string numbers_like(std::string_view kind, std::string_view file) {
  const auto found = std::ranges::find(case_kinds(), kind, &CaseKind::name);
  return found == case_kinds().end() || found->numbers_like == nullptr ? "" : found->numbers_like(file);
}

RunnableCase read_case(const CaseFile& file) {
  if (!knows_kind(file))
    throw file.config.root().at("kind").error(
        "this program was built for fracture cases alone; the launcher, ./pfdm, builds the one for all kinds");
  const CaseKind& kind = choose(file.config.root().at("kind"), case_kinds(), "kind of case");
  RunnableCase runnable = kind.read(file);
  if (!runnable.report && runnable.page)
    runnable.report = [page = runnable.page](Session& session) { write_report(page(session), session); };
  if (const auto settings = read_sweep(file))
    add_sweep(file, *settings, runnable);
  else
    runnable.sweep = job_without_table(
        file, "sweep", "a method and [[sweep.parameters]] that name values with those they take", "glass_bead_radius");
  file.config.reject_unknown_keys();
  return runnable;
}

}  // namespace pfdm
