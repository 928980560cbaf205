#include "physics/materials/hyperelastic.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

// Poisson's ratio above which cells have a pressure, and lambda_s/mu; as at small strain
// (solver/momentum/body/unknowns.cpp, cell_pressure.h). Without a pressure 0.49 takes ten times the iterations of 0.3,
// 0.499 does not converge.
constexpr double nearly_incompressible = 0.47, moderate_lambda = 2.5;
constexpr double least_volume = 0.1;  // J from which on functions of J go on by their expansion

using GreenSlope = Eigen::Matrix<double, 6, 9>;

// dE/dH = sym(F^T dH).
GreenSlope green_slope(const Tensor& F) {
  GreenSlope slope;
  for (Index k = 0; k < 3; ++k)
    for (Index L = 0; L < 3; ++L)
      slope.col(3 * k + L) = to_mandel(symmetric_part(F.row(k).transpose() * Vector::Unit(L).transpose()));
  return slope;
}

Tensor green_strain(const Tensor& H) { return symmetric_part(H) + 0.5 * H.transpose() * H; }

// P and A from S and dS/dE.
PotentialAt by_gradient(double energy, const Tensor& F, const Mandel& S, const MandelMatrix& C) {
  const GreenSlope slope = green_slope(F);
  const Tensor stress = to_tensor(S);
  PotentialAt result{.energy = energy, .stress = F * stress, .tangent = slope.transpose() * C * slope};
  for (Index i = 0; i < 3; ++i) result.tangent.block<3, 3>(3 * i, 3 * i) += stress;
  return result;
}

// Potential of a function of J at F, by its value and derivatives.
PotentialAt by_volume(const Tensor& F, double value, double slope, double curvature) {
  const Tensor cof = cofactor(F);
  const Components normal = to_components(cof);
  PotentialAt result{.energy = value, .stress = slope * cof, .tangent = curvature * normal * normal.transpose()};
  for (Index k = 0; k < 3; ++k)
    for (Index L = 0; L < 3; ++L)
      result.tangent.col(3 * k + L) +=
          slope * to_components(cofactor_change(F, Vector::Unit(k) * Vector::Unit(L).transpose()));
  return result;
}

void check(const HyperelasticLaw& law, const HyperelasticParameters& p) {
  const double nu = p.elasticity.poisson_ratio();
  if (law.name == "saint_venant_kirchhoff" && nu > nearly_incompressible * (1.0 + 1e-9))
    throw InputError(
        fmt::format("a material of the law \"{}\" with a Poisson's ratio of {}: this law has no pressure unknown; at "
                    "most {} is allowed",
                    law.name, nu, nearly_incompressible));
  if (!(p.second_invariant >= 0.0 && p.second_invariant <= 1.0))
    throw InputError(fmt::format("second_invariant is {}; it must be between 0 and 1", p.second_invariant));
  if (p.shares.size() != p.exponents.size())
    throw InputError(
        fmt::format("{} shares for {} exponents; each exponent needs its share", p.shares.size(), p.exponents.size()));
  const double sum = std::accumulate(p.shares.begin(), p.shares.end(), 0.0);
  if (!p.shares.empty() && !(std::abs(sum - 1.0) < 1e-6))
    throw InputError(fmt::format("the shares of the shear modulus sum to {}; they must sum to 1", sum));
  for (const double alpha : p.exponents)
    if (alpha == 0.0 || !std::isfinite(alpha))
      throw InputError(fmt::format("an exponent is {}; it must be finite and not zero", alpha));
}

}  // namespace

HyperelasticMaterial::HyperelasticMaterial(const HyperelasticLaw& law, HyperelasticParameters parameters)
    : Material(law.name, parameters.elasticity), law_(law), p_(std::move(parameters)) {
  check(law_, p_);
  p0_ = law_.initial_stress(p_);
  const MandelMatrix C = law_.shear(p_, Tensor::Zero()).stiffness;
  Lambda_ = elasticity().lambda - C(0, 1);
  const double rounding = 1e-9 * elasticity().mu;
  if (!(std::abs(0.5 * C(3, 3) + p0_ - elasticity().mu) <= rounding))
    throw InputError(fmt::format("a material of the law \"{}\" needs exponents and shares", law_.name));
  if (Lambda_ < -rounding)
    throw InputError(fmt::format(
        "a material of the law \"{}\" with these parameters and a Poisson's ratio of {:.6g} has a negative stiffness "
        "against changes of volume beyond its shear part's, {}; a larger Poisson's ratio is required",
        law_.name, elasticity().poisson_ratio(), quantity_text(Lambda_, "Pa")));
  const double moderate = std::max(moderate_lambda * elasticity().mu - C(0, 1), 0.0);
  if (elasticity().poisson_ratio() > nearly_incompressible)
    pressure_modulus_ = std::max(Lambda_ - moderate, 0.5 * Lambda_);
}

// U.
HyperelasticMaterial::OfVolume HyperelasticMaterial::volumetric(double Lambda, double change) const {
  if (p_.volumetric == VolumetricForm::quadratic) return {0.5 * Lambda * change * change, Lambda * change, Lambda};
  const double J = 1.0 + change, square = change * (2.0 + change);  // J^2 - 1
  return {0.25 * Lambda * (square - 2.0 * std::log1p(change)), 0.5 * Lambda * square / J,
          0.5 * Lambda * (1.0 + 1.0 / (J * J))};
}

