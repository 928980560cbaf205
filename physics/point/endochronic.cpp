#include "physics/point/endochronic.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr int maximum_iterations = 200;  // bisection alone needs 50 to 60
constexpr double tolerance = 1e-14;

/// (1 - exp(-x)) / x, its derivative, and (1 - phi1) / x.
struct Phi {
  double decay;  // 1 - exp(-x)
  double phi1;
  double phi1_slope;
  double phi2;
};

Phi phi_series(double x) {  // x < 0.02: the next terms are below 1e-16
  Phi phi{.decay = -std::expm1(-x), .phi1 = 0.0, .phi1_slope = 0.0, .phi2 = 0.0};
  double term = 1.0;  // (-x)^k / (k+1)!
  for (int k = 0; k < 8; ++k) {
    phi.phi1 += term;
    phi.phi2 += term / (k + 2);
    phi.phi1_slope -= term * (k + 1) / (k + 2);
    term *= -x / (k + 2);
  }
  return phi;
}

Phi phi(double x) {
  if (x < 0.02) return phi_series(x);
  const double decay = -std::expm1(-x);
  const double phi1 = decay / x;
  return {decay, phi1, (1.0 - decay - phi1) / x, (1.0 - phi1) / x};
}

/// The step's equation h(dzeta) = |A| - (mu + g) dzeta at a trial of dzeta, with what the tangent needs of it:
/// A = mu de + 1/2 sum s_r (1 - exp(-alpha_r dz)), g = sum C_r phi1(alpha_r dz), d eps_p = A / (mu + g).
struct Trial {
  Mandel A;
  Mandel A_z;  // dA/dz
  double norm_A, g, g_z;
  double dz, dz_slope;  // dz_slope: d dz / d dzeta
  double h, h_slope;
};

struct Step {
  const EndochronicLaw& law;
  const EndochronicState& old;
  Mandel de;
  double dt;
};

Trial evaluate(const Step& step, double dzeta) {
  const double mu = step.law.elasticity.mu;
  const double beta = step.law.beta;
  const bool rate_matters = step.law.hardening.depends_on_rate();
  const HardeningValue hardening =
      step.law.hardening(step.old.zeta + beta * dzeta, rate_matters ? dzeta / step.dt : 0.0);
  const double f = hardening.f;
  const double f_slope = beta * hardening.f_zeta + (rate_matters ? hardening.f_rate / step.dt : 0.0);
  Trial t;
  t.dz = dzeta / f;
  t.dz_slope = (f - dzeta * f_slope) / (f * f);
  t.A = mu * step.de;
  t.A_z.setZero();
  t.g = t.g_z = 0.0;
  for (std::size_t r = 0; r < step.law.kernel.size(); ++r) {
    const auto [C, alpha] = step.law.kernel[r];
    const Phi p = phi(alpha * t.dz);
    t.A += (0.5 * p.decay) * step.old.s[r];
    t.A_z += (0.5 * alpha * (1.0 - p.decay)) * step.old.s[r];
    t.g += C * p.phi1;
    t.g_z += C * alpha * p.phi1_slope;
  }
  t.norm_A = t.A.norm();
  t.h = t.norm_A - (mu + t.g) * dzeta;
  t.h_slope = (t.A.dot(t.A_z) / t.norm_A - t.g_z * dzeta) * t.dz_slope - (mu + t.g);
  return t;
}

/// |A| <= mu |de| + 1/2 sum |s_r|, so that h <= 0 there.
double largest_dzeta(const Step& step) {
  double sum = 0.0;
  for (const Mandel& s : step.old.s) sum += s.norm();
  return step.de.norm() + sum / (2.0 * step.law.elasticity.mu);
}

/// The equation of a vanishing step is |mu de + a dzeta| = b dzeta.
struct VanishingStep {
  Mandel a;
  double b;
};

VanishingStep vanishing(const Step& step, double rate) {
  const double f = step.law.hardening(step.old.zeta, rate).f;
  VanishingStep result{.a = Mandel::Zero(), .b = step.law.elasticity.mu};
  for (std::size_t r = 0; r < step.law.kernel.size(); ++r) {
    result.a += (0.5 * step.law.kernel[r].alpha / f) * step.old.s[r];
    result.b += step.law.kernel[r].C;
  }
  return result;
}

