#include "cases/program/fracture/fracture_studies.h"

#include "cases/program/fracture/fracture_check.h"
#include "cases/program/fracture/fracture_reduction.h"
#include "cases/program/fracture/other_laws.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/opening_law.h"
#include "cases/program/fracture/outcome/recorded_steps.h"
#include "cases/program/fracture/run/differentiated_run.h"
#include "cases/program/studies/fit/curve_fit.h"
#include "cases/program/studies/sensitivity/sensitivity.h"
#include "physics/error.h"
#include "postproc/displacements/place_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

/// How the curve is read from the results of a run.
CurveModel::ReadCurve curve_reader(const FractureProgram& program) {
  return [component = program.fracture.output.curve.component](const std::filesystem::path& results) {
    const std::vector<CurveRow> rows = read_curve(results / curve_file);
    return computed_curve(rows, component, first_debonding_in(results, rows, component));
  };
}

/// What a fit of fields reads of a run.
CurveModel::ReadHistory history_reader(const FractureProgram& program) {
  return [component = program.fracture.output.curve.component](const std::filesystem::path& results) {
    FieldHistory history{.followed = {.name = "computed", .x = {}, .y = {}}, .rows = read_place_record(results)};
    for (const CurveRow& row : read_curve(results / curve_file)) {
      history.followed.x.push_back(row.displacement);
      history.followed.y.push_back(row.force[component]);
    }
    const std::size_t n = std::min(history.rows.size(), history.followed.x.size());
    history.rows.resize(n);
    history.followed.x.resize(n);
    history.followed.y.resize(n);
    return history;
  };
}

/// The same along the way that it moves first; what falls back behind the largest displacement is left out.
SensitivityJob::ReadForward forward_reader(const FractureProgram& program) {
  return [component = program.fracture.output.curve.component](const std::filesystem::path& results) {
    std::vector<CurveRow> rows = read_curve(results / curve_file);
    const auto first = first_debonding_in(results, rows, component);
    const auto moved = std::ranges::find_if(rows, [](const CurveRow& row) { return row.displacement != 0.0; });
    ForwardCurve found{.is_turned = moved != rows.end() && moved->displacement < 0.0};
    double reached = 0.0;
    for (CurveRow& row : rows) {
      if (found.is_turned) row.displacement = -row.displacement, row.force = -row.force;
      found.n_behind += row.displacement < reached ? 1 : 0;
      reached = std::max(reached, row.displacement);
    }
    found.curve = computed_curve(rows, component, first);
    return found;
  };
}

DirectSensitivity direct_sensitivity(const FractureProgram& program, std::span<const CaseParameter> parameters,
                                     Session& session) {
  MeshStore own;
  const Mesh& mesh = find_mesh(program, own, session.log);
  if (const std::string why = refusal_of_derivatives(program, mesh); !why.empty())
    throw InputError(fmt::format("--method direct: there are no direct derivatives of runs with {}", why));
  FractureRun run = made_run(program, mesh, session.log);
  return differentiated_run(program, parameters, run, mesh, session);
}

}  // namespace

void find_sensitivity(const FractureProgram& program, Session& session) {
  std::vector<CaseParameter> fitted;
  std::vector<std::string> left_out;
  if (program.fit)
    for (const CurveFitParameter& p : program.fit->parameters) {
      if (!p.in_case.name.starts_with("experiment") && p.in_case.value > 0.0)
        fitted.push_back(p.in_case);
      else
        left_out.push_back(p.in_case.name);
    }
  run_sensitivity({.file = program.file,
                   .fitted = std::move(fitted),
                   .left_out = std::move(left_out),
                   .read_curve = forward_reader(program),
                   .direct = [&program](std::span<const CaseParameter> parameters,
                                        Session& s) { return direct_sensitivity(program, parameters, s); },
                   .name = program.name,
                   .title = program.fracture.title,
                   .hash = program.hash},
                  session);
}

void fit_fracture(const FractureProgram& program, Session& session) {
  if (!program.experiment)
    throw InputError(fmt::format("{}: it names no [experiment] that the curve could be fitted to", program.name));
  const ExperimentSettings& experiment = *program.experiment;
  const std::vector<MeasuredEvent> events = events_of_fit(program);
  MeasuredFields fields;
  if (!experiment.fields.empty()) {
    MeshStore own;
    fields = fields_of_fit(program, find_mesh(program, own, session.log), session.log);
  }
  const bool is_reduced = can_be_reduced(program, session.log);
  fit_curve({.file = program.file,
             .settings = *program.fit,
             .specimens = experiment.specimens,
             .events = events,
             .fields = fields,
             .straight_from = experiment.stiffness_from,
             .straight_to = experiment.stiffness_to,
             .set_ups = [](const CaseFile& file) { return read_set_ups(file.config.root()); },
             .read_curve = curve_reader(program),
             .read_history = history_reader(program),
             .laws = opening_laws,
             .other_laws = with_other_laws(program.file),
             .name = program.name,
             .hash = program.hash,
             .title = program.fracture.title},
            session);
  if (is_reduced) reduce_tests(program, session);
}

}  // namespace pfdm
