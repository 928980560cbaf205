#include "cases/program/fracture/fracture_check.h"

#include "cases/program/fracture/case/idle_keys.h"
#include "cases/program/fracture/fracture_reduction.h"
#include "cases/program/fracture/outcome/fracture_results.h"
#include "cases/program/fracture/run_estimate.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/fit/curve_fit.h"
#include "mesh/quality.h"
#include "physics/quantity_text.h"
#include "postproc/curves/event_rows.h"
#include "postproc/displacements/field_residuals.h"
#include "postproc/files/folder_lock.h"
#include "solver/fracture/fracture_run.h"
#include "solver/fracture/rate_resolution.h"
#include "solver/fracture/words/bending_words.h"
#include "solver/fracture/words/resolution.h"
#include "solver/fracture/words/stiffness_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

void say_regions(const Mesh& mesh, Log& log) {
  std::vector<Index> cells(mesh.region_names.size());
  for (const Index region : mesh.region) ++cells[region];
  for (std::size_t i = 0; i < cells.size(); ++i)
    log.say(fmt::format("  region {:<16} {:>9} cells", mesh.region_names[i], cells[i]));
}

void check_fit(const FractureProgram& program, Log& log) {
  const std::vector<MeasuredEvent> events = program.experiment ? events_of_fit(program) : std::vector<MeasuredEvent>{};
  if (program.experiment)
    program.fit->where.in_context([&] {
      require_deviations(program.experiment->specimens);
      return true;
    });
  try {
    require_start_within_bounds(program.fit->where, program.fit->parameters);
  } catch (const InputError& error) {  // a run is not concerned
    log.warn(fmt::format("{}; pfdm fit refuses this", error.what()));
  }
  for (const CurveFitParameter& parameter : program.fit->parameters)
    log.say(fmt::format("fit of {} between {} and {}", parameter.in_case.name,
                        parameter.in_case.shown(parameter.in_fit.lower),
                        parameter.in_case.shown(parameter.in_fit.upper)));
  for (const MeasuredEvent& event : events)
    log.say(event_words(event, program.experiment->specimens[event.specimen].curve.name));
  log.say(fit_words(*program.fit));
}

/// Of all specimens: residuals of fields stand beside those of all rows.
void require_known_noise(const FieldSettings& settings, const std::vector<MeasuredCurve>& specimens) {
  for (const MeasuredCurve& specimen : specimens)
    if (specimen.curve.deviation.empty())
      throw settings.where.error(
          fmt::format("with what weight the field counts beside the rows of \"{}\" is not known; give "
                      "[[experiment.specimens]] deviation",
                      specimen.curve.name));
  settings.where.in_context([&] {
    require_deviations(specimens);
    return true;
  });
}

}  // namespace

std::vector<MeasuredEvent> events_of_fit(const FractureProgram& program) {
  const ExperimentSettings& experiment = *program.experiment;
  std::vector<MeasuredEvent> events = events_in_records(experiment.events, experiment.specimens);
  require_in_a_stage(*program.fit, experiment.specimens, events);
  const auto full = full_displacement(program.fracture);
  for (std::size_t k = 0; full && k < events.size(); ++k) {
    const MeasuredCurve& specimen = experiment.specimens[events[k].specimen];
    const double place = displacement_of_specimen(specimen, events[k].place),
                 end = *full * program.fracture.loading.end;
    if (end > 0.0 && place > end)
      throw experiment.events[k].where.error(
          fmt::format("{} of \"{}\", at {} of the specimen, lies beyond the end of the load, {}: load further, or "
                      "leave it out",
                      events[k].name(), specimen.curve.name, quantity_text(place, "m"), quantity_text(end, "m")));
  }
  return events;
}

