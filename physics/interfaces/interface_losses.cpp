// Energy that interfaces have dissipated and have left to dissipate: member functions of interface_law.h.

#include "physics/interfaces/interface_opening.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

/// Beyond a straight rise of stiffness K: T = sigma f(w), w = (lambda - sigma/K) sigma/rest, rest = Gc - sigma^2/(2K).
struct BeyondRise {
  double rise, rest, rest_by_B, w_by_B;

  BeyondRise(const ModeMixture& m, double K, double lambda)
      : rise(m.strength / K),
        rest(m.toughness - 0.5 * m.strength * rise),
        rest_by_B(m.toughness_by_B - rise * m.strength_by_B) {
    const double opening = lambda - rise;
    w_by_B = ((opening - rise) * m.strength_by_B - opening * m.strength / rest * rest_by_B) / rest;
  }
};

}  // namespace

// Derivative of the secant by the mode mixity B, at constant lambda.
double InterfaceLaw::secant_by_mode(const InterfaceStrength& at, const ModeMixture& m, const LawPoint& p,
                                    double lambda) const {
  const BeyondRise beyond(m, at.stiffness, lambda);
  if (lambda < beyond.rise || p.slope == 0.0) return 0.0;
  const double f_slope = p.slope * beyond.rest / (m.strength * m.strength);
  return (p.traction / m.strength * m.strength_by_B + m.strength * f_slope * beyond.w_by_B) / lambda;
}

// Derivative of the law's work by the mode mixity B, at constant lambda.
double InterfaceLaw::work_by_mode(const InterfaceStrength& at, const ModeMixture& m, double lambda) const {
  const BeyondRise beyond(m, at.stiffness, lambda);
  if (lambda < beyond.rise) return 0.0;
  const LawPoint p = point(at, m, lambda);
  const double done = (p.work - 0.5 * m.strength * beyond.rise) / beyond.rest;  // of the rest
  return beyond.rise * m.strength_by_B + beyond.rest_by_B * done +
         beyond.rest * p.traction / m.strength * beyond.w_by_B;
}

