#include "physics/interface_law.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

ModeMixture benzeggagh_kenane(const InterfaceStrength& s, double B, double eta) {
  const double part = std::pow(B, eta), slope = eta * std::pow(B, eta - 1.0);
  const double more = s.shear_strength * s.shear_strength - s.strength * s.strength;
  const double strength = std::sqrt(s.strength * s.strength + more * part);
  return {.strength = strength,
          .toughness = s.toughness + (s.shear_toughness - s.toughness) * part,
          .strength_by_B = 0.5 * more * slope / strength,
          .toughness_by_B = (s.shear_toughness - s.toughness) * slope};
}

ModeMixture power_law(const InterfaceStrength& s, double B, double eta) {
  const double opening = (1.0 - B) / s.toughness, shear = B / s.shear_toughness;
  const double toughness = std::pow(std::pow(opening, eta) + std::pow(shear, eta), -1.0 / eta);
  const double slope = std::pow(shear, eta - 1.0) / s.shear_toughness - std::pow(opening, eta - 1.0) / s.toughness;
  const double n = 1.0 / (s.strength * s.strength), t = 1.0 / (s.shear_strength * s.shear_strength);
  const double strength = 1.0 / std::sqrt((1.0 - B) * n + B * t);
  return {.strength = strength,
          .toughness = toughness,
          .strength_by_B = -0.5 * strength * strength * strength * (t - n),
          .toughness_by_B = -std::pow(toughness, 1.0 + eta) * slope};
}

constexpr MixedMode modes[] = {
    {"camacho_ortiz", "equivalent separation; shear_ratio beta: shear strength over strength, one toughness", nullptr},
    {"benzeggagh_kenane", "Gc = G_n + (G_s - G_n) B^exponent; shear_strength, shear_toughness, exponent",
     benzeggagh_kenane},
    {"power_law", "((1-B)/G_n)^exponent + (B/G_s)^exponent = Gc^-exponent; the same keys", power_law},
};

}  // namespace

std::span<const MixedMode> mixed_modes() { return modes; }

/// A separation in the terms of the law.
struct InterfaceLaw::Opening {
  Vector n;
  double normal;  // delta_n [m]
  Vector shear;   // delta_s [m]
  Tensor along;   // of separations into those that the law works on, rho along the face
  Vector worked;  // <delta_n> n + rho delta_s [m]
  double lambda;  // [m]
  double B;       // mode mixity
  double rho;

  Opening(const Vector& normal_vector, const Vector& separation, double shear_ratio)
      : n(normal_vector), normal(n.dot(separation)), shear(separation - normal * n), rho(shear_ratio * shear_ratio) {
    along = rho * (Tensor::Identity() - n * n.transpose());
    if (normal >= 0.0) along += n * n.transpose();
    worked = along * separation;
    lambda = std::sqrt(worked.dot(separation));
    B = lambda > 0.0 ? std::min(1.0, rho * shear.squaredNorm() / (lambda * lambda)) : 0.0;
  }
  bool is_closed() const { return normal < 0.0; }
  Vector B_by_separation() const { return 2.0 / (lambda * lambda) * (rho * shear - B * worked); }
};

