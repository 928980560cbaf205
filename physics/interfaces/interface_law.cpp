#include "physics/interfaces/interface_law.h"

#include "physics/interfaces/xu_needleman.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

double mean_of(double a, double b) { return 0.5 * (a + b); }

XuNeedleman potential_of(const InterfaceStrength& at) {
  return XuNeedleman::of(at.strength, at.toughness, at.shear_strength, at.shear_toughness);
}

}  // namespace

/// A separation in the terms of the law.
struct InterfaceLaw::Opening {
  double normal;    // delta_n [m]
  Vector n, shear;  // delta_s [m]
  double rho, k;
  Vector measured;  // <delta_n> n + rho delta_s [m], whose product with the separation is lambda^2
  Tensor along;     // n n^T where it is open, k along the face
  Vector pulled;    // along separation [m], which the traction is along
  double lambda;    // [m]
  double B;         // mode mixity

  Opening(const InterfaceLaw& law, const Vector& normal_vector, const Vector& separation)
      : normal(normal_vector.dot(separation)), n(normal_vector), shear(separation - normal * n) {
    const double beta2 = law.shear_ratio * law.shear_ratio;
    rho = law.mixed_mode->keeps_stiffness ? 1.0 / beta2 : beta2;
    k = law.mixed_mode->keeps_stiffness ? 1.0 : beta2;
    measured = weighted(rho) * separation;
    along = weighted(k);
    pulled = along * separation;
    lambda = std::sqrt(measured.dot(separation));
    B = lambda > 0.0 ? std::min(1.0, rho * shear.squaredNorm() / (lambda * lambda)) : 0.0;
  }
  bool is_closed() const { return normal < 0.0; }
  double opened() const { return std::max(0.0, normal); }
  // Of the energy of a separation over that of the law in opening at the same lambda: traction and separation are not
  // those of one potential where rho and k differ.
  double share() const { return 1.0 - B + B * k / rho; }
  Vector share_slope() const { return 2.0 / (lambda * lambda) * (pulled - share() * measured); }
  Vector B_slope() const { return 2.0 / (lambda * lambda) * (rho * shear - B * measured); }

 private:
  Tensor weighted(double in_shear) const {
    Tensor weights = in_shear * (Tensor::Identity() - n * n.transpose());
    if (normal >= 0.0) weights += n * n.transpose();
    return weights;
  }
};

/// T less what contact and friction add, and its derivative in two parts: `secant` separation + what changes it.
struct InterfaceLaw::Pull {
  Tensor secant;         // [Pa/m]
  Tensor secant_change;  // T's derivative less it [Pa/m]
  Vector traction;       // [Pa]
  double shear;          // S_s of T_s = S_s delta_s [Pa/m]
  Vector shear_slope;    // its derivative by the separation
};

/// What a step dissipates [J/m^2], with its derivative by the separation at the step's end [Pa].
struct InterfaceLaw::Loss {
  double energy;
  Vector slope;
};