// -p0 ln J + U, of J >= least_volume.
HyperelasticMaterial::OfVolume HyperelasticMaterial::of_volume(double Lambda, double change) const {
  const double J = 1.0 + change;
  const OfVolume U = volumetric(Lambda, change);
  return {U.value - p0_ * std::log1p(change), U.slope - p0_ / J, U.curvature + p0_ / (J * J)};
}

VolumeAt HyperelasticMaterial::volume(double q, double g) const {
  const double modulus = g * pressure_modulus_, x = q / modulus;
  if (p_.volumetric == VolumetricForm::quadratic) return {x, 1.0 / modulus};
  const double root = std::sqrt(1.0 + x * x);
  return {x + x * x / (root + 1.0), (1.0 + x / root) / modulus};
}

// From J - 1 = `change` on, if that is less than where the function f is given.
auto HyperelasticMaterial::extended(double change, const auto& f) -> OfVolume {
  if (1.0 + change >= least_volume) return f(change);
  const OfVolume at = f(least_volume - 1.0);
  const double by = 1.0 + change - least_volume;
  return {at.value + (at.slope + 0.5 * at.curvature * by) * by, at.slope + at.curvature * by, at.curvature};
}

PotentialAt HyperelasticMaterial::potential_with(double Lambda, const Tensor& H, double change) const {
  const Tensor F = Tensor::Identity() + H, E = green_strain(H);
  const double det = 1.0 + volume_change(H), J = 1.0 + change;
  const ShearEnergy shear = law_.shear(p_, E);
  const OfVolume f = extended(change, [&](double at) { return of_volume(Lambda, at); });
  const PotentialAt by_J = by_volume(F, f.value, f.slope, f.curvature);
  PotentialAt result = by_gradient(shear.energy, F, shear.stress, shear.stiffness);
  result.energy += by_J.energy;
  result.tangent += by_J.tangent + p0_ * GradientTangent::Identity();
  if (std::min(J, det) < least_volume) {
    result.stress += p0_ * F + by_J.stress;
  } else {  // p0 (F - F^-T) = 2 p0 F^-T E, without its cancellation
    const double by_change = volumetric(Lambda, change).slope + p0_ * (J - det) / (J * det);
    result.stress += cofactor(F) * ((2.0 * p0_ / det) * E + by_change * Tensor::Identity());
  }
  return result;
}

// W(l 1) with l = J^(1/3): its slope by J is P_11/l^2, as dJ = 3 l^2 dl.
HyperelasticMaterial::OfVolume HyperelasticMaterial::dilation(double Lambda, double change) const {
  const double stretch = std::cbrt(1.0 + change);
  const Tensor H = std::expm1(std::log1p(change) / 3.0) * Tensor::Identity();
  const PotentialAt at = potential_with(Lambda, H, volume_change(H));
  const double p = at.stress(0, 0) / (stretch * stretch);
  const GradientTangent& A = at.tangent;
  const double dP = A(0, 0) + A(0, 4) + A(0, 8);  // of P_11 by the stretch
  const double by_stretch = dP / (stretch * stretch) - 2.0 * p / stretch;
  return {at.energy, p, by_stretch / (3.0 * stretch * stretch)};
}

PotentialAt HyperelasticMaterial::compression_with(double Lambda, const Tensor& H, double change) const {
  if (change >= 0.0) return {};
  const OfVolume f = extended(change, [&](double at) { return dilation(Lambda, at); });
  return by_volume(Tensor::Identity() + H, f.value, f.slope, f.curvature);
}

// At F = 1 the trace of N.A.N is 4 mu + lambda.
double HyperelasticMaterial::shear_modulus(const Tensor& F, const GradientTangent& A, double lambda) const {
  if (!law_.stiffens) return elasticity().mu;
  const Tensor cof = cofactor(F);
  double sum = 0.0;
  for (Index k = 0; k < 3; ++k) sum += acoustic_tensor(A, Vector::Unit(k)).trace() - lambda * cof.col(k).squaredNorm();
  return std::clamp(sum / 12.0, 0.5 * elasticity().mu, 50.0 * elasticity().mu);
}

MaterialResponse HyperelasticMaterial::update(const MaterialStep& step, std::span<double>) const {
  if (!(volume_change(step.to) > -1.0)) return {.solved = false};
  const PotentialAt at = potential(step.to);
  return {.stress = at.stress, .tangent = at.tangent, .solved = std::isfinite(at.energy)};
}

Tensor HyperelasticMaterial::stress(const Tensor& H, std::span<const double>) const { return potential(H).stress; }

MaterialEnergy HyperelasticMaterial::energy(const Tensor& H, std::span<const double>, const EnergySplit& split) const {
  const double kept = split.name() == "none" ? 0.0 : compression(H).energy;
  return {.driving = potential(H).energy - kept};
}

std::shared_ptr<const Material> make_hyperelastic(std::string_view law, HyperelasticParameters parameters) {
  return std::make_shared<const HyperelasticMaterial>(hyperelastic_law(law), std::move(parameters));
}

}  // namespace pfdm
