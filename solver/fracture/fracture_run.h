#pragma once
// A fracture run from its mesh and model: the load stepping, with hooks for the output of results.

#include "mesh/mesh.h"
#include "solver/fracture/fracture_model.h"
#include "solver/fracture/state.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace pfdm {

/// Progress of the solution of a step.
struct IterationReport {
  Index step = 0;
  Index iteration = 0;
  double load = 0.0;
  double damage_change = 0.0;
  double energy_change = 0.0;
  Index krylov_iterations = 0;
};

struct RunHooks {
  /// After every accepted step; in run() once for the state before the first one as well (step 0).
  std::function<void(const FractureState&, const StepReport&)> step_done;
  std::function<void(const IterationReport&)> iterated;
  std::function<void(const std::string& message)> warned;
};

class FractureRun {
 public:
  /// Throws InputError for inconsistent input: a missing patch, a body free to move, a region without toughness.
  FractureRun(const Mesh& mesh, FractureModel model, StaggeredSettings staggered, LoadingSettings loading);
  ~FractureRun();

  FractureState initial_state() const;
  /// From a start, as initial_state() is one, to the end of the load. Throws ComputationError when the smallest
  /// increment does not converge; all accepted steps have then been reported.
  FractureState run(FractureState start, const RunHooks& hooks);
  /// Likewise from a state that a run has reported, which is not reported again.
  FractureState go_on(FractureState state, const RunHooks& hooks);

  OutputFields output(const FractureState& state) const;
  const FractureModel& model() const;
  Index n_unknowns() const;  ///< of displacement
  std::map<std::string, double> cpu_seconds_by_stage() const;
  Index krylov_iterations() const;
  Index staggered_iterations() const;
  double window_iterations() const;  ///< besides, in windows, each counting as its share of the cells

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pfdm
