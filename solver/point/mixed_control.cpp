#include "solver/point/mixed_control.h"

#include "physics/quantity_text.h"
#include "solver/point/rest_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

using Conditions = std::array<ControlCondition, 6>;

/// The six conditions as matrices, each divided by the size that it has per unit of strain.
struct Rows {
  MandelMatrix on_stress, on_strain;
  Mandel scale;
};

Rows rows_of(const EndochronicLaw& law, const Conditions& conditions) {
  Rows rows;
  for (int k = 0; k < n_components; ++k) {
    const ControlCondition& condition = conditions[k];
    rows.scale[k] = 2.0 * law.elasticity.mu * condition.on_stress.norm() + condition.on_strain.norm();
    rows.on_stress.row(k) = condition.on_stress.transpose() / rows.scale[k];
    rows.on_strain.row(k) = condition.on_strain.transpose() / rows.scale[k];
  }
  return rows;
}

double value_of(const ControlCondition& condition, const Mandel& stress, const Mandel& strain) {
  return condition.on_stress.dot(stress) + condition.on_strain.dot(strain);
}

/// Newton's method for the strain increment of one step, with backtracking.
class StepSolver {
 public:
  StepSolver(const EndochronicLaw& law, const EndochronicState& state, const Conditions& conditions,
             const Mandel& change, double dt)
      : law_(law), state_(state), dt_(dt), rows_(rows_of(law, conditions)), sigma_0_(stress(law, state)) {
    change_ = change.cwiseQuotient(rows_.scale);
    rounding_ = 4e-16 * (state.strain.norm() + sigma_0_.norm() / law.elasticity.mu);
  }

  ControlledStep solve(const ControlSettings& settings, const Mandel& guess) {
    begin(guess);
    for (int i = 1; i <= settings.maximum_iterations && now_.converged; ++i) {
      const Mandel direction = newton_direction();
      if (!direction.allFinite() || !search(direction)) break;
      if (error() <= settings.tolerance * increment_.norm() + rounding_) return {now_, i, true};
    }
    return {now_, settings.maximum_iterations, false};
  }

 private:
  void begin(const Mandel& guess) {
    const RestFlow flow = flowing_increment(law_, state_, {rows_.on_stress, rows_.on_strain, change_}, dt_);
    if (flow.increment) take(*flow.increment);
    if (flow.goes_on) return;  // from no motion Newton's method would find that there is none
    if (!guess.isZero()) {
      take(guess);
      if (now_.converged && error() < 0.3 * change_.lpNorm<Eigen::Infinity>()) return;
    }
    take(Mandel::Zero());
  }

  void take(const Mandel& increment) {
    increment_ = increment;
    now_ = update(law_, state_, increment, dt_, AtConstantStrain::relaxes);
    F_ = rows_.on_stress * (now_.stress - sigma_0_) + rows_.on_strain * increment - change_;
  }

  double error() const { return F_.lpNorm<Eigen::Infinity>(); }

  Mandel newton_direction() const {
    const MandelMatrix J = rows_.on_stress * now_.tangent + rows_.on_strain;
    return -J.partialPivLu().solve(F_);
  }

  /// Takes the longest of the steps 1, 1/2, 1/4 ... that reduces the error.
  bool search(const Mandel& direction) {
    const Mandel start = increment_;
    const double before = error();
    for (double length = 1.0; length > 1e-3; length *= 0.5) {
      take(start + length * direction);
      if (!now_.converged || error() > std::max((1.0 - 1e-4 * length) * before, rounding_)) continue;
      if (length == 1.0 && error() > 0.05 * before) stretch(start, direction);
      return true;
    }
    return false;
  }

  /// Slow convergence is a sign of steps that are too short, as where the direction of the plastic strain changes.
  void stretch(const Mandel& start, const Mandel& direction) {
    const double single = error();
    take(start + 1.5 * direction);
    if (!now_.converged || error() >= single) take(start + direction);
  }

