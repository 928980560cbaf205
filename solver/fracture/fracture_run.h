#pragma once
// A fracture run from its mesh and model: the load stepping, a step at a time.
//
//   FractureState state = run.initial_state();
//   while (!run.is_complete(state)) {
//     const StepReport report = run.step(state);
//     ...
//   }

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/iteration_report.h"
#include "solver/fracture/model/state.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace pfdm {

class FractureRun {
 public:
  /// Keeps a reference to the mesh, or a mesh of its own if it is given one away. Throws InputError for inconsistent
  /// input: a missing patch, a body free to move, a region without toughness.
  FractureRun(const Mesh& mesh, FractureModel model, StaggeredSettings staggered, LoadingSettings loading);
  FractureRun(Mesh&& mesh, FractureModel model, StaggeredSettings staggered, LoadingSettings loading);
  ~FractureRun();

  FractureState initial_state() const;
  /// Whether the load has reached its end, or the heat of its cycles repeats; with rises that act on the
  /// body and a long time of heat, when that has gone by.
  bool is_complete(const FractureState& state) const;
  /// Advances the state by one accepted step; increments are cut back until one is accepted. Throws ComputationError,
  /// with the state as it was, when the smallest does not converge. `watch` sees every iteration, also of increments
  /// that are cut, and may throw to give up.
  StepReport step(FractureState& state, const IterationWatch& watch = {});
  /// The report of a state from which a run starts (step 0).
  StepReport report_of(const FractureState& start);

  OutputFields output(const FractureState& state);
  /// Warms the body from the start on by the mean heat of the last whole cycle, in a time of `n` steps [s]. The rises
  /// of the cells at its end go to `rise` [K]. Throws ComputationError without a whole cycle.
  std::vector<HeatRow> warm_by_cycles(const FractureState& state, double time, Index n, CellField<double>& rise);
  const FractureModel& model() const;
  std::vector<std::string> interface_warnings() const;  ///< of cells too large for their laws; of held sides
  Index n_unknowns() const;                             ///< of displacement
  std::map<std::string, double> cpu_seconds_by_stage() const;
  Index krylov_iterations() const;
  Index staggered_iterations() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pfdm
