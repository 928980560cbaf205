#include "cases/program/point/endochronic_program.h"

#include "cases/program/point/endochronic_case.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "cases/program/point/endochronic_comparison.h"
#include "cases/program/point/endochronic_fit_results.h"
#include "cases/program/point/endochronic_report.h"
#include "cases/program/point/endochronic_words.h"
#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/whole_run.h"
#include "postproc/curves/summary.h"
#include "postproc/files/folder_lock.h"
#include "postproc/point/history_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfdm {
namespace {

struct EndochronicProgram {
  CaseFile file;
  EndochronicCase point;
  std::string name;
  std::string hash;
};

std::size_t n_increments(const EndochronicLoading& loading) {
  std::size_t n = 0;
  for (const LoadSegment& segment : loading.segments) n += segment.times.size() - 1;
  return n;
}

void say_fit(const EndochronicFit& fit, const EndochronicLaw& law, Log& log) {
  std::vector<std::string> names;
  for (const FitParameter& p : fit_parameters(law, fit.settings.choice)) names.push_back(p.name);
  log.say(fmt::format("fit by the method {} to {} experiments of {} values, rms stress {}; first guess of {}",
                      fit.method->name, fit.experiments.size(), n_measured(fit.experiments),
                      stress_shown(rms_measured(fit.experiments)), fmt::join(names, ", ")));
}

void check(const EndochronicProgram& program, Session& session) {
  const EndochronicCase& point = program.point;
  session.log.say(fmt::format("{}: {}", program.name, point.title));
  session.log.say(fmt::format("a material point; kernel of {} terms", point.law.kernel.size()));
  say_law(point.law, session.log);
  session.log.say(
      fmt::format("{} segments, {} increments", point.loading.segments.size(), n_increments(point.loading)));
  if (point.fit) say_fit(*point.fit, point.law, session.log);
  session.log.say(fmt::format("results go to {}", session.results.string()));
  session.log.say("the input is valid");
}

constexpr const char* history_file = "history.csv";

void write_results(const EndochronicProgram& program, const HistoryResult& history, const Session& session,
                   const std::filesystem::path& folder, double seconds) {
  write_csv(folder / history_file, history_table(program.point.law, history));
  RunSummary summary = complete_run(program.name, program.hash, session, seconds);
  if (!history.converged) summary.status = "failed: " + history.failure;
  summary.steps = static_cast<Index>(history.points.size() - 1);
  summary.other_figures = history_figures(program.point.law, history);
  summary.other_counts = {{"newton_iterations", newton_iterations(history)}};
  write_summary(folder / summary_file, summary);
}

void run_case(const EndochronicProgram& program, Session& session) {
  Log& log = session.log;
  std::string failure;
  const auto compute = [&](const std::filesystem::path& folder, const Stopwatch& watch) -> std::string {
    say_law(program.point.law, log);
    const EndochronicLoading& loading = program.point.loading;
    const HistoryResult history = run_history(program.point.law, loading.segments, loading.settings);
    if (!history.converged) failure = fmt::format("case {}: {}", program.name, history.failure);
    write_results(program, history, session, folder, watch.seconds());
    if (history.points.size() < 2) throw NoConvergence(failure);
    say_history(history_figures(program.point.law, history), log);
    log.say(fmt::format("  {} of {} increments, {} iterations", history.points.size() - 1, n_increments(loading),
                        newton_iterations(history)));
    return history.converged ? "complete" : "failed";
  };
  run_whole({.file = program.file,
             .name = program.name,
             .title = program.point.title,
             .hash = program.hash,
             .compute = compute,
             .results = {history_file}},
            session);
  if (!failure.empty()) throw NoConvergence(failure);
}

void say_estimates(const FitFindings& found, Log& log) {
  for (const FittedParameter& p : found.parameters) log.say(fmt::format("  {:<14} {}", p.name, estimate_text(p)));
}

void fit_case(const EndochronicProgram& program, Session& session) {
  const Stopwatch watch;
  Log& log = session.log;
  EndochronicFit fit = *program.point.fit;
  log.say(fmt::format("pfdm {}, fit of {}: {}", session.version, program.name, program.point.title));
  const FolderLock lock(session.results);
  log.say(fmt::format("method {}: {}; {} experiments, {} more to be predicted", fit.method->name,
                      fit.method->description, fit.experiments.size(), fit.predicted.size()));
  fit.settings.say = [&log](const std::string& message) { log.say(message); };
  EndochronicIdentification found = fit.method->identify(
      law_that_bears(program.point.law, fit.experiments, fit.settings), fit.experiments, fit.settings);
  if (fit.divides_steps) divide_steps(found, fit.experiments, fit.settings, fit.settings.control);
  const double seconds = watch.seconds();
  log.open_file(session.results / "fit.log", false);  // not before: it belongs to the estimates that are there
  const FitFindings findings = write_fit_results(session.results, program.file, fit, found,
                                                 {program.name, program.hash, session.version, seconds});
  say_estimates(findings, log);
  log.say(fmt::format("rms misfit {} of {} rms stress; {} evaluations, {:.1f} s; {}",
                      stress_shown(rms_misfit(found.fit.law, fit.experiments, fit.settings.control)),
                      stress_shown(rms_measured(fit.experiments)), found.fit.result.evaluations, seconds,
                      end_of_search(found.fit.result.message)));
  say_fitted_case(session);
  say_verdict(findings, session);
}

RunnableCase read_program(const CaseFile& file) {
  auto program =
      std::make_shared<EndochronicProgram>(EndochronicProgram{.file = file, .point = {}, .name = {}, .hash = {}});
  program->point = read_endochronic_case(file.config.root(), file.directory);
  program->name = case_name(file);
  const std::vector<std::filesystem::path>& of_run = program->point.loading.data_files;
  std::vector<std::filesystem::path> data = of_run;
  if (program->point.fit)
    data.insert(data.end(), program->point.fit->data_files.begin(), program->point.fit->data_files.end());
  program->hash = case_hash(file, data);
  RunnableCase runnable{
      .title = program->point.title,
      .check = [program](Session& session) { check(*program, session); },
      .run = [program](Session& session) { run_case(*program, session); },
      .page =
          [program](const Session& session) {
            return CasePage{
                .report = endochronic_page(program->point, program->name, program->hash, session.results),
                .extras = {.hash = program->hash, .headline = endochronic_headline(program->hash, session.results)}};
          },
      .data_files = of_run};
  runnable.fit = [program](Session& session) { fit_case(*program, session); };
  runnable.compare = [program](Session& session) {
    compare_with_experiments(*program->point.fit, program->point.law, program->name, program->hash, session);
  };
  if (!program->point.fit)
    runnable.fit = runnable.compare = job_without_table(
        file, "fit", "[[fit.experiments]] with the measured strains and stresses", "endochronic_calibration");
  return runnable;
}

std::vector<LawTable> laws() {
  return {law_table("hardening ([material.hardening] law)", hardening_laws()),
          law_table("rate factors ([material.rate] law)", rate_factors()),
          law_table("identification ([fit] method)", identification_methods())};
}

}  // namespace

CaseKind endochronic_kind() {
  return {.name = "endochronic",
          .description = "one material point of endochronic plasticity under mixed control",
          .read = read_program,
          .laws = laws,
          .keys = [] { return std::vector<const KeyTable*>{&endochronic_case_keys()}; }};
}

}  // namespace pfdm