LawPoint InterfaceLaw::point(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const {
  if (!law->has_rise()) return law->at(*law, lambda, mixture.strength, mixture.toughness, shape);
  double parameters[4] = {mixture.strength * mixture.strength / (2.0 * at.stiffness * mixture.toughness)};
  std::ranges::copy(shape, parameters + 1);
  return law->at(*law, lambda, mixture.strength, mixture.toughness, std::span(parameters, 1 + shape.size()));
}

// dS/dB. Beyond the rise T = sigma f(w), w = (lambda - sigma/K) sigma/Gs, Gs = Gc - sigma^2/(2K).
double InterfaceLaw::secant_by_mode(const InterfaceStrength& at, const ModeMixture& m, const LawPoint& p,
                                    double lambda) const {
  const double rise = m.strength / at.stiffness;
  if (lambda < rise || p.slope == 0.0) return 0.0;
  const double rest = m.toughness - 0.5 * m.strength * rise;
  const double f_slope = p.slope * rest / (m.strength * m.strength), opening = lambda - rise;
  const double w_by_strength = (opening - rise) / rest + opening * m.strength * rise / (rest * rest);
  const double w_by_toughness = -opening * m.strength / (rest * rest);
  const double by_strength = p.traction / m.strength + m.strength * f_slope * w_by_strength;
  const double by_toughness = m.strength * f_slope * w_by_toughness;
  return (by_strength * m.strength_by_B + by_toughness * m.toughness_by_B) / lambda;
}

double InterfaceLaw::initial_stiffness(const InterfaceStrength& at) const {
  return point(at, {.strength = at.strength, .toughness = at.toughness}, 0.0).slope;
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

// The separation where the law has come down to a secant, between zero and one where it is lower.
double InterfaceLaw::separation_at_secant(const InterfaceStrength& at, const ModeMixture& mixture, double secant,
                                          double above) const {
  double below = 0.0;
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
  return point(at, {.strength = at.strength, .toughness = at.toughness}, history.reached).traction / history.reached;
}

double InterfaceLaw::left_to_dissipate(const InterfaceStrength& at, double B, const InterfaceHistory& history) const {
  const double kept = secant_after(at, history);
  if (!(kept > 0.0)) return 0.0;
  const ModeMixture mixture = mixed_mode->at(at, B, exponent);
  const double reached = separation_at_secant(at, mixture, kept, mixture.strength / kept);
  return std::max(0.0, mixture.toughness - dissipated(at, mixture, reached));
}

double InterfaceLaw::damage(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                            const InterfaceHistory& history) const {
  if (!(history.dissipated > 0.0)) return 0.0;
  if (!depends_on_mode()) return std::min(history.dissipated / at.toughness, 1.0);
  const double left = left_to_dissipate(at, Opening(n, separation, shear_ratio).B, history);
  return history.dissipated / (history.dissipated + left);
}

// The law's own part: traction, tangent and history by decohesion; dS/d separation.
void InterfaceLaw::pull(const InterfaceStrength& at, const Opening& o, const InterfaceHistory& before,
                        InterfaceResponse& response, Vector& secant_by_separation) const {
  const double negligible = 1e-14 * at.toughness / at.strength;  // of a separation
  const ModeMixture mixture = depends_on_mode() ? mixed_mode->at(at, o.B, exponent)
                                                : ModeMixture{.strength = at.strength, .toughness = at.toughness};
  const double kept = secant_after(at, before);
  secant_by_separation = Vector::Zero();
  double S = kept;
  if (o.lambda > negligible) {
    const LawPoint p = point(at, mixture, o.lambda);
    const double now = p.traction / o.lambda;
    if (depends_on_mode() ? now < kept : o.lambda > before.reached) {
      S = now;
      secant_by_separation = (p.slope - S) / (o.lambda * o.lambda) * o.worked;
      if (depends_on_mode()) secant_by_separation += secant_by_mode(at, mixture, p, o.lambda) * o.B_by_separation();
      const double from = depends_on_mode() ? separation_at_secant(at, mixture, kept, o.lambda) : before.reached;
      response.history.reached = depends_on_mode() ? 1.0 - S / at.stiffness : o.lambda;
      response.history.dissipated += dissipated(at, mixture, o.lambda) - dissipated(at, mixture, from);
    }
  }
  response.traction = S * o.worked;
  response.secant = S * o.along;
  response.tangent = response.secant + o.worked * secant_by_separation.transpose();
  response.stored = 0.5 * S * o.lambda * o.lambda;
  response.dissipation_slope = -0.5 * o.lambda * o.lambda * secant_by_separation;
}

// Friction on the broken part D = 1 - S/K of a closed face, or none of it on an open one.
void InterfaceLaw::rub(double K, const Opening& o, const InterfaceHistory& before, double secant_before,
                       const Vector& secant_by_separation, InterfaceResponse& response) const {
  if (!o.is_closed()) {
    response.history.slip = o.shear;
    return;
  }
  const Tensor along = Tensor::Identity() - o.n * o.n.transpose();
  const double k = o.rho * K, limit = -friction * K * o.normal;
  const double D = std::clamp(1.0 - response.secant.trace() / (2.0 * o.rho) / K, 0.0, 1.0);
  const double D_before = std::clamp(1.0 - secant_before / K, 0.0, 1.0);
  Vector tau = k * (o.shear - before.slip);
  Tensor tangent = k * along;
  const double trial = tau.norm();
  if (trial > limit) {
    const Vector direction = tau / trial;
    tangent =
        limit / trial * k * (along - direction * direction.transpose()) - friction * K * direction * o.n.transpose();
    tau = limit * direction;
    response.history.slip = o.shear - tau / k;
  }
  const double elastic = 0.5 * tau.squaredNorm() / k;
  response.traction += D * tau;
  response.tangent += D * tangent - tau * secant_by_separation.transpose() / K;
  response.secant += (trial > limit ? limit / trial : 1.0) * D * k * along;
  response.stored += D * elastic;
  response.history.rubbed += D * tau.dot(response.history.slip - before.slip) - (D - D_before) * elastic;
}

InterfaceResponse InterfaceLaw::respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                                        const InterfaceHistory& before) const {
  const Opening opening(n, separation, shear_ratio);
  InterfaceResponse response{.traction = {}, .tangent = {}, .secant = {}, .history = before};
  Vector secant_by_separation;
  pull(at, opening, before, response, secant_by_separation);
  const double K = initial_stiffness(at);
  if (friction > 0.0) rub(K, opening, before, secant_after(at, before), secant_by_separation, response);
  if (!opening.is_closed()) return response;
  const Tensor contact = K * n * n.transpose();
  response.traction += contact * separation;
  response.tangent += contact;
  response.secant += contact;
  response.stored += 0.5 * K * opening.normal * opening.normal;
  return response;
}

}  // namespace pfdm
