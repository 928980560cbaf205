#include "solver/fracture/unbalanced_force.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {

std::optional<ForceBalance> other_tolerances(const StepOutcome& outcome, ForceBalance now, const ForceBalance& before) {
  if (outcome.balance.tightening < now.tightening) {
    now.tightening = outcome.balance.tightening;
    now.is_tightest = outcome.balance.is_tightest;
    return now;
  }
  const bool is_in_vain = !outcome.converged && !outcome.broke_too_much && !outcome.collapsed;
  const bool is_smaller = now.tightening < before.tightening;
  if (!is_in_vain || !(is_smaller || (now.tightening < 1.0 && outcome.settled))) return std::nullopt;
  now.tightening = is_smaller ? before.tightening : 1.0;
  now.is_tightest = true;
  return now;
}

std::string UnbalancedForce::remark(const Unknowns& unknowns, std::span<const Vector> on_faces, double load,
                                    double greatest) {
  constexpr double tolerable = 5e-3;
  Vector sum = Vector::Zero();
  for (const Vector& on_face : on_faces) sum += unknowns.is_axisymmetric() ? Vector(0.0, 0.0, on_face.z()) : on_face;
  const double share = greatest > 0.0 ? sum.norm() / greatest : 0.0;
  if (!(share > std::max(tolerable, 2.0 * said_))) return "";
  said_ = share;
  return fmt::format(
      "load {:.4g}: the forces on the body are {:.2g} % out of balance, as where stiff parts that are moved hold soft "
      "ones; forces and stresses err by as much or more. Smaller tolerances were tried: a modulus of the stiff parts "
      "nearer to that of the soft ones helps",
      load, 100.0 * share);
}

}  // namespace pfdm
