#include "cases/python/extension/stepped_run.h"

#include "physics/error.h"

#include <stdexcept>
#include <utility>

namespace pfdm {

class SteppedRun::Busy {
 public:
  explicit Busy(std::atomic_flag& flag) : flag_(flag) {
    if (flag_.test_and_set(std::memory_order_acquire))
      throw std::runtime_error(
          "this run is computing, for another thread or for the step whose iterations are watched");
  }
  ~Busy() { flag_.clear(std::memory_order_release); }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::atomic_flag& flag_;
};

SteppedRun::SteppedRun(const std::filesystem::path& where, const std::vector<std::string>& values,
                       std::optional<Mesh> mesh)
    : case_(mesh ? std::make_shared<OpenedCase>(where, values, std::move(*mesh))
                 : std::make_shared<OpenedCase>(where, values)) {
  RunState start{.state = case_->run().initial_state(), .report = {}};
  start.report = case_->run().report_of(start.state);
  state_ = std::make_shared<const RunState>(std::move(start));
}

SteppedRun::State SteppedRun::state() const {
  const std::lock_guard lock(guard_);
  return state_;
}

void SteppedRun::publish(State state) {
  {
    const std::lock_guard lock(guard_);
    state_.swap(state);
  }
  fields_.reset();
}

void SteppedRun::step(const IterationWatch& watch) {
  const Busy busy(busy_);
  if (is_complete()) throw InputError("the load has reached its end: there is no further step");
  RunState next{.state = state_->state, .report = {}};
  next.report = case_->run().step(next.state, watch);
  publish(std::make_shared<const RunState>(std::move(next)));
}

void SteppedRun::restore(State state) {
  const Busy busy(busy_);
  const FractureState &now = state_->state, &due = state->state;
  if (now.displacement.size() != due.displacement.size() || now.damage.size() != due.damage.size() ||
      now.interfaces.size() != due.interfaces.size() || now.boundary_force.size() != due.boundary_force.size() ||
      now.histories.first != due.histories.first)
    throw InputError("the state belongs to a run of another mesh or model");
  publish(std::move(state));
}

std::shared_ptr<const OutputFields> SteppedRun::fields() {
  const Busy busy(busy_);
  if (!fields_) fields_ = std::make_shared<const OutputFields>(case_->run().output(state_->state));
  return fields_;
}

CurveRow SteppedRun::row() const {
  const CurveSettings& curve = case_->settings().output.curve;
  return curve_row(state()->report, case_->mesh().patch_index(curve.patch), curve.component);
}

}  // namespace pfdm
