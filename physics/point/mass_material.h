#pragma once
// A mass on a sample on a shaker: m z'' + c(z') + k(z) + v = -m y'' with z the mass's displacement relative to the base
// and y'' the base's acceleration (report AFRL-RW-EG-TR-2016-088, eqs. A1-A5). The terms:
//
//   k(z) = k_1 z + ... + k_N z^N                          stiffness polynomial
//   c(z') = c z' |z'/V|^lambda                            damping, linear for lambda = 0
//   v(t) = int_-inf^t f(tau) g(t - tau) dtau              hereditary force
//   g(t) = sum_i beta_i exp(-alpha_i t)                   its kernel, real terms or conjugate pairs
//   f = z, z', k(z) or z' |z'/V|^lambda                   what drives it
//
// The report's c is c/V^lambda here: with a velocity V of the size that occurs, c keeps the unit N s/m for any lambda.
// The models of the report's Tables A2 and 4 are choices of terms, the rows of model_structures().

#include <complex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

enum class KernelForcing { none, displacement, velocity, stiffness, damping };

/// beta exp(-alpha t); with Im(alpha) != 0 the term stands for itself and its conjugate.
struct HereditaryTerm {
  std::complex<double> alpha;  ///< [1/s]
  std::complex<double> beta;   ///< [N/m] for f = z' and z'|z'/V|^lambda, [N/m/s] for f = z, [1/s] for f = k(z)
  bool is_pair() const { return alpha.imag() != 0.0; }
};

inline constexpr double standard_gravity = 9.80665;  ///< g0 [m/s^2]
inline constexpr double g0_squared = standard_gravity * standard_gravity;

struct MassMaterial {
  double mass = 1.0;                ///< m [kg]
  std::vector<double> stiffness{};  ///< k_1 ... k_N [N/m^i]
  double damping = 0.0;             ///< c [N s/m]
  double damping_exponent = 0.0;    ///< lambda [-]
  double reference_velocity = 1.0;  ///< V [m/s]
  KernelForcing forcing = KernelForcing::none;
  std::vector<HereditaryTerm> kernel{};
};

double stiffness_force(const MassMaterial& model, double z);                    ///< k(z) [N]
double stiffness_slope(const MassMaterial& model, double z);                    ///< dk/dz [N/m]
double damping_force(const MassMaterial& model, double velocity);               ///< c(z') [N]
double kernel_forcing(const MassMaterial& model, double z, double velocity);    ///< f
double kernel_value(const MassMaterial& model, double t);                       ///< g(t), t >= 0
std::complex<double> kernel_response(const MassMaterial& model, double omega);  ///< sum beta/(alpha + j omega)

/// The force per displacement of a small motion exp(j omega t) about z = 0: k_1 + j omega c + (f/z) G. With lambda > 0
/// the damping is that of a motion with the velocity amplitude `velocity` [m/s], by its first harmonic. [N/m]
std::complex<double> complex_stiffness(const MassMaterial& model, double omega, double velocity = 0.0);

/// The mean of |cos|^(lambda + 2) over that of cos^2: c(z') of a sine is c times this times the sine's amplitude over V
/// to the power of lambda, in its first harmonic.
double first_harmonic_factor(double lambda);

/// int_0^inf g dt = sum beta/alpha: what the kernel makes of a constant f.
double static_kernel(const MassMaterial& model);

/// k_1 plus what the kernel adds at rest [N/m]; where it is not positive the mass does not come to rest.
double static_stiffness(const MassMaterial& model);

/// Displacement z0 [m] at which the mass settles under gravity [m/s^2] (negative): k(z0) + f(z0, 0) sum beta/alpha = -m
/// gravity. None if the mass falls through: the force does not reach the weight on the branch that starts at z = 0.
std::optional<double> static_settling_point(const MassMaterial& model, double gravity);

/// Model of the same system in displacements from z0: the stiffness polynomial expanded about it (A1 to A2).
MassMaterial expanded_about(const MassMaterial& model, double z0);

/// Check of passivity: the frequency at which a small motion takes least energy out of the shaker.
struct Passivity {
  bool passive = true;       ///< loss stiffness >= 0 all over the band, static stiffness > 0, all alpha > 0
  double worst_omega = 0;    ///< [rad/s]
  double least_damping = 0;  ///< the least of Im K / omega [N s/m], there
};
/// Checked at `n` frequencies spaced evenly in the logarithm.
Passivity passivity(const MassMaterial& model, double omega_low, double omega_high, double velocity, int n = 400);

/// The terms that a named model has.
struct ModelStructure {
  std::string_view name;
  std::string_view description;
  int stiffness_order;     ///< N
  bool nonlinear_damping;  ///< lambda is free; otherwise 0
  KernelForcing forcing;
  std::optional<int> kernel_order;  ///< M; none: any
};
std::span<const ModelStructure> model_structures();
const ModelStructure& model_structure(std::string_view name);

/// The sign that beta must have for the term to dissipate: + for f of velocity type, - for f = z and k(z), because
/// Im[beta/(alpha + j omega)] < 0 for beta > 0.
double dissipative_sign(KernelForcing forcing);

}  // namespace pfdm