LawPoint InterfaceLaw::point(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const {
  if (!law->has_rise()) return law->at(*law, lambda, mixture.strength, mixture.toughness, shape);
  double parameters[4] = {mixture.strength * mixture.strength / (2.0 * at.stiffness * mixture.toughness)};
  std::ranges::copy(shape, parameters + 1);
  return law->at(*law, lambda, mixture.strength, mixture.toughness, std::span(parameters, 1 + shape.size()));
}

ModeMixture InterfaceLaw::mixture(const InterfaceStrength& at, double B) const {
  if (depends_on_mode()) return mixed_mode->at(at, B, exponent);
  return {.strength = at.strength, .toughness = at.toughness};
}

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

// Of the secant at constant lambda, by B.
double InterfaceLaw::secant_by_mode(const InterfaceStrength& at, const ModeMixture& m, const LawPoint& p,
                                    double lambda) const {
  const BeyondRise beyond(m, at.stiffness, lambda);
  if (lambda < beyond.rise || p.slope == 0.0) return 0.0;
  const double f_slope = p.slope * beyond.rest / (m.strength * m.strength);
  return (p.traction / m.strength * m.strength_by_B + m.strength * f_slope * beyond.w_by_B) / lambda;
}

// Of the law's work at constant lambda, by B.
double InterfaceLaw::work_by_mode(const InterfaceStrength& at, const ModeMixture& m, double lambda) const {
  const BeyondRise beyond(m, at.stiffness, lambda);
  if (lambda < beyond.rise) return 0.0;
  const LawPoint p = point(at, m, lambda);
  const double done = (p.work - 0.5 * m.strength * beyond.rise) / beyond.rest;  // of the rest
  return beyond.rise * m.strength_by_B + beyond.rest_by_B * done +
         beyond.rest * p.traction / m.strength * beyond.w_by_B;
}

double InterfaceLaw::initial_stiffness(const InterfaceStrength& at) const {
  return point(at, {.strength = at.strength, .toughness = at.toughness}, 0.0).slope;
}

double InterfaceLaw::initial_shear_stiffness(const InterfaceStrength& at) const {
  if (mixed_mode->is_potential) return potential_of(at).shear_secant(0.0, 0.0);
  return (mixed_mode->keeps_stiffness ? 1.0 : shear_ratio * shear_ratio) * initial_stiffness(at);
}

bool InterfaceLaw::pulls_along_separation() const {
  return !mixed_mode->is_potential && (mixed_mode->keeps_stiffness || shear_ratio == 1.0);
}

double InterfaceLaw::steepest_fall(const InterfaceStrength& at) const {
  constexpr int samples = 400;
  constexpr double end = 10.0;  // toughness over strength
  const ModeMixture opening{.strength = at.strength, .toughness = at.toughness};
  double steepest = 0.0;
  for (int i = 1; i <= samples; ++i)
    steepest = std::max(steepest, -point(at, opening, end * i / samples * at.toughness / at.strength).slope);
  return steepest;
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

double InterfaceLaw::secant_after(const InterfaceStrength& at, const InterfaceHistory& history) const {
  const double K = initial_stiffness(at);
  if (depends_on_mode()) return (1.0 - history.reached) * K;
  if (!(history.reached > 0.0)) return K;
  return point(at, mixture(at, 0.0), history.reached).traction / history.reached;
}

double InterfaceLaw::shear_secant_after(const InterfaceStrength& at, const InterfaceHistory& history) const {
  if (mixed_mode->is_potential) return potential_of(at).shear_secant(history.reached, history.reached_in_shear);
  return secant_after(at, history) * initial_shear_stiffness(at) / initial_stiffness(at);
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
  const Opening o(*this, n, separation);
  const double left = mixed_mode->is_potential ? left_in_potential(at, o, history) : left_to_dissipate(at, o, history);
  return history.dissipated / (history.dissipated + left);
}

// Of a rule with one law for all modes, whose lambda grows from `reached`.
InterfaceLaw::Loss InterfaceLaw::lost(const InterfaceStrength& at, const Opening& from, const Opening& to,
                                      double reached, const LawPoint& p, const Vector& secant_slope) const {
  const double share = from.lambda > 0.0 ? mean_of(from.share(), to.share()) : to.share();
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
  return {.energy = mean_of(energy, at_end.energy), .slope = 0.5 * (slope + at_end.slope)};
}

InterfaceLaw::Pull InterfaceLaw::pull(const InterfaceStrength& at, const Opening& o, const InterfaceHistory& before,
                                      InterfaceResponse& response) const {
  const double negligible = 1e-14 * at.toughness / at.strength;  // of a separation
  const double kept = secant_after(at, before);
  double S = kept;
  Vector slope = Vector::Zero();
  if (o.lambda > negligible) {
    const ModeMixture here = mixture(at, o.B);
    const LawPoint p = point(at, here, o.lambda);
    const double now = p.traction / o.lambda;
    if (depends_on_mode() ? now < kept : o.lambda > before.reached) {
      S = now;
      slope = (p.slope - S) / (o.lambda * o.lambda) * o.measured;
      if (depends_on_mode()) slope += secant_by_mode(at, here, p, o.lambda) * o.B_slope();
      // Turned with the body: only the length of the slip counts.
      const Opening from(*this, o.n, before.opening * o.n + before.shear.norm() * o.n.unitOrthogonal());
      const Loss loss =
          depends_on_mode() ? lost_by_mode(at, from, o, kept, p, slope) : lost(at, from, o, before.reached, p, slope);
      response.history.reached = depends_on_mode() ? 1.0 - S / at.stiffness : o.lambda;
      response.history.dissipated += loss.energy;
      response.dissipation_slope = loss.slope;
    }
  }
  return {.secant = S * o.along,
          .secant_change = o.pulled * slope.transpose(),
          .traction = S * o.pulled,
          .shear = o.k * S,
          .shear_slope = o.k * slope};
}

InterfaceLaw::Pull InterfaceLaw::pull_by_potential(const InterfaceStrength& at, const Opening& o,
                                                   const InterfaceHistory& before, InterfaceResponse& response) const {
  const XuNeedleman potential = potential_of(at);
  const double sheared = o.shear.norm();
  const XuNeedlemanStep step{.x_kept = before.reached,
                             .y_kept = before.reached_in_shear,
                             .x_start = std::max(0.0, before.opening) / potential.length_n,
                             .y_start = before.shear.norm() / potential.length_s,
                             .x = o.opened() / potential.length_n,
                             .y = sheared / potential.length_s};
  const double x = step.largest_x(), y = step.largest_y();
  const Vector none = Vector::Zero();
  const Vector x_slope = o.normal > 0.0 ? Vector(o.n / potential.length_n) : none;
  const Vector y_slope = sheared > 0.0 ? Vector(o.shear / (sheared * potential.length_s)) : none;
  const Vector x_grows = step.x > step.x_kept ? x_slope : none, y_grows = step.y > step.y_kept ? y_slope : none;
  const XuNeedlemanLoss loss = pfdm::dissipated(potential, step);
  response.history.reached = x;
  response.history.reached_in_shear = y;
  response.history.dissipated += loss.energy;
  response.dissipation_slope = loss.by_x * x_slope + loss.by_y * y_slope;
  const double S_n = o.is_closed() ? 0.0 : potential.normal_secant(x, y), S_s = potential.shear_secant(x, y);
  const Vector n_slope = potential.normal_secant_by_x(x, y) * x_grows + potential.normal_secant_by_y(x, y) * y_grows;
  const Vector s_slope = potential.shear_secant_by_x(x, y) * x_grows + potential.shear_secant_by_y(x, y) * y_grows;
  const Tensor normal = o.n * o.n.transpose();
  return {.secant = S_n * normal + S_s * (Tensor::Identity() - normal),
          .secant_change = o.opened() * o.n * n_slope.transpose() + o.shear * s_slope.transpose(),
          .traction = S_n * o.opened() * o.n + S_s * o.shear,
          .shear = S_s,
          .shear_slope = s_slope};
}

// Friction on the broken part D = 1 - S_s/K_s of a closed face, or none of it on an open one. Sliding works against the
// mean of the limits at the step's ends, from where the face closes.
void InterfaceLaw::rub(const InterfaceStrength& at, const Opening& o, const InterfaceHistory& before, const Pull& own,
                       InterfaceResponse& response) const {
  const double K = initial_stiffness(at), k = initial_shear_stiffness(at);
  const double D_before = std::clamp(1.0 - shear_secant_after(at, before) / k, 0.0, 1.0);
  const double elastic_before = before.opening < 0.0 ? 0.5 * k * (before.shear - before.slip).squaredNorm() : 0.0;
  if (!o.is_closed()) {
    response.history.slip = o.shear;
    return;
  }
  const Tensor along = Tensor::Identity() - o.n * o.n.transpose();
  const double limit = -friction * K * o.normal, limit_before = std::max(0.0, -friction * K * before.opening);
  const double D = std::clamp(1.0 - own.shear / k, 0.0, 1.0);
  Vector tau = k * (o.shear - before.slip);
  Tensor tangent = k * along;
  const double trial = tau.norm();
  if (trial > limit) {
    const Vector direction = tau / trial;
    tangent =
        limit / trial * k * (along - direction * direction.transpose()) - friction * K * direction * o.n.transpose();
    tau = limit * direction;
    response.history.slip = o.shear - tau / k;
    const double closed = before.opening > 0.0 ? o.normal / (o.normal - before.opening) : 1.0;  // part of the step
    response.history.rubbed += closed * mean_of(D_before * limit_before, D * limit) * (trial - limit) / k;
  }
  const double elastic = 0.5 * tau.squaredNorm() / k;
  response.traction += D * tau;
  response.tangent += D * tangent - tau * own.shear_slope.transpose() / k;
  response.secant += (trial > limit ? limit / trial : 1.0) * D * k * along;
  response.stored += D * elastic;
  response.history.rubbed -= (D - D_before) * mean_of(elastic_before, elastic);
}

InterfaceResponse InterfaceLaw::respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                                        const InterfaceHistory& before) const {
  const Opening o(*this, n, separation);
  InterfaceResponse response{.traction = {}, .tangent = {}, .secant = {}, .history = before};
  response.history.opening = o.normal;
  response.history.shear = o.shear;
  const Pull own =
      mixed_mode->is_potential ? pull_by_potential(at, o, before, response) : pull(at, o, before, response);
  response.traction = own.traction;
  response.secant = own.secant;
  response.tangent = own.secant + own.secant_change;
  response.stored = 0.5 * own.traction.dot(separation);
  if (friction > 0.0) rub(at, o, before, own, response);
  if (!o.is_closed()) return response;
  const double K = initial_stiffness(at);
  const Tensor contact = K * n * n.transpose();
  response.traction += contact * separation;
  response.tangent += contact;
  response.secant += contact;
  response.stored += 0.5 * K * o.normal * o.normal;
  return response;
}

}  // namespace pfdm
