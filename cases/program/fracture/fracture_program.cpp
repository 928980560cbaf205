#include "cases/program/fracture/fracture_program.h"

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/fracture/case/run_keys.h"
#include "cases/program/fracture/fracture_check.h"
#include "cases/program/fracture/fracture_laws.h"
#include "cases/program/fracture/fracture_reduction.h"
#include "cases/program/fracture/fracture_studies.h"
#include "cases/program/fracture/outcome/fracture_cohesive.h"
#include "cases/program/fracture/outcome/fracture_comparison.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/fracture_results.h"
#include "cases/program/fracture/outcome/recorded_steps.h"
#include "cases/program/fracture/page/fracture_browser.h"
#include "cases/program/fracture/page/fracture_report.h"
#include "cases/program/fracture/run/running_case.h"
#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/input/fields/field_reader.h"
#include "cases/program/session/earlier_results.h"
#include "cases/program/session/head_line.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/fit/curve_fit.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/other_case.h"
#include "solver/fracture/fracture_run.h"
#include "solver/fracture/words/bending_words.h"
#include "solver/fracture/words/stiffness_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

/// Tables that say how the load is stepped and the steps are solved, and what they are compared with; not what is
/// loaded.
constexpr std::string_view may_change_on_the_way[] = {"solver", "loading", "experiment", "fit", "sweep"};