  const EndochronicLaw& law_;
  const EndochronicState& state_;
  double dt_;
  Rows rows_;
  Mandel sigma_0_, change_;
  double rounding_ = 0.0;
  Mandel increment_, F_;
  EndochronicUpdate now_;
};

/// Walks through a segment.
class SegmentRunner {
 public:
  SegmentRunner(const EndochronicLaw& law, const LoadSegment& segment, HistoryPoint start,
                const ControlSettings& settings)
      : law_(law), segment_(segment), settings_(settings), start_time_(start.time), point_(std::move(start)) {
    for (std::size_t k = 0; k < 6; ++k) {
      conditions_[k] = segment.conditions[k].condition;
      begin_[k] = value_of(conditions_[k], point_.stress, point_.state.strain);
    }
  }

  /// Increment i, in one step or, where need be, in several; false if it does not converge.
  bool advance(std::size_t i) {
    point_.iterations = point_.substeps = 0;
    const double least = std::ldexp(1.0, -settings_.maximum_halvings);
    const double longest = first_part(i);
    double done = 0.0, part = longest;
    while (done < 1.0) {
      part = std::min(part, 1.0 - done);
      if (take(i, done, part)) {
        done = 1.0 - done - part < 1e-9 ? 1.0 : done + part;
        part = std::min(2.0 * part, longest);
        if (is_lost()) return false;
      } else if ((part *= 0.5) < least) {
        return false;
      }
    }
    point_.time = start_time_ + segment_.times[i + 1];
    return true;
  }

  const HistoryPoint& point() const { return point_; }

  /// Why increment i cannot be solved.
  std::string failure(std::size_t i) const {
    const double radius = saturation_radius(law_, point_.state.zeta, last_rate_);
    const double now = deviator(point_.stress).norm();
    const std::string where = fmt::format("t = {:.6g} s", start_time_ + segment_.times[i + 1]);
    const bool stress_prescribed =
        std::ranges::any_of(conditions_, [](const auto& c) { return !c.on_stress.isZero(); });
    const bool flows = law_.hardening.depends_on_rate() && is_lost();  // where the surface grows with the rate
    if (!flows && stress_prescribed && now > 0.97 * radius)
      return fmt::format(
          "{}: the prescribed stress lies beyond the saturation surface: the deviatoric stress has reached {} of the "
          "{} (2 f sum C/alpha) that the material can sustain; prescribe less stress, or a strain instead",
          where, quantity_text(now, "Pa", 6), quantity_text(radius, "Pa", 6));
    if (is_lost())
      return fmt::format(
          "{}: the strain has reached {:.3g}: the law cannot bear the prescribed stress; the deviatoric stress is {}, "
          "and saturates at {} at this zeta and rate; prescribe less stress, or a strain instead",
          where, point_.state.strain.norm(), quantity_text(now, "Pa", 6), quantity_text(radius, "Pa", 6));
    return fmt::format(
        "{}: Newton's method does not converge, not even in steps of 1/{:.0f} of the increment; the deviatoric stress "
        "is {}, and saturates at {} at this zeta and rate",
        where, std::ldexp(1.0, settings_.maximum_halvings), quantity_text(now, "Pa", 6),
        quantity_text(radius, "Pa", 6));
  }

 private:
  /// Value of condition k at the fraction w of increment i.
  double target(std::size_t k, std::size_t i, double w) const {
    const LoadSegment::Condition& c = segment_.conditions[k];
    const auto& t = segment_.times;
    if (c.pace == Pace::ramp) {
      const double passed = ((1.0 - w) * t[i] + w * t[i + 1] - t.front()) / (t.back() - t.front());
      return begin_[k] + passed * (c.values.back() - begin_[k]);
    }
    const double value = (1.0 - w) * c.values[i] + w * c.values[i + 1];
    return c.pace == Pace::follow ? value : begin_[k] + value - c.values.front();
  }

