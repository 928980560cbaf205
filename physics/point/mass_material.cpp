#include "physics/point/mass_material.h"

#include "physics/registry.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr auto none = KernelForcing::none;
constexpr auto displacement = KernelForcing::displacement;
constexpr auto velocity_ = KernelForcing::velocity;
constexpr auto stiffness_ = KernelForcing::stiffness;
constexpr auto damping_ = KernelForcing::damping;

double power_of_speed(const MassMaterial& model, double velocity) {
  if (model.damping_exponent == 0.0) return 1.0;
  return std::pow(std::abs(velocity) / model.reference_velocity, model.damping_exponent);
}

/// f/z of a small motion.
std::complex<double> forcing_gain(const MassMaterial& model, double omega, double velocity) {
  const std::complex<double> j(0.0, 1.0);
  switch (model.forcing) {
    case none: return 0.0;
    case displacement: return 1.0;
    case velocity_: return j * omega;
    case stiffness_: return model.stiffness.front();
    case damping_: return j * omega * first_harmonic_factor(model.damping_exponent) * power_of_speed(model, velocity);
  }
  return 0.0;
}

/// Force at rest at z, of which the settling point is a root.
double static_force(const MassMaterial& model, double z) {
  return stiffness_force(model, z) + kernel_forcing(model, z, 0.0) * static_kernel(model);
}

double static_slope(const MassMaterial& model, double z) {
  const double slope = stiffness_slope(model, z);
  if (model.forcing == displacement) return slope + static_kernel(model);
  if (model.forcing == stiffness_) return slope * (1.0 + static_kernel(model));
  return slope;
}

double bisect_settling(const MassMaterial& model, double weight, double above, double below) {
  for (int i = 0; i < 200 && above != below; ++i) {
    const double middle = 0.5 * (above + below);
    if (middle == above || middle == below) break;
    (static_force(model, middle) > -weight ? above : below) = middle;
  }
  return 0.5 * (above + below);
}

// The kernel orders "various" of Table A2 are none here. Table 4 has numbers of its own; its model 1 is 4b with M = 1.
constexpr ModelStructure all_structures[] = {
    {"1", "k1 z, c z', no kernel (Table A2 model 1)", 1, false, none, 0},
    {"2", "k1 z ... k5 z^5, c z', no kernel (Table A2 model 2)", 5, false, none, 0},
    {"3", "k1 z ... k5 z^5, c z'|z'|^lambda, no kernel (Table A2 model 3)", 5, true, none, 0},
    {"4a", "k1 z ... k5 z^5, c z', kernel of one term on z (Table A2 model 4(a))", 5, false, displacement, 1},
    {"4b", "k1 z ... k5 z^5, c z', kernel on z' (Table A2 model 4(b))", 5, false, velocity_, std::nullopt},
    {"5", "k1 z ... k5 z^5, c z', kernel of one term on k(z) (Table A2 model 5)", 5, false, stiffness_, 1},
    {"6", "k1 z ... k5 z^5, c z'|z'|^lambda, kernel on z'|z'|^lambda (Table A2 model 6)", 5, true, damping_,
     std::nullopt},
    {"7", "k1 z ... k5 z^5, c z'|z'|^lambda, kernel on z' (Table A2 model 7)", 5, true, velocity_, std::nullopt},
    {"linear_4b", "k1 z, c z', kernel on z': linear viscoelastic", 1, false, velocity_, std::nullopt},
    {"table4_1", "Table 4 model 1: 4b with one kernel term", 5, false, velocity_, 1},
    {"table4_4", "Table 4 model 4: 4b with 20 kernel terms", 5, false, velocity_, 20},
    {"table4_6", "Table 4 model 6: 6 with 20 kernel terms (lambda = 1.8 there)", 5, true, damping_, 20},
    {"table4_7", "Table 4 model 7: 7 with 20 kernel terms (lambda = 1.8 there)", 5, true, velocity_, 20},
};

}  // namespace

double stiffness_force(const MassMaterial& model, double z) {
  double sum = 0.0;
  for (std::size_t i = model.stiffness.size(); i-- > 0;) sum = (sum + model.stiffness[i]) * z;
  return sum;
}

double stiffness_slope(const MassMaterial& model, double z) {
  double sum = 0.0;
  for (std::size_t i = model.stiffness.size(); i-- > 0;)
    sum = sum * z + static_cast<double>(i + 1) * model.stiffness[i];
  return sum;
}

