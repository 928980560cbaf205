#include "cases/program/fracture_program.h"

#include "cases/program/curve_fit.h"
#include "cases/program/experiment_case.h"
#include "cases/program/fracture_case.h"
#include "cases/program/fracture_cohesive.h"
#include "cases/program/fracture_comparison.h"
#include "cases/program/fracture_report.h"
#include "cases/program/fracture_results.h"
#include "cases/program/progress.h"
#include "cases/program/report_parts.h"
#include "cases/program/resolution.h"
#include "cases/program/stop_signal.h"
#include "cases/program/stopwatch.h"
#include "mesh/quality.h"
#include "postproc/folder_lock.h"
#include "solver/fracture_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pfdm {
namespace {

/// Tables that say how the load is stepped and the steps are solved, and what they are compared with; not what is
/// loaded.
constexpr std::string_view may_change_on_the_way[] = {"solver", "loading", "experiment", "fit", "sweep"};

/// Thrown out of the load stepping when no more steps are wanted.
struct EnoughSteps {
  const char* why;
};

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
  return mesh;
}

FractureRun make_run(const FractureProgram& program, const Mesh& mesh, Log& log) {
  const FractureCase& fracture = program.fracture;
  FractureModel model = model_on(fracture, mesh);
  for (const std::string& warning : resolution_warnings(mesh, model, fracture.materials.bands)) log.warn(warning);
  return FractureRun(mesh, std::move(model), fracture.staggered, fracture.loading);
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

/// Peak of the bead benchmark: 193 MB with 98,000 faces (42,000 tetrahedra and prisms), 448 MB with 261,000; 272 MB
/// with 77,000 faces of 17,000 polyhedra, which VTK's grid holds as triangles.
double estimated_memory(const Mesh& mesh) {
  const bool polyhedra = std::ranges::find(mesh.shape, CellShape::polyhedron) != mesh.shape.end();
  return (polyhedra ? 3.1e3 : 1.9e3) * mesh.n_faces() + 40e6;
}

void check_fit(const FractureProgram& program, Log& log) {
  require_start_within_bounds(*program.fit);
  for (const CurveFitParameter& parameter : program.fit->parameters)
    log.say(fmt::format("fit of {} between {} and {}", parameter.in_case.name,
                        parameter.in_case.shown(parameter.in_fit.lower),
                        parameter.in_case.shown(parameter.in_fit.upper)));
}

void check(const FractureProgram& program, Session& session) {
  Log& log = session.log;
  const LoadingSettings& loading = program.fracture.loading;
  const Mesh mesh = make_mesh(program, log);
  const FractureRun run = make_run(program, mesh, log);
  const std::vector<ColumnSet> columns = column_sets(program.fracture.cohesive, mesh);
  log.say(fmt::format("{}: {}", program.name, program.fracture.title));
  log.say(fmt::format("cells {}", mesh.n_cells()));
  say_regions(mesh, log);
  log.say(fmt::format("unknowns {} of displacement, {} of damage", run.n_unknowns(), mesh.n_cells()));
  log.say(fmt::format("memory about {:.0f} MB", 1e-6 * estimated_memory(mesh)));
  log.say(fmt::format("steps {} or more, up to load {:g}", std::ceil(loading.end / loading.maximum_increment - 1e-9),
                      loading.end));
  if (program.fit) check_fit(program, log);
  for (const ColumnSet& set : columns)
    log.say(fmt::format("cohesive law of \"{}\" from {} columns", set.name, set.columns.size()));
  log.say(fmt::format("results go to {}", session.results.string()));
  log.say("the input is in order");
}

void mesh_only(const FractureProgram& program, Session& session) {
  const Mesh mesh = make_mesh(program, session.log);
  model_on(program.fracture, mesh);
  for (const std::string& line : lines_of(describe(mesh_quality(mesh)))) session.log.say(line);
  write_mesh(session.results, mesh);
  session.log.say(fmt::format("written to {}", (session.results / "mesh.vtu").string()));
}

std::optional<FractureState> state_to_go_on_from(const FractureProgram& program, const FractureState& initial,
                                                 const Session& session) {
  if (!session.restart) return std::nullopt;
  auto state = find_checkpoint(session.results, program.hash);
  if (state &&
      (state->damage.size() != initial.damage.size() || state->displacement.size() != initial.displacement.size()))
    throw InputError(
        fmt::format("{}: the checkpoint belongs to another mesh; run without --restart", session.results.string()));
  return state;
}

RunSummary summary_of(const FractureProgram& program, const Session& session, const FractureRun& run,
                      const RunTimes& times) {
  RunSummary summary;
  summary.case_name = program.name;
  summary.version = session.version;
  summary.threads = session.threads;
  summary.unknowns = run.n_unknowns();
  summary.staggered_iterations = run.staggered_iterations();
  summary.window_iterations = run.window_iterations();
  summary.krylov_iterations = run.krylov_iterations();
  summary.cpu_seconds_by_stage = run.cpu_seconds_by_stage();
  summary.wall_seconds = times.whole.seconds();
  summary.wall_seconds_by_stage = {
      {"mesh", times.mesh}, {"results", times.results}, {"solve", summary.wall_seconds - times.mesh - times.results}};
  summary.cpu_seconds = cpu_seconds();
  summary.peak_memory = peak_memory();
  return summary;
}

/// Steps until the end of the load, --max-steps or failure; returns what became of it.
std::string advance(FractureRun& run, FractureState& state, FractureResults& results, const FractureProgram& program,
                    Session& session, RunTimes& times) {
  RunProgress progress(session.log, state.load, program.fracture.loading.end);
  const Index first_step = state.step;
  const int component = program.fracture.output.curve.component;
  RunHooks hooks;
  const LooksForStop looks;
  hooks.iterated = [&](const IterationReport& iteration) {
    progress.iterated(iteration);
    stop_if_asked();
  };
  hooks.warned = [&](const std::string& message) { session.log.warn(message); };
  hooks.step_done = [&](const FractureState& now, const StepReport& report) {
    const Stopwatch watch;
    for (const std::string& warning : results.step_done(now, report, [&] { return run.output(now); }))
      session.log.warn(warning);
    times.results += watch.seconds();
    state = now;
    progress.step_done(report, results.last_row().displacement, results.last_row().force[component]);
    if (session.max_steps && now.step - first_step >= *session.max_steps) throw EnoughSteps{"stopped by --max-steps"};
    if (session.until && results.last_row().displacement >= *session.until && now.load < program.fracture.loading.end)
      throw EnoughSteps{"stopped where enough is known"};
  };
  try {
    run.run(state, hooks);
    return "complete";
  } catch (const EnoughSteps& enough) {
    return enough.why;
  }
}

void solve(FractureRun& run, FractureState state, FractureResults& results, const FractureProgram& program,
           Session& session, RunTimes& times) {
  const auto finish = [&](const std::string& status) {
    results.write_what_waits(state);
    RunSummary summary = summary_of(program, session, run, times);
    summary.status = status;
    results.write_summary(summary);
    return fmt::format("{} at step {}, load {:.6g}, after {:.1f} s; results in {}", status, state.step, state.load,
                       times.whole.seconds(), session.results.string());
  };
  try {
    session.log.say(finish(advance(run, state, results, program, session, times)));
  } catch (const Interrupted& wish) {
    const std::string told = finish(wish.what());
    session.log.record(told);
    throw Interrupted(wish.signal, told);
  } catch (const ComputationError& error) {
    try {
      results.write_last_frame([&] { return run.output(state); });
      session.log.say(finish(fmt::format("failed: {}", error.what())));
    } catch (const ComputationError&) {
      // A full disk is often what failed in the first place; the first message is the one to show.
    }
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
    program.fracture.cohesive = {};
  }
  session.log.say(fmt::format("pfdm {}, case {}: {}; {} threads", session.version, program.name, program.fracture.title,
                              session.threads));
  RunTimes times;
  MeshStore own_mesh;
  const Mesh& mesh = find_mesh(program, session.meshes ? *session.meshes : own_mesh, session.log);
  times.mesh = times.whole.seconds();
  FractureRun run = make_run(program, mesh, session.log);
  const FractureState initial = run.initial_state();
  const std::vector<ColumnSet> columns = column_sets(program.fracture.cohesive, mesh);
  const FolderLock lock(session.results);
  const auto last = state_to_go_on_from(program, initial, session);
  if (last && last->load >= program.fracture.loading.end && is_complete(session.results)) {
    session.log.say(fmt::format("the run in {} is complete already", session.results.string()));
    return;
  }
  if (!session.figures_only) write_mesh(session.results, mesh);
  session.log.open_file(session.results / "run.log", last.has_value());
  FractureResults results(session.results, mesh, run.model(), program.fracture, columns, program.hash, last);
  if (session.restart)
    session.log.say(last ? fmt::format("goes on after step {}, load {:.6g}", last->step, last->load)
                         : "there is no checkpoint to go on from: starts at the beginning");
  solve(run, last ? *last : initial, results, program, session, times);
  if (!columns.empty()) write_cohesive_laws(program.fracture, program.name, program.hash, session);
}

void cohesive(const FractureProgram& program, Session& session) {
  write_cohesive_laws(program.fracture, program.name, program.hash, session);
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
  fit_curve({program.file, *program.fit, program.experiment->specimens, read, program.name, program.hash,
             program.fracture.title},
            session);
}

void report(const FractureProgram& program, Session& session) {
  write_report(fracture_page(program.fracture, program.experiment, program.name, program.hash, session.results),
               session);
}

}  // namespace