double InterfaceLaw::dissipated(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const {
  const LawPoint p = point(at, mixture, lambda);
  return p.work - 0.5 * p.traction * lambda;
}

// The separation where the law has come down to a secant; infinite for none.
double InterfaceLaw::separation_at_secant(const InterfaceStrength& at, const ModeMixture& mixture,
                                          double secant) const {
  if (!(secant > 0.0)) return std::numeric_limits<double>::infinity();
  double below = 0.0, above = mixture.strength / secant;
  while (above - below > 1e-15 * above) {
    const double middle = 0.5 * (below + above);
    if (middle == below || middle == above) break;
    (point(at, mixture, middle).traction >= secant * middle ? below : above) = middle;
  }
  return below;
}

double InterfaceLaw::left_to_dissipate(const InterfaceStrength& at, const Opening& o,
                                       const InterfaceHistory& history) const {
  const ModeMixture now = mixture(at, o.B);
  if (!depends_on_mode()) return o.share() * std::max(0.0, now.toughness - dissipated(at, now, history.reached));
  const double kept = secant_after(at, history);
  if (!(kept > 0.0)) return 0.0;
  return std::max(0.0, now.toughness - dissipated(at, now, separation_at_secant(at, now, kept)));
}

// Sheared alone, an interface keeps 1 - q of its work of opening.
double InterfaceLaw::left_in_potential(const InterfaceStrength& at, const Opening& o,
                                       const InterfaceHistory& history) const {
  const XuNeedleman potential = potential_of(at);
  const double x = history.reached, y = history.reached_in_shear;
  const bool opens = std::max(x, o.normal / potential.length_n) > 1e-9;
  const double whole = opens ? potential.work : potential.q * potential.work;
  return std::max(0.0, whole - potential.potential(x, y) + potential.stored(x, y));
}

double InterfaceLaw::damage(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                            const InterfaceHistory& history) const {
  if (!(history.dissipated > 0.0)) return 0.0;
  if (own_law) return std::min(1.0, history.dissipated / at.toughness);
  const Opening o(*this, n, separation);
  const double left = mixed_mode->is_potential ? left_in_potential(at, o, history) : left_to_dissipate(at, o, history);
  return history.dissipated / (history.dissipated + left);
}

// Loss by a rule with one law for all modes, whose lambda grows from `reached`.
InterfaceLaw::Loss InterfaceLaw::lost(const InterfaceStrength& at, const Opening& from, const Opening& to,
                                      double reached, const LawPoint& p, const Vector& secant_slope) const {
  const double share = from.lambda > 0.0 ? mean_of_ends(from.share(), to.share()) : to.share();
  const double part = from.lambda > 0.0 ? 0.5 : 1.0;  // of the share that changes with the separation
  const double energy = p.work - 0.5 * p.traction * to.lambda - dissipated(at, mixture(at, 0.0), reached);
  return {.energy = share * energy,
          .slope = -0.5 * share * to.lambda * to.lambda * secant_slope + part * energy * to.share_slope()};
}

// The secant falls from `kept` to that of p; at a secant S a mode mixity B dissipates lambda(S, B)^2/2 per secant.
InterfaceLaw::Loss InterfaceLaw::lost_by_mode(const InterfaceStrength& at, const Opening& from, const Opening& to,
                                              double kept, const LawPoint& p, const Vector& secant_slope) const {
  const ModeMixture here = mixture(at, to.B);
  const double reached = separation_at_secant(at, here, kept);
  const double by_B = work_by_mode(at, here, to.lambda) - work_by_mode(at, here, reached);
  const Loss at_end{.energy = dissipated(at, here, to.lambda) - dissipated(at, here, reached),
                    .slope = -0.5 * to.lambda * to.lambda * secant_slope + by_B * to.B_slope()};
  if (!(from.lambda > 0.0)) return at_end;
  const ModeMixture there = mixture(at, from.B);
  const double lambda = separation_at_secant(at, there, p.traction / to.lambda);
  const double whole = std::isfinite(lambda) ? dissipated(at, there, lambda) : there.toughness;
  const double energy = whole - dissipated(at, there, separation_at_secant(at, there, kept));
  const Vector slope = std::isfinite(lambda) ? (-0.5 * lambda * lambda * secant_slope).eval() : Vector::Zero().eval();
  return {.energy = mean_of_ends(energy, at_end.energy), .slope = 0.5 * (slope + at_end.slope)};
}

double InterfaceLaw::stored_after(const InterfaceStrength& at, const InterfaceHistory& history) const {
  const double opened = std::max(0.0, history.opening);
  const double S_n = mixed_mode->is_potential
                         ? potential_of(at).normal_secant(history.reached, history.reached_in_shear)
                         : secant_after(at, history);
  return 0.5 * (S_n * opened * opened + shear_secant_after(at, history) * history.shear.squaredNorm());
}

// Adds the resistance by rate to a response without rate, contact and friction.
void InterfaceLaw::resist(const InterfaceStrength& at, const Opening& o, const InterfaceHistory& before,
                          double duration, std::optional<double> overstress, InterfaceResponse& response) const {
  const double growth = o.lambda - Opening::of(*this, o.n, before).lambda;
  const double v = duration > 0.0 ? (overstress ? rate.rate_of(*overstress) : growth / duration) : 0.0;
  Overstress r = duration > 0.0 ? rate.at(v) : Overstress{before.overstress, 0.0};
  if (duration > 0.0 && overstress) r.value = *overstress;
  const double taken_up =
      response.stored - stored_after(at, before) + response.history.dissipated - before.dissipated;  // [J/m^2]
  if (growth > 0.0) response.history.viscous += mean_of_ends(before.overstress, r.value) * taken_up;
  response.history.overstress = r.value;
  response.tangent *= 1.0 + r.value;
  response.by_overstress = response.traction;
  if (r.slope > 0.0 && o.lambda > 0.0) response.overstress_slope = r.slope / (duration * o.lambda) * o.measured;
  response.tangent += response.by_overstress * response.overstress_slope.transpose();
  response.traction *= 1.0 + r.value;
  response.secant *= 1.0 + r.value;
}

}  // namespace pfdm