double damping_force(const MassMaterial& model, double velocity) {
  return model.damping * velocity * power_of_speed(model, velocity);
}

double kernel_forcing(const MassMaterial& model, double z, double velocity) {
  switch (model.forcing) {
    case none: return 0.0;
    case displacement: return z;
    case velocity_: return velocity;
    case stiffness_: return stiffness_force(model, z);
    case damping_: return velocity * power_of_speed(model, velocity);
  }
  return 0.0;
}

double kernel_value(const MassMaterial& model, double t) {
  double sum = 0.0;
  for (const HereditaryTerm& term : model.kernel)
    sum += (term.is_pair() ? 2.0 : 1.0) * (term.beta * std::exp(-term.alpha * t)).real();
  return sum;
}

std::complex<double> kernel_response(const MassMaterial& model, double omega) {
  const std::complex<double> s(0.0, omega);
  std::complex<double> sum = 0.0;
  for (const HereditaryTerm& term : model.kernel) {
    sum += term.beta / (s + term.alpha);
    if (term.is_pair()) sum += std::conj(term.beta) / (s + std::conj(term.alpha));
  }
  return sum;
}

// The mean of |cos|^p over a period is Gamma((p+1)/2) / (sqrt(pi) Gamma(p/2 + 1)).
double first_harmonic_factor(double lambda) {
  const double p = lambda + 2.0;
  return 2.0 * std::tgamma(0.5 * (p + 1.0)) / (std::sqrt(std::numbers::pi) * std::tgamma(0.5 * p + 1.0));
}

std::complex<double> complex_stiffness(const MassMaterial& model, double omega, double velocity) {
  const double c = model.damping * first_harmonic_factor(model.damping_exponent) * power_of_speed(model, velocity);
  return std::complex<double>(model.stiffness.front(), omega * c) +
         forcing_gain(model, omega, velocity) * kernel_response(model, omega);
}

double static_kernel(const MassMaterial& model) { return kernel_response(model, 0.0).real(); }

double static_stiffness(const MassMaterial& model) { return static_slope(model, 0.0); }

std::optional<double> static_settling_point(const MassMaterial& model, double gravity) {
  const double weight = model.mass * gravity;
  if (weight == 0.0) return 0.0;
  if (!(static_stiffness(model) > 0.0)) return std::nullopt;
  // Downwards in steps that are short against the linear answer, as far as the force still grows.
  const double step = 0.01 * weight / static_stiffness(model);
  double above = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const double below = above - step;
    if (static_force(model, below) <= -weight) return bisect_settling(model, weight, above, below);
    if (!(static_slope(model, below) > 0.0)) return std::nullopt;
    above = below;
  }
  return std::nullopt;
}

MassMaterial expanded_about(const MassMaterial& model, double z0) {
  MassMaterial shifted = model;
  const std::size_t n = model.stiffness.size();
  std::vector<double> a(n + 1, 0.0);  // coefficients of z^0 ... z^n, then of (z - z0)^i by repeated synthetic division
  for (std::size_t i = 0; i < n; ++i) a[i + 1] = model.stiffness[i];
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = n; k-- > i;) a[k] += z0 * a[k + 1];
  for (std::size_t i = 0; i < n; ++i) shifted.stiffness[i] = a[i + 1];
  return shifted;
}

Passivity passivity(const MassMaterial& model, double omega_low, double omega_high, double velocity, int n) {
  Passivity result{.passive = static_stiffness(model) > 0.0,
                   .worst_omega = omega_low,
                   .least_damping = std::numeric_limits<double>::infinity()};
  for (const HereditaryTerm& term : model.kernel) result.passive = result.passive && term.alpha.real() > 0.0;
  for (int i = 0; i < n; ++i) {
    const double omega = omega_low * std::pow(omega_high / omega_low, static_cast<double>(i) / (n - 1));
    const double damping = complex_stiffness(model, omega, velocity).imag() / omega;
    if (damping >= result.least_damping) continue;
    result.least_damping = damping;
    result.worst_omega = omega;
  }
  result.passive = result.passive && result.least_damping >= 0.0;
  return result;
}

double dissipative_sign(KernelForcing forcing) { return forcing == displacement || forcing == stiffness_ ? -1.0 : 1.0; }

std::span<const ModelStructure> model_structures() { return all_structures; }

const ModelStructure& model_structure(std::string_view name) {
  return find_by_name(model_structures(), name, "mass-material model");
}

}  // namespace pfdm
