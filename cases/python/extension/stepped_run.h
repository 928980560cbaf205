#pragma once
// A fracture run that a script steps, and its states. A state never changes once it is there: what a script has seen of
// it stays valid, without copies, and to go back is to name it.

#include "cases/program/fracture/case/opened_case.h"
#include "solver/fracture/fracture_run.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {

/// After a step, or before the first.
struct RunState {
  FractureState state;
  StepReport report;
  std::string laws;  ///< what tells runs with other laws in Python apart
};

class SteppedRun {
 public:
  using State = std::shared_ptr<const RunState>;

  /// Laws in Python that take the place of the case's.
  struct Laws {
    ModelChange change;
    std::string words;
  };

  /// Reads the case, one of kind "fracture" or a box with a path of mean strain, and makes its mesh, or takes the one
  /// that is given. Throws InputError.
  SteppedRun(const std::filesystem::path& where, const std::vector<std::string>& values, std::optional<Mesh> mesh,
             const Laws& laws);

  /// One accepted step; after an exception, of `watch` as well, the run is where it was.
  void step(const IterationWatch& watch);
  /// A state of this run, or of another one of the same size. Throws InputError for others.
  void restore(State state);

  // What is known of the present state may be asked for while another thread steps.
  State state() const;
  bool is_complete() const { return case_->run().is_complete(state()->state); }
  /// The fields of the present state, which are computed when they are first asked for.
  std::shared_ptr<const OutputFields> fields();
  /// Header and line of the present state in force_displacement.csv, of a box in stress_strain.csv.
  std::pair<std::string, std::string> row() const;
  Vector reaction(std::string_view patch) const { return case_->reaction(state()->report, patch); }
  Vector displacement(std::string_view patch) const { return case_->displacement(state()->report, patch); }

  const std::string& title() const { return case_->title(); }
  const std::shared_ptr<const Mesh>& mesh() const { return case_->shared_mesh(); }

 private:
  /// One computation at a time.
  class Busy;
  void publish(State state);

  std::shared_ptr<OpenedCase> case_;
  mutable std::mutex guard_;  // of state_, for as long as the pointer is copied
  State state_;
  std::shared_ptr<const OutputFields> fields_;  // of state_, or none yet: of whoever is busy
  std::atomic_flag busy_ = ATOMIC_FLAG_INIT;
};

}  // namespace pfdm
