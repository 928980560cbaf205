#include "cases/program/fracture/run/differentiated_run.h"

#include "cases/program/session/terminal/stop_signal.h"
#include "postproc/curves/curve_jumps.h"
#include "postproc/curves/summary.h"
#include "solver/fracture/derivatives/run_derivatives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

// Relative. Differences of forces lose few digits by it, and their second order is as small.
constexpr double step_of_differences = 1e-5;

/// The case with a parameter a little greater, and by how much, relative: values are written with eight digits.
std::pair<FractureCase, double> shifted_case(const FractureProgram& program, const CaseParameter& parameter) {
  const std::array value{parameter.value * (1.0 + step_of_differences)};
  const CaseFile file = with_values(program.file, std::span(&parameter, 1), value);
  const double step = case_parameter(parameter.name, file).value / parameter.value - 1.0;
  return {read_fracture_case(file.config.root(), file.directory), step};
}

/// The curve's force and displacement, and how a parameter moves them.
struct CurveOfRun {
  const Mesh& mesh;
  Index patch;
  int component;

  RowDerivative row(const RunDerivatives::Derivative& by) const {
    RowDerivative found{.displacement = by.patch_displacement[as_size(patch)][component], .unsolved = by.unsolved};
    const Patch& of = mesh.patches[as_size(patch)];
    for (Index f = 0; f < of.n_faces; ++f)
      found.force += by.boundary_force[as_size(of.first_face + f - mesh.n_interior_faces())][component];
    return found;
  }
};

/// Whether the force fell at once in the last step.
bool has_jumped(const std::vector<CurveRow>& rows, int component) {
  double largest = 0.0;
  for (const CurveRow& row : rows) largest = std::max(largest, std::abs(row.force[component]));
  return rows[rows.size() - 2].force[component] - rows.back().force[component] > fall_of_jump * largest;
}

/// Outside of it signals end the program at once.
StepReport step_of(FractureRun& run, FractureState& state) {
  const LooksForStop looks;
  return run.step(state, [](const IterationReport&) { stop_if_asked(); });
}

CurveOfRun curve_of(const FractureProgram& program, const Mesh& mesh) {
  const CurveSettings& curve = program.fracture.output.curve;
  Index patch = 0;
  while (mesh.patches[as_size(patch)].name != curve.patch) ++patch;
  return {mesh, patch, curve.component};
}

/// Adds the parameters that can be; says of the others why not.
std::vector<std::size_t> add_parameters(const FractureProgram& program, std::span<const CaseParameter> parameters,
                                        const Mesh& mesh, RunDerivatives& derivatives, DirectSensitivity& found) {
  std::vector<std::size_t> added;
  found.failures.resize(parameters.size());
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    try {
      const auto [fracture, step] = shifted_case(program, parameters[j]);
      derivatives.add(model_on(fracture, mesh), step);
      added.push_back(j);
    } catch (const InputError& error) {
      found.failures[j] = error.what();
    }
  }
  return added;
}

}  // namespace

std::string refusal_of_derivatives(const FractureProgram& program, const Mesh& mesh) {
  return RunDerivatives::refusal(mesh, model_on(program.fracture, mesh), program.fracture.loading);
}

DirectSensitivity differentiated_run(const FractureProgram& program, std::span<const CaseParameter> parameters,
                                     const Mesh& mesh, Session& session) {
  const FractureCase& fracture = program.fracture;
  const FractureModel model = model_on(fracture, mesh);
  if (const std::string why = RunDerivatives::refusal(mesh, model, fracture.loading); !why.empty())
    throw InputError(fmt::format("--method direct: there are no direct derivatives of runs with {}", why));
  DirectSensitivity found;
  RunDerivatives derivatives(mesh, model, fracture.staggered);
  const std::vector<std::size_t> added = add_parameters(program, parameters, mesh, derivatives, found);
  FractureRun run(mesh, model, fracture.staggered, fracture.loading);
  const CurveOfRun curve = curve_of(program, mesh);
  FractureState state = run.initial_state();
  std::vector<CurveRow> rows{curve_row(run.report_of(state), curve.patch, curve.component)};
  found.by_load.emplace_back();
  found.by.assign(parameters.size(), std::vector<RowDerivative>(1));
  while (!run.is_complete(state)) {
    const double began = cpu_seconds();
    const FractureState start = state;
    const StepReport report = step_of(run, state);
    rows.push_back(curve_row(report, curve.patch, curve.component));
    const double stepped = cpu_seconds();
    const bool jumped = has_jumped(rows, curve.component);
    derivatives.follow(start, state, jumped);
    found.by_load.push_back(curve.row(derivatives.by_load()));
    for (std::size_t k = 0; k < added.size(); ++k) {
      if (jumped) found.by[added[k]].back().jump = {derivatives.jump(k).load, derivatives.jump(k).changed};
      found.by[added[k]].push_back(curve.row(derivatives.by(k)));
    }
    found.seconds_of_run += stepped - began;
    found.seconds_more += cpu_seconds() - stepped;
    session.log.step(fmt::format("  step {}: load {:.6g} of {:.6g}, {} iterations of the derivatives", state.step,
                                 state.load, fracture.loading.end, derivatives.iterations()));
  }
  for (const CurveRow& row : rows) {
    if (!found.curve.x.empty() && row.displacement < found.curve.x.back())
      throw InputError("--method direct: the displacement of the curve falls; differences have no rows of that kind");
    found.curve.x.push_back(row.displacement);
    found.curve.y.push_back(row.force[curve.component]);
  }
  return found;
}

}  // namespace pfdm
