#include "solver/point/rest_flow.h"

#include <cmath>

namespace pfdm {
namespace {

// Plastic paths that are looked at: first from `usual` to the shortest, then to the longest.
constexpr double usual = 0.1, shortest = 1e-12, longest = 10.0;

class FlowEquation {
 public:
  FlowEquation(const EndochronicLaw& law, const EndochronicState& state, const StepConditions& conditions, double dt)
      : law_(law), state_(state), conditions_(conditions), dt_(dt) {}

  /// The strain increment with which the path grows by dzeta, `moved` times the change of the conditions.
  Mandel increment(const StepOfPath& path, double moved) const {
    const double mu = law_.elasticity.mu, part = mu / path.stiffness;
    const MandelMatrix tangent = (2.0 * mu * (1.0 - part)) * deviatoric_projector() +
                                 (3.0 * law_.elasticity.bulk_modulus()) * volumetric_projector();
    const MandelMatrix J = conditions_.on_stress * tangent + conditions_.on_strain;
    return J.partialPivLu().solve(moved * conditions_.change + conditions_.on_stress * (2.0 * part * path.shift));
  }

  /// |A| less what the path needs: positive where the plastic strain would grow by more than dzeta [Pa].
  double excess(double dzeta, double moved) const {
    const StepOfPath path = step_of_path(law_, state_, dzeta, dt_);
    const Mandel A = law_.elasticity.mu * deviator(increment(path, moved)) + path.shift;
    return A.norm() - path.stiffness * dzeta;
  }

  Mandel increment(double dzeta) const { return increment(step_of_path(law_, state_, dzeta, dt_), 1.0); }

 private:
  const EndochronicLaw& law_;
  const EndochronicState& state_;
  const StepConditions& conditions_;
  double dt_;
};

/// A path between whose half and itself the excess changes its sign from above to below zero, or the shortest.
std::optional<double> upper_end(const FlowEquation& equation) {
  const auto is_below = [&](double dzeta) { return equation.excess(dzeta, 1.0) < 0.0; };
  double high = usual;
  while (high > shortest && !is_below(high)) high *= 0.5;
  if (high <= shortest) {
    high = usual;
    while (high < longest && !is_below(high)) high *= 2.0;
    return high < longest ? std::optional(high) : std::nullopt;
  }
  while (high > shortest && is_below(0.5 * high)) high *= 0.5;
  return high;
}

}  // namespace

RestFlow flowing_increment(const EndochronicLaw& law, const EndochronicState& state, const StepConditions& conditions,
                           double dt) {
  if (!law.hardening.depends_on_rate() || !(dt > 0.0)) return {};
  const FlowEquation equation(law, state, conditions, dt);
  if (!(equation.excess(shortest, 0.0) > 0.0)) return {};
  const auto end = upper_end(equation);
  if (!end) return {.goes_on = true, .increment = std::nullopt};
  double low = 0.5 * *end, high = *end;
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (equation.excess(middle, 1.0) > 0.0 ? low : high) = middle;
  }
  return {.goes_on = true, .increment = equation.increment(std::sqrt(low * high))};
}

}  // namespace pfdm
