#pragma once
// Bodies of endochronic cells and their steps.

#include "physics/materials/endochronic_material.h"
#include "solver/fracture/fracture_run.h"
#include "solver/point/mixed_control.h"
#include "tests/verification/support.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pfdm::verification {

inline EndochronicLaw soft_metal(bool looks_at_rate = false) {
  EndochronicLaw law{.elasticity = from_young_poisson(117e9, 0.34),
                     .kernel = {{60e9, 3000.0}, {15e9, 500.0}, {2e9, 30.0}},
                     .hardening = {}};
  law.hardening.with_path = make_factor(hardening_law("saturating"), {3.0, 6.0, 1.0});
  if (looks_at_rate) law.hardening.with_rate = make_factor(rate_factor("logarithmic"), {0.02, 1e-5});
  return law;
}

inline FractureModel endochronic_model(const EndochronicLaw& law, std::vector<BoundaryCondition> boundary) {
  FractureModel model = elastic_model({law.elasticity}, std::move(boundary));
  model.regions[0].material = make_endochronic_material(law);
  return model;
}

inline constexpr StaggeredSettings tight{
    .damage_tolerance = 1e-9, .energy_tolerance = 1e-14, .equilibrium_tolerance = 1e-13};

inline LoadingSettings in_steps(Index n, double duration = 1.0) {
  const double increment = 1.0 / double(n);
  return {.initial_increment = increment, .maximum_increment = increment, .duration = duration, .stops = {}};
}

struct Step {
  StepReport report;
  OutputFields fields;
};

inline std::vector<Step> steps_of(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading,
                                  const StaggeredSettings& settings = tight) {
  FractureRun run(mesh, model, settings, loading);
  std::vector<Step> steps;
  const auto step_done = [&](const FractureState& state, const StepReport& report) {
    if (report.step > 0) steps.push_back({report, run.output(state)});
  };
  run_to_end(run, step_done);
  return steps;
}

inline const CellField<double>& path_length(const OutputFields& fields) {
  return std::ranges::find(fields.history, "plastic_path_length", &OutputHistory::name)->scalar;
}

inline Index most_iterations(const std::vector<Step>& steps) {
  return std::ranges::max_element(steps, {}, [](const Step& s) { return s.report.staggered_iterations; })
      ->report.staggered_iterations;
}

}  // namespace pfdm::verification