/// Whether the plastic strain goes on at constant strain; a law that does not look at the rate never lets it.
bool relaxes(const Step& step) {
  if (!step.law.hardening.depends_on_rate()) return false;
  const auto [a, b] = vanishing(step, 0.0);
  return a.norm() > b;
}

/// The root for a vanishing step, a quadratic equation.
double first_guess(const Step& step, double largest) {
  const double mu = step.law.elasticity.mu;
  const double rate = step.law.hardening.depends_on_rate() ? step.de.norm() / step.dt : 0.0;
  const auto [a, b] = vanishing(step, rate);
  const double along = mu * a.dot(step.de);
  const double load = mu * mu * step.de.squaredNorm();
  const double curvature = b * b - a.squaredNorm();
  if (curvature <= 0.0) return largest;
  const double root = std::sqrt(along * along + curvature * load);
  const double guess = along > 0.0 ? (along + root) / curvature : load / (root - along);
  return std::min(guess, largest);
}

struct Solution {
  Trial trial;
  double dzeta = 0.0;
  int iterations = 0;
  double residual = 0.0;
  bool converged = false;
};

/// Newton's method; a step that leaves the bracket, or does not shorten it fast enough, is replaced by bisection.
Solution solve(const Step& step) {
  double low = 0.0, high = largest_dzeta(step);
  double dzeta = first_guess(step, high);
  double last_h = std::numeric_limits<double>::infinity();
  Solution result;
  while (result.iterations < maximum_iterations) {
    result.trial = evaluate(step, dzeta);
    result.dzeta = dzeta;
    ++result.iterations;
    const Trial& t = result.trial;
    result.residual = std::abs(t.h) / t.norm_A;
    if (!std::isfinite(result.residual)) return result;
    (t.h > 0.0 ? low : high) = dzeta;
    const double newton = dzeta - t.h / t.h_slope;
    if (result.residual <= tolerance || high - low <= 2e-16 * high) break;
    const bool slow = std::abs(t.h) > 0.5 * std::abs(last_h);
    last_h = t.h;
    const bool inside = newton > low && newton < high;
    if (inside && std::abs(newton - dzeta) <= 2e-16 * dzeta) break;
    dzeta = inside && !slow ? newton : 0.5 * (low + high);
  }
  result.converged = result.residual <= 1e-10;
  return result;
}

MandelMatrix tangent_of(const EndochronicLaw& law, const Mandel* A, const Trial& t) {
  const double mu = law.elasticity.mu;
  const double stiffness = mu + t.g;
  MandelMatrix T = (2.0 * mu * (1.0 - mu / stiffness)) * deviatoric_projector() +
                   (3.0 * law.elasticity.bulk_modulus()) * volumetric_projector();
  if (A == nullptr) return T;
  // d eps_p = A / (mu + g): A and g also change with dz, and dz with the root of h. A is deviatoric, and so is dz_de.
  const Mandel dz_de = (-t.dz_slope * mu / (t.norm_A * t.h_slope)) * *A;
  const Mandel change = t.A_z / stiffness - (t.g_z / (stiffness * stiffness)) * *A;
  T -= (2.0 * mu) * change * dz_de.transpose();
  return T;
}

void advance_terms(const EndochronicLaw& law, EndochronicState& state, const Mandel& de_p, double dz) {
  for (std::size_t r = 0; r < law.kernel.size(); ++r) {
    const auto [C, alpha] = law.kernel[r];
    const Phi p = phi(alpha * dz);
    const Mandel before = state.s[r];
    const Mandel mean = p.phi1 * before + (2.0 * C * p.phi2) * de_p;
    state.s[r] = (1.0 - p.decay) * before + (2.0 * C * p.phi1) * de_p;
    // Plastic work less what the term stores; exact for a constant d eps_p / dz.
    state.dissipation += mean.dot(de_p) - (state.s[r] - before).dot(state.s[r] + before) / (4.0 * C);
  }
}

/// Result of a step without deviatoric strain. The tangent is that of virgin material: the true one depends on the
/// direction.
EndochronicUpdate volumetric_step(const Step& step, EndochronicUpdate result) {
  Trial t{};
  for (const KernelTerm& term : step.law.kernel) t.g += term.C;
  result.tangent = tangent_of(step.law, nullptr, t);
  result.stress = stress(step.law, result.state);
  result.converged = true;
  return result;
}

}  // namespace

