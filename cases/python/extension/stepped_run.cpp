#include "cases/python/extension/stepped_run.h"

#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/homogenization/debonding_case.h"
#include "cases/program/input/case_files/case_override.h"
#include "physics/error.h"
#include "postproc/curves/curve_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <utility>

namespace pfdm {
namespace {

FractureCase read_case(const std::filesystem::path& where, const std::vector<std::string>& values, MeshOf mesh) {
  const CaseFile file = with_overrides(open_case(where), values);
  const ConfigValue kind = file.config.root().at("kind");
  if (kind.string() != "homogenize") return read_whole_fracture_case(file, mesh);
  if (has_mean_path(file.config.root())) return read_whole_debonding_case(file, mesh);
  throw kind.error(
      "a composite without a path in [homogenization] is linear and has no steps: pfdm.homogenize() gives its "
      "stiffness");
}

}  // namespace

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
                       std::optional<Mesh> mesh, const Laws& laws) {
  FractureCase read = read_case(where, values, mesh ? MeshOf::the_caller : MeshOf::the_case);
  case_ = std::make_shared<OpenedCase>(std::move(read), std::move(mesh), laws.change);
  RunState start{.state = case_->run().initial_state(), .report = {}, .laws = laws.words};
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
  RunState next{.state = state_->state, .report = {}, .laws = state_->laws};
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
  if (state_->laws != state->laws)
    throw InputError("the state belongs to a run with other laws in Python, or with none");
  publish(std::move(state));
}

std::shared_ptr<const OutputFields> SteppedRun::fields() {
  const Busy busy(busy_);
  if (!fields_) fields_ = std::make_shared<const OutputFields>(case_->run().output(state_->state));
  return fields_;
}

std::pair<std::string, std::string> SteppedRun::row() const {
  const State now = state();
  if (case_->settings().box)
    return {fmt::format("{}", fmt::join(columns_of_means(case_->settings().interfaces), ",")),
            fmt::format("{}", fmt::join(row_of_means(now->report), ","))};
  const CurveSettings& curve = case_->settings().output.curve;
  return {curve_header(), curve_line(curve_row(now->report, case_->mesh().patch_index(curve.patch), curve.component))};
}

}  // namespace pfdm