  /// Whether the strain has left those that are prescribed by more than 1.
  bool is_lost() const {
    double prescribed = 0.0;
    for (const auto& c : segment_.conditions)
      if (c.condition.on_stress.isZero())
        for (const double value : c.values) prescribed = std::max(prescribed, std::abs(value));
    return point_.state.strain.norm() > 1.0 + 3.0 * prescribed;
  }

  double first_part(std::size_t i) const {
    double largest = 0.0;
    for (std::size_t k = 0; k < 6; ++k)
      if (conditions_[k].on_stress.isZero())
        largest = std::max(largest, std::abs(target(k, i, 1.0) - target(k, i, 0.0)));
    return 1.0 / (settings_.substeps * std::max(1.0, std::ceil(largest / settings_.largest_increment)));
  }

  bool take(std::size_t i, double done, double part) {
    Mandel change;
    for (std::size_t k = 0; k < 6; ++k)
      change[k] = target(k, i, done + part) - value_of(conditions_[k], point_.stress, point_.state.strain);
    const double dt = part * (segment_.times[i + 1] - segment_.times[i]);
    ControlledStep step =
        controlled_step(law_, point_.state, conditions_, change, dt, settings_, dt * last_strain_rate_);
    point_.iterations += step.iterations;
    if (!step.converged) return false;
    last_rate_ = (step.update.state.zeta - point_.state.zeta) / dt;
    last_strain_rate_ = (step.update.state.strain - point_.state.strain) / dt;
    point_.state = std::move(step.update.state);
    point_.stress = step.update.stress;
    ++point_.substeps;
    return true;
  }

  const EndochronicLaw& law_;
  const LoadSegment& segment_;
  const ControlSettings& settings_;
  double start_time_;
  HistoryPoint point_;
  Conditions conditions_;
  std::array<double, 6> begin_{};
  double last_rate_ = 0.0;  ///< of zeta [1/s]
  Mandel last_strain_rate_ = Mandel::Zero();
};

}  // namespace

ControlledStep controlled_step(const EndochronicLaw& law, const EndochronicState& state, const Conditions& conditions,
                               const Mandel& change, double dt, const ControlSettings& settings, const Mandel& guess) {
  return StepSolver(law, state, conditions, change, dt).solve(settings, guess);
}

std::optional<std::string> dependent_conditions(const EndochronicLaw& law, const Conditions& conditions) {
  for (std::size_t k = 0; k < 6; ++k)
    if (conditions[k].on_stress.isZero() && conditions[k].on_strain.isZero())
      return fmt::format("condition {} contains neither stress nor strain", k + 1);
  const Rows rows = rows_of(law, conditions);
  const MandelMatrix T = update(law, virgin_state(law), Mandel::Zero(), 1.0).tangent;
  const Eigen::FullPivLU<MandelMatrix> lu(rows.on_stress * T + rows.on_strain);
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  if (pivots.minCoeff() > 1e-10 * pivots.maxCoeff()) return std::nullopt;
  return fmt::format("the six conditions are not independent (rank {} of 6): some repeat or contradict each other",
                     (pivots.array() > 1e-10 * pivots.maxCoeff()).count());
}

HistoryResult run_history(const EndochronicLaw& law, const std::vector<LoadSegment>& segments,
                          const ControlSettings& settings, const std::function<void(const HistoryPoint&)>& seen) {
  HistoryResult result;
  result.points.push_back({.state = virgin_state(law)});
  for (const LoadSegment& segment : segments) {
    SegmentRunner runner(law, segment, result.points.back(), settings);
    for (std::size_t i = 0; i + 1 < segment.times.size(); ++i) {
      if (!runner.advance(i)) {
        result.converged = false;
        result.failure = runner.failure(i);
        return result;
      }
      result.points.push_back(runner.point());
      if (seen) seen(result.points.back());
    }
  }
  return result;
}

}  // namespace pfdm
