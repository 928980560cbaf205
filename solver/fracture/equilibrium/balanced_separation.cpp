#include "solver/fracture/equilibrium/balanced_separation.h"

#include <Eigen/LU>

#include <utility>

namespace pfdm {

std::optional<Vector> balanced_separation(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& n,
                                          const InterfaceHistory& before, const Tensor& give, const Vector& due,
                                          const Vector& now, double duration) {
  constexpr int most_steps = 40;
  const int most_halvings = law.rate.any() ? 50 : 12;  // steep at rest
  const double small = 1e-9 * (due.norm() + give.norm() * at.strength);
  Vector separation = now;
  InterfaceResponse response = law.respond(at, n, separation, before, duration);
  Vector miss = due - separation - give * response.traction;
  for (int i = 0; i < most_steps && miss.norm() > small; ++i) {
    const Vector step = (Tensor::Identity() + give * response.tangent).inverse() * miss;
    double share = 1.0;
    for (int halvings = 0; halvings <= most_halvings; ++halvings, share *= 0.5) {
      const Vector tried = separation + share * step;
      InterfaceResponse there = law.respond(at, n, tried, before, duration);
      const Vector left = due - tried - give * there.traction;
      if (!(left.norm() < (1.0 - 0.1 * share) * miss.norm()) && halvings < most_halvings) continue;
      separation = tried, miss = left, response = std::move(there);
      break;
    }
  }
  if (!(miss.norm() <= small)) return std::nullopt;
  return separation;
}

}  // namespace pfdm
