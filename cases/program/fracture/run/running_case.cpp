#include "cases/program/fracture/run/running_case.h"

#include "cases/program/fracture/outcome/end_of_run.h"
#include "cases/program/fracture/outcome/fracture_cohesive.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/fracture/run/long_time_heat.h"
#include "cases/program/fracture/run/progress.h"
#include "cases/program/session/head_line.h"
#include "cases/program/session/terminal/stop_signal.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pfdm {
namespace {

RunSummary summary_of(const FractureProgram& program, const Session& session, const FractureRun& run,
                      const RunTimes& times) {
  RunSummary summary;
  summary.case_name = program.name;
  summary.version = session.version;
  summary.threads = session.threads;
  summary.unknowns = run.n_unknowns();
  summary.staggered_iterations = run.staggered_iterations();
  summary.krylov_iterations = run.krylov_iterations();
  summary.cpu_seconds_by_stage = run.cpu_seconds_by_stage();
  summary.wall_seconds = times.whole.seconds();
  summary.wall_seconds_by_stage = {
      {"mesh", times.mesh}, {"results", times.results}, {"solve", summary.wall_seconds - times.mesh - times.results}};
  summary.cpu_seconds = cpu_seconds();
  summary.peak_memory = peak_memory();
  return summary;
}

ShownOfRun shown_of(const RunningCase& c) {
  const FractureCase& fracture = c.program.fracture;
  ShownOfRun shown{.units = read_curve_units(c.program.file, fracture.output.curve),
                   .of_box = {},
                   .damage = std::ranges::any_of(c.run.model().regions, &RegionModel::damageable),
                   .debonded_area = !fracture.interfaces.empty(),
                   .may_end_early = fracture.heat && fracture.heat->cycle > 0.0};
  if (fracture.box) shown.of_box = fracture.box->component;
  return shown;
}

/// What is known of the first debonding, for the line of progress.
std::string debonded(const RunningCase& c) {
  const auto& first = c.results.first_debonding();
  return first ? debonded_words(*first, c.program.fracture.cohesive.axis) : std::string();
}

/// A page, if one is due and earlier results do not stand where it belongs.
void look_at_page(RunningCase& c, const RunProgress& progress) {
  if (c.live && !c.results.wait()) c.live->look(progress.figures(), c.results.rows());
}

void record(RunningCase& c, const FractureState& now, const StepReport& report) {
  const Stopwatch watch;
  for (const std::string& remark : report.remarks) c.session.log.warn(remark);
  for (const std::string& warning : c.coarse.look(now.damage)) c.session.log.warn(warning);
  for (const std::string& warning : c.results.step_done(now, report, [&] { return c.run.output(now); }))
    c.session.log.warn(warning);
  c.state = now;
  c.times.results += watch.seconds();
  c.followed.write(curve_line(c.results.last_row()));
}

/// Why the run ends after this step; empty if it continues.
std::string reason_to_end(const RunningCase& c, Index first_step) {
  if (c.run.is_complete(c.state)) return "complete";
  if (c.session.max_steps && c.state.step - first_step >= *c.session.max_steps) return "stopped by --max-steps";
  if (c.session.until && c.results.last_row().displacement >= *c.session.until)
    return "stopped at the last displacement needed";
  return "";
}

/// Steps until the end of the load, --max-steps or failure; returns what became of it.
std::string advance(RunningCase& c) {
  RunProgress progress(c.session.log, c.state.load, c.program.fracture.loading.end, shown_of(c));
  const LooksForStop looks;
  const auto iterated = [&](const IterationReport& iteration) {
    if (!iteration.remark.empty()) c.session.log.warn(iteration.remark);
    if (!iteration.in_balance) progress.iterated(iteration);
    look_at_page(c, progress);
    stop_if_asked();
  };
  const auto recorded = [&](const FractureState& now, const StepReport& report) {
    record(c, now, report);
    const CurveRow& row = c.results.last_row();
    progress.step_done(report, row.displacement, row.force[c.program.fracture.output.curve.component], debonded(c));
    look_at_page(c, progress);
  };
  const Index first_step = c.state.step;
  FractureState next = c.state;
  std::string reason = c.run.is_complete(next) ? "complete" : "";
  if (!c.goes_on) {
    recorded(next, c.run.report_of(next));
    reason = reason_to_end(c, first_step);
  }
  while (reason.empty()) {
    const StepReport report = c.run.step(next, iterated);
    recorded(next, report);
    reason = reason_to_end(c, first_step);
  }
  return reason;
}

/// Steps may have come between them and the end.
void repeat_warnings(Log& log) {
  if (log.warnings().empty()) return;
  log.say(fmt::format("  {} of this run:", counted(count_of(log.warnings()), "warning")));
  for (const std::string& warning : log.warnings()) log.say(fmt::format("  - {}", warning));
}

/// "See force_displacement.csv (curve), fields.pvd (ParaView), run.log (all steps).", of what there is.
std::string where_to_look(const std::filesystem::path& results) {
  std::string files;
  const bool is_box = std::filesystem::exists(results / means_file);
  for (const auto& [what, file] :
       {std::pair("curve", is_box ? means_file : curve_file), std::pair("ParaView", "fields.pvd"),
        std::pair("ParaView from 5.12 on", frames_in_one_file), std::pair("laws", "cohesive.json"),
        std::pair("all steps", "run.log")})
    if (std::filesystem::exists(results / file))
      files += fmt::format("{}{} ({})", files.empty() ? "See " : ", ", file, what);
  return files + ".";
}

/// The summary is the last file of all: where it says "complete", all is there. Returns what is to be said at last.
std::string finish(RunningCase& c, const std::string& status) {
  c.results.put_frames_into_one_file();
  RunSummary summary = summary_of(c.program, c.session, c.run, c.times);
  summary.status = status;
  summary.other_figures = c.own_figures;
  summary = c.results.write_summary(summary);
  std::vector<std::string> told =
      as_sentences(what_happened(c.program.fracture, c.program.file, summary, c.results.folder()));
  for (const std::string& sentence : told) c.session.log.say("  " + sentence);
  if (!c.results.wait()) c.session.log.say("  " + where_to_look(c.results.folder()));
  repeat_warnings(c.session.log);
  std::string ending = fmt::format("{} at step {}, load {:.6g}, after {}", status, c.state.step, c.state.load,
                                   duration_words(c.times.whole.seconds()));
  if (c.live && !c.results.wait()) {
    told.insert(told.begin(), fmt::format("The run has ended: {}.", ending));
    c.live->end(std::move(told), c.results.rows());
  }
  return fmt::format("{}; results in {}", ending, c.session.results.string());
}

std::string earlier_results_stay(const RunningCase& c) {
  return fmt::format("the earlier results in {} are kept", c.session.results.string());
}

/// Keeps as much of a run that failed as there is room for.
void finish_failed(RunningCase& c, const std::string& why) {
  if (c.results.wait()) return c.session.log.say(earlier_results_stay(c));
  try {
    c.results.write_last_frame([&] { return c.run.output(c.state); });
    c.results.write_what_waits(c.state);
    c.session.log.say(finish(c, fmt::format("failed: {}", why)));
  } catch (const ComputationError&) {
    // A full disk is often what failed in the first place; the first message is the one to show.
  }
}

/// Returns what is to be said.
std::string finish_interrupted(RunningCase& c, const std::string& status) {
  if (c.results.wait()) return fmt::format("{}; {}", status, earlier_results_stay(c));
  c.results.write_what_waits(c.state);
  return finish(c, status);
}

}  // namespace

void solve(RunningCase& c) {
  try {
    const std::string status = advance(c);
    c.results.write_what_waits(c.state);
    if (status == "complete") c.results.write_last_frame([&] { return c.run.output(c.state); });
    if (c.program.fracture.heat) c.own_figures = heat_at_the_end(c);
    if (c.results.records_columns()) {
      write_cohesive_laws(c.program.fracture, c.program.file, c.program.name, c.program.hash, c.session, true);
      c.own_figures.merge(figures_of_laws(c.results.folder()));
    }
    c.session.log.say(finish(c, status));
  } catch (const Interrupted& wish) {
    const std::string told = finish_interrupted(c, wish.what());
    c.session.log.record(told);
    throw Interrupted(wish.signal, told);
  } catch (const ComputationError& error) {
    finish_failed(c, error.what());
    throw;
  }
}

}  // namespace pfdm