RunnableCase read_fracture_program(const CaseFile& file) {
  auto program = std::make_shared<FractureProgram>(FractureProgram{.file = file});
  program->fracture = read_fracture_case(file.config.root(), file.directory);
  program->experiment = read_experiment(file.config.root(), file.directory);
  program->fit = read_curve_fit(file);
  program->name = case_name(file);
  program->hash = case_hash(file, program->fracture.mesh.data_files, may_change_on_the_way);
  program->mesh_hash = table_hash(file, "mesh", program->fracture.mesh.data_files);
  RunnableCase runnable{.title = program->fracture.title,
                        .check = [program](Session& session) { check(*program, session); },
                        .mesh = [program](Session& session) { mesh_only(*program, session); },
                        .run = [program](Session& session) { run_case(*program, session); },
                        .cohesive = [program](Session& session) { cohesive(*program, session); },
                        .compare = [program](Session& session) { compare(*program, session); },
                        .report = [program](Session& session) { report(*program, session); },
                        .prepare = [program](Session& session) { prepare(*program, session); },
                        .data_files = program->fracture.mesh.data_files};
  runnable.goes_on = true;
  runnable.fit = [program](Session& session) { fit(*program, session); };
  if (!program->fit)
    runnable.fit = job_without_table(file, "fit",
                                     "[[fit.parameters]] that name the values to be estimated with their bounds, and "
                                     "[experiment] with the measured curve",
                                     "bar_fit");
  return runnable;
}

}  // namespace pfdm
