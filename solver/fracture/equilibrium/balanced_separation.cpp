#include "solver/fracture/equilibrium/balanced_separation.h"

#include <Eigen/LU>

#include <utility>

namespace pfdm {

std::optional<Vector> balanced_separation(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& n,
                                          const InterfaceHistory& before, const Tensor& give, const Vector& due,
                                          const Vector& now, double duration, std::optional<double> overstress) {
  constexpr int most_steps = 40;
  const int most_halvings = law.rate.any() && !overstress ? 50 : 12;  // steep at rest
  const double small = 1e-9 * (due.norm() + give.norm() * at.strength);
  const double least = law.rate.any() ? 1e-6 * small : small;  // overstresses have to be as exact
  Vector separation = now;
  InterfaceResponse response = law.respond(at, n, separation, before, duration, overstress);
  Vector miss = due - separation - give * response.traction;
  for (int i = 0; i < most_steps && miss.norm() > least; ++i) {
    Tensor tangent = response.tangent;
    if (overstress) tangent -= response.by_overstress * response.overstress_slope.transpose();
    const Vector step = (Tensor::Identity() + give * tangent).inverse() * miss;
    const bool is_close = miss.norm() <= small;
    bool goes_on = false;
    double share = 1.0;
    for (int halvings = is_close ? most_halvings : 0; halvings <= most_halvings; ++halvings, share *= 0.5) {
      const Vector tried = separation + share * step;
      InterfaceResponse there = law.respond(at, n, tried, before, duration, overstress);
      const Vector left = due - tried - give * there.traction;
      goes_on = left.norm() < (1.0 - 0.1 * share) * miss.norm();
      if (!goes_on && (is_close || halvings < most_halvings)) continue;
      separation = tried, miss = left, response = std::move(there);
      break;
    }
    if (is_close && !goes_on) break;
  }
  if (!(miss.norm() <= small)) return std::nullopt;
  return separation;
}

}  // namespace pfdm
