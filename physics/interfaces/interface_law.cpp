#include "physics/interfaces/interface_law.h"

#include "physics/interfaces/interface_opening.h"

#include <algorithm>

namespace pfdm {

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

bool InterfaceLaw::is_all_rise(const InterfaceStrength& at) const {
  const auto too_soft = [&](double strength, double toughness) {
    return strength * strength >= 2.0 * at.stiffness * toughness;
  };
  return !own_law && law->has_rise() &&
         (too_soft(at.strength, at.toughness) ||
          (depends_on_mode() && too_soft(at.shear_strength, at.shear_toughness)));
}

double InterfaceLaw::initial_stiffness(const InterfaceStrength& at) const {
  return point(at, {.strength = at.strength, .toughness = at.toughness}, 0.0).slope;
}

double InterfaceLaw::initial_shear_stiffness(const InterfaceStrength& at) const {
  if (mixed_mode->is_potential) return potential_of(at).shear_secant(0.0, 0.0);
  return (mixed_mode->keeps_stiffness ? 1.0 : shear_ratio * shear_ratio) * initial_stiffness(at);
}

bool InterfaceLaw::pulls_along_separation() const {
  if (own_law) return true;  // it has to, where that is required
  return !mixed_mode->is_potential && (mixed_mode->keeps_stiffness || shear_ratio == 1.0);
}

double InterfaceLaw::steepest_fall(const InterfaceStrength& at) const {
  constexpr int samples = 400;
  constexpr double end = 10.0;  // toughness over strength
  const ModeMixture opening{.strength = at.strength, .toughness = at.toughness};
  const auto slope = [&](double x) {
    return own_law ? own_law->respond(at, Vector::UnitX(), x * Vector::UnitX(), {}, 0.0).tangent(0, 0)
                   : point(at, opening, x).slope;
  };
  double steepest = 0.0;
  for (int i = 1; i <= samples; ++i)
    steepest = std::max(steepest, -slope(end * i / samples * at.toughness / at.strength));
  return steepest;
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
      const Opening from = Opening::of(*this, o.n, before);
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
    response.history.rubbed += closed * mean_of_ends(D_before * limit_before, D * limit) * (trial - limit) / k;
  }
  const double elastic = 0.5 * tau.squaredNorm() / k;
  response.traction += D * tau;
  response.tangent += D * tangent - tau * own.shear_slope.transpose() / k;
  response.secant += (trial > limit ? limit / trial : 1.0) * D * k * along;
  response.stored += D * elastic;
  response.history.rubbed -= (D - D_before) * mean_of_ends(elastic_before, elastic);
}

double InterfaceLaw::growth(const Vector& n, const Vector& separation, const InterfaceHistory& before) const {
  return Opening(*this, n, separation).lambda - Opening::of(*this, n, before).lambda;
}

InterfaceResponse InterfaceLaw::respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                                        const InterfaceHistory& before, double duration,
                                        std::optional<double> overstress) const {
  if (own_law) return own_law->respond(at, n, separation, before, duration);
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
  if (rate.any()) resist(at, o, before, duration, overstress, response);
  if (!branches.empty()) relax(at, o, before, own, duration, response);
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
