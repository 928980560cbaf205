#pragma once
// A fracture run that a script steps, and its states. A state never changes once it is there: what a script has seen of
// it stays valid, without copies, and to go back is to name it.

#include "cases/program/fracture/case/opened_case.h"
#include "postproc/curves/curve_csv.h"
#include "solver/fracture/fracture_run.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// After a step, or before the first.
struct RunState {
  FractureState state;
  StepReport report;
};

class SteppedRun {
 public:
  using State = std::shared_ptr<const RunState>;

  /// Reads the case and makes its mesh, or takes the one that is given. Throws InputError.
  SteppedRun(const std::filesystem::path& where, const std::vector<std::string>& values, std::optional<Mesh> mesh);

  /// One accepted step; after an exception, of `watch` as well, the run is where it was.
  void step(const IterationWatch& watch);
  /// A state of this run, or of another one of the same size. Throws InputError for others.
  void restore(State state);

  const State& state() const { return state_; }
  bool is_complete() const { return case_->run().is_complete(state_->state); }
  /// The fields of the present state, which are computed when they are first asked for.
  std::shared_ptr<const OutputFields> fields();
  CurveRow row() const;
  Vector reaction(std::string_view patch) const { return case_->reaction(state_->report, patch); }
  Vector displacement(std::string_view patch) const { return case_->displacement(state_->report, patch); }

  const std::string& title() const { return case_->title(); }
  const std::shared_ptr<OpenedCase>& opened() const { return case_; }

 private:
  /// One computation at a time.
  class Busy;

  std::shared_ptr<OpenedCase> case_;
  State state_;
  std::shared_ptr<const OutputFields> fields_;  // of state_, or none yet
  std::atomic_flag busy_ = ATOMIC_FLAG_INIT;
};

}  // namespace pfdm
