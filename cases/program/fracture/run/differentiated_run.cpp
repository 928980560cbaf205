#include "cases/program/fracture/run/differentiated_run.h"

#include "cases/program/session/terminal/stop_signal.h"
#include "postproc/curves/curve_jumps.h"
#include "postproc/curves/summary.h"
#include "solver/fracture/derivatives/run_derivatives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

// Relative. Differences of forces lose few digits by it, and their second order is as small.
constexpr double step_of_differences = 1e-5;

/// What decides on the mesh, the steps and how they are solved: derivatives of one run do not follow it.
bool is_kept(std::string_view key) {
  constexpr std::array<std::string_view, 4> tables{"mesh.", "loading.", "solver.", "output."};
  return std::ranges::any_of(tables, [&](std::string_view table) { return key.starts_with(table); });
}

/// The case with a parameter a little greater, in all digits, and by how much, relative.
std::pair<FractureCase, double> shifted_case(const FractureProgram& program, const CaseParameter& parameter) {
  if (std::ranges::any_of(parameter.keys, is_kept))
    throw InputError("--method direct keeps the mesh and the steps; take --method differences");
  std::string text = program.file.text;
  for (std::size_t k = 0; k < parameter.keys.size(); ++k) {
    const CaseParameter there = case_parameter(parameter.keys[k], program.file);
    const double si = parameter.value * (1.0 + step_of_differences) * parameter.ratios[k];
    const std::string value = fmt::format("{:.17g}", there.in_file_units(si));
    text = with_value(text, there.name, there.unit.empty() ? value : fmt::format("\"{} {}\"", value, there.unit));
  }
  const CaseFile file = with_text(program.file, std::move(text));
  const double step = case_parameter(parameter.name, file).value / parameter.value - 1.0;
  return {read_fracture_case(file.config.root(), file.directory), step};
}

/// The curve's force and displacement, and how a parameter moves them.
struct CurveOfRun {
  Index patch;
  int component;

  double sign = 0.0;     // with which it is read: -1 if it moves to negative displacements; 0: not moved yet
  double largest = 0.0;  // force
  bool is_after_jump = false;

  RowDerivative row(const RunDerivatives::Derivative& by) const {
    RowDerivative found{.force = by.reaction[patch][component],
                        .displacement = by.patch_displacement[patch][component],
                        .unsolved = by.unsolved,
                        .is_after_jump = is_after_jump};
    if (sign < 0.0) found.displacement = -found.displacement, found.force = -found.force;
    return found;
  }
  /// Adds a row to the curve; returns whether the force fell at once. Throws InputError where the displacement falls.
  bool add(const StepReport& report, SampledCurve& to) {
    const CurveRow row = curve_row(report, patch, component);
    if (sign == 0.0 && row.displacement != 0.0) sign = row.displacement < 0.0 ? -1.0 : 1.0;
    const double turn = sign < 0.0 ? -1.0 : 1.0, x = turn * row.displacement, y = turn * row.force[component];
    if (!to.x.empty() && x < to.x.back())
      throw InputError(fmt::format(
          "--method direct: the displacement of the curve falls in step {}; --method differences leaves such rows out",
          report.step));
    largest = std::max(largest, std::abs(y));
    const bool jumped = !to.y.empty() && to.y.back() - y > fall_of_jump * largest;
    is_after_jump = is_after_jump || jumped;
    to.x.push_back(x);
    to.y.push_back(y);
    return jumped;
  }
};

/// Outside of it signals end the program at once.
StepReport step_of(FractureRun& run, FractureState& state, Log& log) {
  const LooksForStop looks;
  StepReport report = run.step(state, [](const IterationReport&) { stop_if_asked(); });
  for (const std::string& remark : report.remarks) log.warn(remark);
  return report;
}

CurveOfRun curve_of(const FractureProgram& program, const Mesh& mesh) {
  const CurveSettings& curve = program.fracture.output.curve;
  return {.patch = mesh.patch_index(curve.patch), .component = curve.component};
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
  if (added.empty()) throw InputError(fmt::format("--parameters {}: {}", parameters[0].name, found.failures[0]));
  return added;
}

}  // namespace

std::string refusal_of_derivatives(const FractureProgram& program, const Mesh& mesh) {
  return RunDerivatives::refusal(mesh, model_on(program.fracture, mesh), program.fracture.loading);
}

DirectSensitivity differentiated_run(const FractureProgram& program, std::span<const CaseParameter> parameters,
                                     FractureRun& run, const Mesh& mesh, Session& session) {
  const FractureCase& fracture = program.fracture;
  DirectSensitivity found;
  RunDerivatives derivatives(mesh, model_on(fracture, mesh), fracture.staggered);
  const std::vector<std::size_t> added = add_parameters(program, parameters, mesh, derivatives, found);
  CurveOfRun curve = curve_of(program, mesh);
  FractureState state = run.initial_state();
  curve.add(run.report_of(state), found.curve);
  found.by_load.emplace_back();
  found.by.assign(parameters.size(), std::vector<RowDerivative>(1));
  while (!run.is_complete(state)) {
    const double began = cpu_seconds();
    const FractureState start = state;
    const bool jumped = curve.add(step_of(run, state, session.log), found.curve);
    const double stepped = cpu_seconds();
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
  mark_lost_rows(found);
  found.is_turned = curve.sign < 0.0;
  found.may_debond = !run.model().interfaces.empty();
  return found;
}

}  // namespace pfdm
