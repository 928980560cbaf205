#include "solver/fracture/equilibrium/resisted_separation.h"

#include "solver/fracture/equilibrium/balanced_separation.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>

namespace pfdm {
namespace {

/// Balances of a face at given overstresses.
struct AtOverstress {
  const InterfaceLaw& law;
  const InterfaceStrength& at;
  const Vector& n;
  const InterfaceHistory& before;
  const Tensor& give;
  const Vector& due;
  double duration;
  Vector separation;  // of the last balance, from which the next begins
  bool holds = true;  // all balances were found

  /// How much farther the face opens against the overstress r than at the rate of r [m]: falls as r grows.
  double ahead(double r) {
    const auto found = balanced_separation(law, at, n, before, give, due, separation, duration, r);
    holds = holds && found.has_value();
    if (found) separation = *found;
    return law.growth(n, separation, before) - duration * law.rate.rate_of(r);
  }
};

/// The root r of `ahead` between 0 and an overstress that is too large. Where the law falls more steeply than the cells
/// beside it unload, `ahead` may jump across zero: none then.
std::optional<double> balanced_overstress(AtOverstress& face) {
  constexpr double precision = 1e-15, gap = 1e-9;
  std::uintmax_t most_tries = 100;
  const double at_none = face.ahead(0.0);
  if (!face.holds) return std::nullopt;
  if (!(at_none > 0.0)) return 0.0;
  const double most = face.law.rate.at(at_none / face.duration).value;
  const double at_most = face.ahead(most);
  if (!face.holds) return std::nullopt;
  if (!(at_most < 0.0)) return most;
  const auto [a, b] = boost::math::tools::toms748_solve(
      [&](double r) { return face.ahead(r); }, 0.0, most, at_none, at_most,
      [](double from, double to) { return to - from <= precision * (1.0 + to); }, most_tries);
  const double r = 0.5 * (a + b), left = std::abs(face.ahead(r));
  const bool is_root = left <= gap * (face.due.norm() + face.give.norm() * face.at.strength);
  return face.holds && is_root ? std::optional(r) : std::nullopt;
}

}  // namespace

std::optional<ResistedSeparation> resisted_separation(const InterfaceLaw& law, const InterfaceStrength& at,
                                                      const Vector& n, const InterfaceHistory& before,
                                                      const Tensor& give, const Vector& due, const Vector& now,
                                                      double duration) {
  AtOverstress face{.law = law,
                    .at = at,
                    .n = n,
                    .before = before,
                    .give = give,
                    .due = due,
                    .duration = duration,
                    .separation = now};
  if (const auto r = balanced_overstress(face)) return ResistedSeparation{face.separation, *r};
  const auto separation = balanced_separation(law, at, n, before, give, due, now, duration);
  if (!separation) return std::nullopt;
  return ResistedSeparation{*separation, law.rate.at(law.growth(n, *separation, before) / duration).value};
}

}  // namespace pfdm
