#include "cases/program/fracture/fracture_program.h"

#include "cases/program/fracture/end_of_run.h"
#include "cases/program/fracture/experiment_case.h"
#include "cases/program/fracture/fracture_browser.h"
#include "cases/program/fracture/fracture_case.h"
#include "cases/program/fracture/fracture_cohesive.h"
#include "cases/program/fracture/fracture_comparison.h"
#include "cases/program/fracture/fracture_laws.h"
#include "cases/program/fracture/fracture_report.h"
#include "cases/program/fracture/fracture_results.h"
#include "cases/program/fracture/live_page.h"
#include "cases/program/fracture/other_laws.h"
#include "cases/program/fracture/progress.h"
#include "cases/program/fracture/recorded_steps.h"
#include "cases/program/fracture/run_estimate.h"
#include "cases/program/fracture/run_keys.h"
#include "cases/program/input/kept_case.h"
#include "cases/program/session/earlier_results.h"
#include "cases/program/session/followed_rows.h"
#include "cases/program/session/head_line.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/stop_signal.h"
#include "cases/program/session/stopwatch.h"
#include "cases/program/studies/curve_fit.h"
#include "mesh/quality.h"
#include "postproc/curves/curve_misfit.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/other_case.h"
#include "solver/fracture/bending_words.h"
#include "solver/fracture/fracture_run.h"
#include "solver/fracture/locking_words.h"
#include "solver/fracture/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pfdm {
namespace {

/// Tables that say how the load is stepped and the steps are solved, and what they are compared with; not what is
/// loaded.
constexpr std::string_view may_change_on_the_way[] = {"solver", "loading", "experiment", "fit", "sweep"};

/// Where the wall-clock time of a run goes [s].
struct RunTimes {
  Stopwatch whole;
  double mesh = 0.0;
  double results = 0.0;
};

struct FractureProgram {
  CaseFile file;
  FractureCase fracture{};
  std::optional<ExperimentSettings> experiment{};
  std::optional<CurveFitSettings> fit{};
  std::string name{};
  std::string hash{};
  std::string mesh_hash{};  ///< of what decides the mesh
};

Mesh make_mesh(const FractureProgram& program, Log& log) {
  for (const std::string& remark : program.fracture.materials.remarks) log.say(remark);
  const Stopwatch watch;
  Mesh mesh = program.fracture.mesh.make();
  log.say(fmt::format("mesh: {} cells, {} points, {} faces, made in {:.1f} s", mesh.n_cells(), mesh.points.size(),
                      mesh.n_faces(), watch.seconds()));
  if (const auto warning = flat_cell_warning(mesh)) log.warn(*warning);
  return mesh;
}

FractureRun make_run(const FractureProgram& program, const Mesh& mesh, Log& log) {
  const FractureCase& fracture = program.fracture;
  FractureModel model = model_on(fracture, mesh);
  const ResolutionWords words =
      resolution_words(mesh, model, fracture.materials.bands, fracture.materials.corrects_toughness);
  for (const std::string& remark : words.remarks) log.say(remark);
  for (const std::string& warning : words.warnings) log.warn(warning);
  return FractureRun(mesh, std::move(model), fracture.staggered, fracture.loading);
}

void warn_of_interfaces(const FractureRun& run, Log& log) {
  for (const std::string& warning : run.interface_warnings()) log.warn(warning);
}

void say_regions(const Mesh& mesh, Log& log) {
  std::vector<Index> cells(mesh.region_names.size());
  for (const Index region : mesh.region) ++cells[as_size(region)];
  for (std::size_t i = 0; i < cells.size(); ++i)
    log.say(fmt::format("  region {:<16} {:>9} cells", mesh.region_names[i], cells[i]));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void check_fit(const FractureProgram& program, Log& log) {
  if (program.experiment)
    program.fit->where.in_context([&] {
      require_deviations(program.experiment->specimens);
      return true;
    });
  require_start_within_bounds(program.fit->where, program.fit->parameters);
  for (const CurveFitParameter& parameter : program.fit->parameters)
    log.say(fmt::format("fit of {} between {} and {}", parameter.in_case.name,
                        parameter.in_case.shown(parameter.in_fit.lower),
                        parameter.in_case.shown(parameter.in_fit.upper)));
  log.say(fmt::format("pfdm fit would make some {} runs", estimated_runs(*program.fit)));
}

void check(const FractureProgram& program, Session& session) {
  Log& log = session.log;
  const LoadingSettings& loading = program.fracture.loading;
  const Mesh mesh = make_mesh(program, log);
  const FractureRun run = make_run(program, mesh, log);
  warn_of_interfaces(run, log);
  if (const std::string remark = direction_remark(mesh, run.model()); !remark.empty()) log.say(remark);
  if (const auto warning = bending_warning(mesh, run.model())) log.warn(*warning);
  if (const auto warning = locking_warning(mesh, run.model())) log.warn(*warning);
  const std::vector<ColumnSet> columns = column_sets(program.fracture.cohesive, mesh, run.model());
  log.say(fmt::format("{}: {}", program.name, program.fracture.title));
  if (program.fracture.box) log.say(program.fracture.box->words);
  log.say(fmt::format("cells {}", mesh.n_cells()));
  say_regions(mesh, log);
  log.say(fmt::format("unknowns {} of displacement, {} of damage", run.n_unknowns(), mesh.n_cells()));
  log.say(fmt::format("memory about {:.0f} MB", 1e-6 * estimated_memory(mesh)));
  log.say(fmt::format("steps {} or more, up to load {:g}", std::ceil(loading.end / loading.maximum_increment - 1e-9),
                      loading.end));
  log.say(time_words(mesh, run.model(), loading, session.results, program.hash));
  if (program.fit) check_fit(program, log);
  for (const ColumnSet& set : columns)
    log.say(fmt::format("cohesive law of \"{}\" from {} columns", set.name, set.columns.size()));
  log.say(fmt::format("results go to {}", session.results.string()));
  log.say("the input is valid");
}

void mesh_only(const FractureProgram& program, Session& session) {
  const Mesh mesh = make_mesh(program, session.log);
  model_on(program.fracture, mesh);
  const FolderLock lock(session.results);
  for (const std::string& line : lines_of(describe(mesh_quality(mesh)))) session.log.say(line);
  write_mesh(session.results, mesh);
  session.log.say(fmt::format("written to {}", (session.results / "mesh.vtu").string()));
}

std::optional<FractureState> state_to_go_on_from(const FractureProgram& program, const FractureState& initial,
                                                 std::size_t n_column_sets, const Session& session) {
  if (!session.restart) return std::nullopt;
  try {
    auto state = find_checkpoint(session.results, program.hash);
    if (state &&
        (state->damage.size() != initial.damage.size() || state->displacement.size() != initial.displacement.size()))
      throw InputError(fmt::format("{}: the checkpoint belongs to another mesh", session.results.string()));
    if (state) require_steps_up_to(*state, session.results, program.fracture, n_column_sets);
    return state;
  } catch (const OtherCase& error) {
    throw OtherCase(fmt::format("{}; without --restart the run starts anew and replaces it", error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; without --restart the run starts anew and replaces it", error.what()));
  }
}

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

void cohesive(const FractureProgram& program, Session& session, bool in_run = false) {
  write_cohesive_laws(program.fracture, program.file, program.name, program.hash, session, in_run);
}

/// A run that steps.
struct RunningCase {
  const FractureProgram& program;
  Session& session;
  RunTimes& times;
  FractureRun& run;
  FractureResults& results;
  CoarseCells coarse;
  FollowedRows followed;  ///< by a script
  FractureState state;    ///< the last one that was reached
  bool goes_on = false;   ///< from a state that is in the results already
  std::optional<LivePages> live{};
};

ProgressUnits progress_units(const FractureProgram& program) {
  return {.units = read_curve_units(program.file, program.fracture.output.curve),
          .is_box = program.fracture.box.has_value()};
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
  RunProgress progress(c.session.log, c.state.load, c.program.fracture.loading.end, progress_units(c.program));
  const LooksForStop looks;
  const auto iterated = [&](const IterationReport& iteration) {
    progress.iterated(iteration);
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
  log.say(fmt::format("  {} of this run:", counted(static_cast<Index>(log.warnings().size()), "warning")));
  for (const std::string& warning : log.warnings()) log.say(fmt::format("  - {}", warning));
}

/// "See force_displacement.csv (curve), fields.pvd (ParaView), run.log (all steps).", of what there is.
std::string where_to_look(const std::filesystem::path& results) {
  std::string files;
  for (const auto& [what, file] : {std::pair("curve", curve_file), std::pair("ParaView", "fields.pvd"),
                                   std::pair("laws", "cohesive.json"), std::pair("all steps", "run.log")})
    if (std::filesystem::exists(results / file))
      files += fmt::format("{}{} ({})", files.empty() ? "See " : ", ", file, what);
  return files + ".";
}

/// The summary is the last file of all: where it says "complete", all is there. Returns what is to be said at last.
std::string finish(RunningCase& c, const std::string& status) {
  RunSummary summary = summary_of(c.program, c.session, c.run, c.times);
  summary.status = status;
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

void solve(RunningCase& c) {
  try {
    const std::string status = advance(c);
    c.results.write_what_waits(c.state);
    if (c.results.records_columns()) cohesive(c.program, c.session, true);
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

/// Made, or found where several runs share it.
const Mesh& find_mesh(const FractureProgram& program, MeshStore& meshes, Log& log) {
  return meshes.get(program.mesh_hash, [&] { return make_mesh(program, log); });
}

void prepare(const FractureProgram& program, Session& session) {
  if (session.meshes) find_mesh(program, *session.meshes, session.log);
}

void run_case(FractureProgram program, Session& session) {
  if (session.figures_only) {
    program.fracture.output.figures_only = true;
    program.fracture.output.tips.clear();
  }
  session.log.say(head_line(session, fmt::format("case {}: {}", program.name, program.fracture.title)));
  RunTimes times;
  MeshStore own_mesh;
  const Mesh& mesh = find_mesh(program, session.meshes ? *session.meshes : own_mesh, session.log);
  times.mesh = times.whole.seconds();
  FractureRun run = make_run(program, mesh, session.log);
  warn_of_interfaces(run, session.log);
  if (!session.figures_only)
    if (const auto words = bending_warning(mesh, run.model())) session.log.say(*words);
  if (const auto words = locking_warning(mesh, run.model()); words && !session.figures_only) session.log.warn(*words);
  const FractureState initial = run.initial_state();
  const std::vector<ColumnSet> surfaces = column_sets(program.fracture.cohesive, mesh, run.model());
  const std::vector<ColumnSet> none, &columns = session.figures_only ? none : surfaces;
  const DebondingWatch watch(surfaces, program.fracture.cohesive.axis, initial.damage);
  const FolderLock lock(session.results);
  const auto last = state_to_go_on_from(program, initial, columns.size(), session);
  if (last && last->load >= program.fracture.loading.end && status_of_earlier(session.results) == "complete") {
    session.log.say(fmt::format("the run in {} is complete already", session.results.string()));
    return;
  }
  FractureResults results(session.results, mesh, run.model(), program.fracture, columns, watch, program.hash, last);
  if (!session.figures_only) write_mesh(results.folder(), mesh);
  session.log.open_file(results.folder() / "run.log", last.has_value());
  if (session.restart)
    session.log.say(last ? fmt::format("continuing after step {}, load {:.6g}", last->step, last->load)
                         : "no checkpoint found: starting from the beginning");
  else if (results.wait())
    say_what_is_replaced(session, program.file, program.hash, true);
  if (!session.figures_only) keep_case(program.file, session.version, session.results, results.folder());
  RunningCase running{program,
                      session,
                      times,
                      run,
                      results,
                      CoarseCells(mesh, run.model()),
                      FollowedRows(session.curve_to),
                      last ? *last : initial,
                      last.has_value()};
  if (session.live)
    running.live.emplace(LiveCase{.fracture = program.fracture,
                                  .experiment = program.experiment,
                                  .file = program.file,
                                  .title = fmt::format("{}: {}", program.name, program.fracture.title),
                                  .command = session.live->command,
                                  .report = session.live->report},
                         session);
  running.followed.write(curve_header() + "\n");
  solve(running);
}

void compare(const FractureProgram& program, Session& session) {
  if (!program.experiment) throw InputError(fmt::format("{}: it names no [experiment] to compare with", program.name));
  compare_with_experiment(program.fracture, *program.experiment, program.name, program.hash, session);
}

void fit(const FractureProgram& program, Session& session) {
  if (!program.experiment)
    throw InputError(fmt::format("{}: it names no [experiment] that the curve could be fitted to", program.name));
  const auto read = [component = program.fracture.output.curve.component](const std::filesystem::path& results) {
    return computed_curve(read_curve(results / curve_file), component);
  };
  const ExperimentSettings& experiment = *program.experiment;
  fit_curve({.file = program.file,
             .settings = *program.fit,
             .specimens = experiment.specimens,
             .straight_from = experiment.stiffness_from,
             .straight_to = experiment.stiffness_to,
             .set_ups = [](const CaseFile& file) { return read_set_ups(file.config.root()); },
             .read_curve = read,
             .other_laws = with_other_laws(program.file),
             .name = program.name,
             .hash = program.hash,
             .title = program.fracture.title},
            session);
}

CasePage page_of(const FractureProgram& program, const Session& session) {
  return {.report = fracture_page(program.fracture, program.experiment, program.name, program.hash, session.results),
          .extras = fracture_extras(program.fracture, program.file, program.hash, session.results)};
}

/// The case that the program holds, once it is read; what needs [experiment] and [fit] is left out.
RunnableCase runnable(const std::shared_ptr<FractureProgram>& program) {
  const CaseFile& file = program->file;
  program->name = case_name(file);
  std::vector<std::filesystem::path> data_files = program->fracture.mesh.data_files;
  data_files.insert(data_files.end(), program->fracture.data_files.begin(), program->fracture.data_files.end());
  program->hash = case_hash(file, data_files, may_change_on_the_way);
  program->mesh_hash = table_hash(file, "mesh", program->fracture.mesh.data_files);
  if (const auto ell = program->fracture.mesh.ell) program->mesh_hash += fmt::format(" ell {}", *ell);
  return {.title = program->fracture.title,
          .check = [program](Session& session) { check(*program, session); },
          .mesh = [program](Session& session) { mesh_only(*program, session); },
          .run = [program](Session& session) { run_case(*program, session); },
          .cohesive = [program](Session& session) { cohesive(*program, session); },
          .page = [program](const Session& session) { return page_of(*program, session); },
          .prepare = [program](Session& session) { prepare(*program, session); },
          .data_files = data_files,
          .goes_on = true};
}

RunnableCase read_program(const CaseFile& file) {
  auto program = std::make_shared<FractureProgram>(FractureProgram{.file = file});
  program->fracture = read_fracture_case(file.config.root(), file.directory);
  program->experiment = read_experiment(file.config.root(), file.directory);
  program->fit = read_curve_fit(file);
  RunnableCase found = runnable(program);
  found.compare = [program](Session& session) { compare(*program, session); };
  found.fit = [program](Session& session) { fit(*program, session); };
  if (!program->fit)
    found.fit = job_without_table(file, "fit",
                                  "[[fit.parameters]] that name the values to be estimated with their bounds, and "
                                  "[experiment] with the measured curve",
                                  "bar_fit");
  return found;
}

}  // namespace

RunnableCase runnable_box(const CaseFile& file, FractureCase box) {
  auto program = std::make_shared<FractureProgram>(FractureProgram{.file = file, .fracture = std::move(box)});
  return runnable(program);
}

CaseKind fracture_kind() {
  return {.name = "fracture",
          .description = "phase-field fracture of a solid under load",
          .read = read_program,
          .laws = fracture_laws,
          .keys = [] { return std::vector<const KeyTable*>{&fracture_keys()}; }};
}

}  // namespace pfdm