MeasuredFields fields_of_fit(const FractureProgram& program, const Mesh& mesh, Log& log) {
  const ExperimentSettings& experiment = *program.experiment;
  MeasuredFields found;
  if (program.fit && !experiment.fields.empty() && program.fit->solver.differences == Differences::shared)
    log.warn(
        "[fit] differences = \"shared\": with displacement fields they save no runs, for the fit goes on with central "
        "ones; take \"central\" and a small step");
  for (const FieldSettings& settings : experiment.fields) {
    require_known_noise(settings, experiment.specimens);
    const RecordedField recorded = read_recorded_field(settings, experiment.specimens, program.file.directory);
    found.fields.push_back(
        settings.where.in_context([&] { return selected_field(recorded, settings.selection, mesh, found.places); }));
    const MeasuredField& field = found.fields.back();
    std::size_t n = 0, n_data = 0;
    for (const FieldFrame& frame : field.frames) n += frame.places.size(), n_data += field.n_data(frame);
    if (!(field.deviation > 0.0) && n_data < fewest_for_noise)
      throw settings.where.error(too_few_for_noise(field.name, n_data));
    log.say(
        fmt::format("field \"{}\": {} frames from {}, {} places of {} or {:.0f} points, {} components", field.name,
                    field.frames.size(),
                    quantities_text({field.frames.front().displacement, field.frames.back().displacement}, "m", " to "),
                    n, quantity_text(field.pitch, "m", 3), field.frames.front().n_points.front(), field.n_components));
    for (const std::string& told : field.told) log.say(fmt::format("field \"{}\": {}", field.name, told));
  }
  return found;
}

Mesh made_mesh(const FractureProgram& program, Log& log) {
  for (const std::string& remark : program.fracture.materials.remarks) log.say(remark);
  for (const std::string& warning : idle_keys(program.fracture)) log.warn(warning);
  const Stopwatch watch;
  Mesh mesh = program.fracture.mesh.make();
  log.say(fmt::format("mesh: {} cells, {} points, {} faces, made in {:.1f} s", mesh.n_cells(), mesh.points.size(),
                      mesh.n_faces(), watch.seconds()));
  if (const auto warning = flat_cell_warning(mesh)) log.warn(*warning);
  if (program.fracture.output.frames.in_one_file && std::ranges::count(mesh.shape, CellShape::polyhedron) > 0)
    throw InputError(
        "output.format = \"vtkhdf\": files of VTKHDF 2.0 have no polyhedra, which this mesh has; \"vtu\" files have "
        "them");
  return mesh;
}

const Mesh& find_mesh(const FractureProgram& program, MeshStore& meshes, Log& log) {
  return meshes.get(program.mesh_hash, [&] { return made_mesh(program, log); });
}

FractureRun made_run(const FractureProgram& program, const Mesh& mesh, Log& log) {
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

void check_fracture(const FractureProgram& program, Session& session) {
  Log& log = session.log;
  const LoadingSettings& loading = program.fracture.loading;
  const Mesh mesh = made_mesh(program, log);
  const FractureRun run = made_run(program, mesh, log);
  warn_of_interfaces(run, log);
  for (const std::string& remark : rate_remarks(mesh, run.model(), loading)) log.say(remark);
  if (const std::string remark = direction_remark(mesh, run.model()); !remark.empty()) log.say(remark);
  if (const auto warning = bending_warning(mesh, run.model())) log.warn(*warning);
  for (const std::string& warning : stiffness_warnings(mesh, run.model())) log.warn(warning);
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
  if (program.fit && program.experiment) fields_of_fit(program, mesh, log);
  can_be_reduced(program, log);
  for (const ColumnSet& set : columns)
    log.say(fmt::format("cohesive law of \"{}\" from {} columns", set.name, set.columns.size()));
  log.say(fmt::format("results go to {}", session.results.string()));
  log.say("the input is valid");
}

void mesh_fracture(const FractureProgram& program, Session& session) {
  const Mesh mesh = made_mesh(program, session.log);
  model_on(program.fracture, mesh);
  const FolderLock lock(session.results);
  session.log.say_lines(describe(mesh_quality(mesh)));
  write_mesh(session.results, mesh);
  session.log.say(fmt::format("written to {}", (session.results / "mesh.vtu").string()));
}

}  // namespace pfdm