void check(const EndochronicLaw& law) {
  if (!(law.elasticity.mu > 0.0) || !(law.elasticity.bulk_modulus() > 0.0))
    throw InputError("the endochronic law needs positive elastic moduli");
  if (law.kernel.empty()) throw InputError("the kernel of the endochronic law needs at least one term (C, alpha)");
  for (const auto& [C, alpha] : law.kernel)
    if (!(C > 0.0) || !(alpha >= 0.0) || !std::isfinite(C) || !std::isfinite(alpha))
      throw InputError(fmt::format("a kernel term has C = {}, alpha = {}; C must be positive, alpha zero or positive",
                                   quantity_text(C, "Pa", 6), alpha));
  if (!(law.beta >= 0.0 && law.beta <= 1.0))
    throw InputError(fmt::format("beta = {} must be between 0 and 1 (1/2: second order)", law.beta));
}

EndochronicState virgin_state(const EndochronicLaw& law) {
  EndochronicState state;
  state.s.assign(law.kernel.size(), Mandel::Zero());
  return state;
}

Mandel stress(const EndochronicLaw& law, const EndochronicState& state) {
  Mandel sigma = (law.elasticity.bulk_modulus() * trace(state.strain)) * mandel_identity();
  for (const Mandel& s : state.s) sigma += s;
  return sigma;
}

double kernel_energy(const EndochronicLaw& law, const EndochronicState& state) {
  double psi = 0.0;
  for (std::size_t r = 0; r < state.s.size(); ++r) psi += state.s[r].squaredNorm() / (4.0 * law.kernel[r].C);
  return psi;
}

double free_energy(const EndochronicLaw& law, const EndochronicState& state) {
  const double volume = trace(state.strain);
  return 0.5 * law.elasticity.bulk_modulus() * volume * volume +
         law.elasticity.mu * (deviator(state.strain) - state.plastic_strain).squaredNorm() + kernel_energy(law, state);
}

double invariant_error(const EndochronicLaw& law, const EndochronicState& state) {
  Mandel difference = -2.0 * law.elasticity.mu * (deviator(state.strain) - state.plastic_strain);
  for (const Mandel& s : state.s) difference += s;
  return difference.norm();
}

double saturation_radius(const EndochronicLaw& law, double zeta, double rate) {
  double sum = 0.0;
  for (const auto& [C, alpha] : law.kernel) sum += alpha > 0.0 ? C / alpha : std::numeric_limits<double>::infinity();
  return 2.0 * law.hardening(zeta, rate).f * sum;
}

EndochronicUpdate update(const EndochronicLaw& law, const EndochronicState& state, const Mandel& strain_increment,
                         double dt, AtConstantStrain at_constant_strain) {
  EndochronicUpdate result{.state = state, .stress = {}, .tangent = {}};
  const Step step{law, state, deviator(strain_increment), dt};
  if (!strain_increment.allFinite() || (law.hardening.depends_on_rate() && !(dt > 0.0))) return result;
  result.state.strain += strain_increment;
  const bool may_relax = at_constant_strain == AtConstantStrain::relaxes;
  if (step.de.squaredNorm() == 0.0 && !(may_relax && relaxes(step))) return volumetric_step(step, std::move(result));
  const Solution solution = solve(step);
  const Trial& t = solution.trial;
  result.iterations = solution.iterations;
  result.residual = solution.residual;
  result.converged = solution.converged;
  const Mandel de_p = t.A / (law.elasticity.mu + t.g);
  result.state.plastic_strain += de_p;
  result.state.zeta += solution.dzeta;
  result.state.z += t.dz;
  advance_terms(law, result.state, de_p, t.dz);
  result.stress = stress(law, result.state);
  result.tangent = tangent_of(law, &t.A, t);
  [[maybe_unused]] const auto rounding = [&] {
    return 1e-9 * (result.stress.norm() + law.elasticity.mu * (result.state.strain.norm() + strain_increment.norm()));
  };
  assert(!result.converged || invariant_error(law, result.state) <= rounding());
  return result;
}

StepOfPath step_of_path(const EndochronicLaw& law, const EndochronicState& state, double dzeta, double dt) {
  const Trial t = evaluate({law, state, Mandel::Zero(), dt}, dzeta);
  return {.shift = t.A, .stiffness = law.elasticity.mu + t.g};
}

}  // namespace pfdm