std::optional<FractureState> state_to_go_on_from(const FractureProgram& program, const FractureState& initial,
                                                 std::size_t n_column_sets, const Session& session) {
  if (!session.restart) return std::nullopt;
  try {
    auto state = find_checkpoint(session.results, program.hash);
    if (state &&
        (state->damage.size() != initial.damage.size() || state->displacement.size() != initial.displacement.size()))
      throw InputError(fmt::format("{}: the checkpoint belongs to another mesh", session.results.string()));
    if (state && state->heat.duration != initial.heat.duration)
      throw InputError(
          fmt::format("{}: its heat was made with [loading] duration = \"{:g} s\", which cannot change on the way",
                      session.results.string(), state->heat.duration));
    if (state) require_steps_up_to(*state, session.results, program.fracture, n_column_sets);
    return state;
  } catch (const OtherCase& error) {
    throw OtherCase(fmt::format("{}; without --restart the run starts anew and replaces it", error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; without --restart the run starts anew and replaces it", error.what()));
  }
}

void cohesive(const FractureProgram& program, Session& session) {
  write_cohesive_laws(program.fracture, program.file, program.name, program.hash, session, false);
}

void prepare(const FractureProgram& program, Session& session) {
  if (session.meshes) find_mesh(program, *session.meshes, session.log);
}

/// Leaves out what many runs do without, and adds what the job wants to know.
void adapt_output(FractureOutput& output, const Session& session) {
  if (session.figures_only) {
    output.figures_only = true;
    output.tips.clear();
  }
  if (session.places) output.places = *session.places;
}

void warn_of_model(const FractureRun& run, const Mesh& mesh, const Session& session) {
  warn_of_interfaces(run, session.log);
  if (session.figures_only) return;
  if (const auto words = bending_warning(mesh, run.model())) session.log.say(*words);
  for (const std::string& warning : stiffness_warnings(mesh, run.model())) session.log.warn(warning);
}

/// Files that stand beside the results from the start: mesh, log and case.
void begin_files(const FractureProgram& program, const Mesh& mesh, const FractureResults& results,
                 const std::optional<FractureState>& last, Session& session) {
  if (!session.figures_only) write_mesh(results.folder(), mesh);
  session.log.open_file(results.folder() / "run.log", last.has_value());
  if (session.restart)
    session.log.say(last ? fmt::format("continuing after step {}, load {:.6g}", last->step, last->load)
                         : "no checkpoint found: starting from the beginning");
  else if (results.wait())
    say_what_is_replaced(session, program.file, program.hash, true);
  if (!session.figures_only) keep_case(program.file, session.version, session.results, results.folder());
}

LiveCase live_case(const FractureProgram& program, const LiveCommands& commands) {
  return {.fracture = program.fracture,
          .experiment = program.experiment,
          .file = program.file,
          .title = fmt::format("{}: {}", program.name, program.fracture.title),
          .command = commands.command,
          .report = commands.report};
}

void run_case(FractureProgram program, Session& session) {
  adapt_output(program.fracture.output, session);
  session.log.say(head_line(session, fmt::format("case {}: {}", program.name, program.fracture.title)));
  RunTimes times;
  MeshStore own_mesh;
  const Mesh& mesh = find_mesh(program, session.meshes ? *session.meshes : own_mesh, session.log);
  times.mesh = times.whole.seconds();
  FractureRun run = made_run(program, mesh, session.log);
  warn_of_model(run, mesh, session);
  const FractureState initial = run.initial_state();
  const std::vector<ColumnSet> surfaces = column_sets(program.fracture.cohesive, mesh, run.model());
  const std::vector<ColumnSet> none, &columns = session.figures_only && !session.records_laws ? none : surfaces;
  const DebondingWatch watch(surfaces, program.fracture.cohesive.axis, initial.damage);
  const FolderLock lock(session.results);
  const auto last = state_to_go_on_from(program, initial, columns.size(), session);
  if (last && run.is_complete(*last) && status_of_earlier(session.results) == "complete") {
    session.log.say(fmt::format("the run in {} is complete already", session.results.string()));
    return;
  }
  FractureResults results(session.results, mesh, run.model(), program.fracture, columns, watch, program.hash, last);
  begin_files(program, mesh, results, last, session);
  RunningCase running{program,
                      session,
                      times,
                      mesh,
                      run,
                      results,
                      CoarseCells(mesh, run.model()),
                      FollowedRows(session.curve_to),
                      last ? *last : initial,
                      last.has_value()};
  if (session.live) running.live.emplace(live_case(program, *session.live), session);
  running.followed.write(curve_header() + "\n");
  solve(running);
}

void compare(const FractureProgram& program, Session& session) {
  if (!program.experiment) throw InputError(fmt::format("{}: it names no [experiment] to compare with", program.name));
  compare_with_experiment(program.fracture, *program.experiment, program.name, program.hash, session);
}

CasePage page_of(const FractureProgram& program, const Session& session) {
  return {.report = fracture_page(program.fracture, program.experiment, program.name, program.hash, session.results),
          .extras = fracture_extras(program.fracture, program.experiment, program.file, program.hash, session.results)};
}

/// The case that the program holds, once it is read; what needs [experiment] and [fit] is left out.
RunnableCase runnable(const std::shared_ptr<FractureProgram>& program) {
  const CaseFile& file = program->file;
  program->name = case_name(file);
  std::vector<std::filesystem::path> data_files = program->fracture.mesh.data_files;
  data_files.insert(data_files.end(), program->fracture.data_files.begin(), program->fracture.data_files.end());
  const std::vector<std::filesystem::path> fields = field_files(file);
  data_files.insert(data_files.end(), fields.begin(), fields.end());
  program->hash = case_hash(file, data_files, may_change_on_the_way);
  program->mesh_hash = table_hash(file, "mesh", program->fracture.mesh.data_files);
  if (const auto ell = program->fracture.mesh.ell) program->mesh_hash += fmt::format(" ell {}", *ell);
  return {.title = program->fracture.title,
          .check = [program](Session& session) { check_fracture(*program, session); },
          .mesh = [program](Session& session) { mesh_fracture(*program, session); },
          .run = [program](Session& session) { run_case(*program, session); },
          .cohesive = [program](Session& session) { cohesive(*program, session); },
          .page = [program](const Session& session) { return page_of(*program, session); },
          .prepare = [program](Session& session) { prepare(*program, session); },
          .data_files = data_files,
          .goes_on = true,
          .has_steps = true};
}

RunnableCase read_program(const CaseFile& file) {
  auto program = std::make_shared<FractureProgram>(FractureProgram{.file = file});
  program->fracture = read_fracture_case(file.config.root(), file.directory);
  program->experiment = read_experiment(file.config.root(), file.directory);
  program->reduction = read_reduction(file.config.root(), file.directory);
  program->fit = read_curve_fit(file);
  RunnableCase found = runnable(program);
  found.compare = [program](Session& session) { compare(*program, session); };
  found.reduce = [program](Session& session) { reduce_tests(*program, session); };
  if (!program->reduction)
    found.reduce = job_without_table(file, "experiment.reduction",
                                     "the specimen and its dimensions; its records stand in [experiment]", "dcb_fit");
  found.fit = [program](Session& session) { fit_fracture(*program, session); };
  found.sensitivity = [program](Session& session) { find_sensitivity(*program, session); };
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
