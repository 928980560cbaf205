#include "physics/interfaces/interface_branches.h"

#include "physics/interfaces/interface_opening.h"
#include "physics/prony_decay.h"

#include <algorithm>

namespace pfdm {

void InterfaceLaw::relax(const InterfaceStrength& at, const Opening& o, const InterfaceHistory& before, const Pull& own,
                         double duration, InterfaceResponse& response) const {
  const double k = initial_shear_stiffness(at);
  const double w = std::clamp(own.shear / k, 0.0, 1.0);
  const double w_before = std::clamp(shear_secant_after(at, before) / k, 0.0, 1.0);
  const Vector w_slope = own.shear_slope / k;
  Tensor along = Tensor::Identity();
  if (o.is_closed()) along -= o.n * o.n.transpose();
  const Vector moved = o.opened() * o.n + o.shear - std::max(0.0, before.opening) * o.n - before.shear;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const auto& [K, tau] = branches[i];
    const PronyDecay by = decay_over(duration / tau);
    const Vector& q_n = before.branch[i];
    const Vector dp = duration > 0.0 ? moved : Vector::Zero();  // else no time passes, and q stays
    const Vector q = by.left * q_n + by.phi * K * dp;
    const double stored = 0.5 * q.squaredNorm() / K, stored_before = 0.5 * q_n.squaredNorm() / K;
    const double dashpot = std::max(0.0, dp.dot(by.phi * q_n + by.second * K * dp) - stored + stored_before);
    response.history.branch[i] = q;
    response.history.viscous +=
        mean_of_ends(w_before, w) * dashpot + (w_before - w) * mean_of_ends(stored_before, stored);
    response.stored += w * stored;
    response.traction += w * q;
    response.tangent += w * by.phi * K * along + q * w_slope.transpose();
    response.secant += w * by.phi * K * along;
  }
}

}  // namespace pfdm
