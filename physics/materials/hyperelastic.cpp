#include "physics/materials/hyperelastic.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

// Measured on tetrahedra: without a pressure unknown 0.49 takes ten times the iterations of 0.3, 0.499 does not
// converge.
constexpr double largest_poisson_ratio = 0.49;

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

// A -> B A B of symmetric tensors.
MandelMatrix product_map(const Tensor& B) {
  MandelMatrix map;
  for (Index k = 0; k < n_components; ++k) map.col(k) = to_mandel(B * to_tensor(Mandel(Mandel::Unit(k))) * B);
  return map;
}

// What a function f(J) adds to S and dS/dE: S = J f' C^-1.
void add(double J, double slope, double curvature, const Tensor& inverse_C, Mandel& S, MandelMatrix& C) {
  const Mandel inverse = to_mandel(inverse_C);
  S += J * slope * inverse;
  C += J * (slope + J * curvature) * inverse * inverse.transpose();
  C -= 2.0 * J * slope * product_map(inverse_C);
}

void check(const HyperelasticLaw& law, const HyperelasticParameters& p) {
  const double nu = p.elasticity.poisson_ratio();
  if (nu > largest_poisson_ratio * (1.0 + 1e-9))
    throw InputError(
        fmt::format("a material of the law \"{}\" with a Poisson's ratio of {}: materials of finite strain have no "
                    "pressure unknown; at most {} is allowed",
                    law.name, nu, largest_poisson_ratio));
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

double volume_change(const Tensor& H) {
  const double second = 0.5 * (H.trace() * H.trace() - (H * H).trace());
  return H.trace() + second + H.determinant();
}

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
    throw InputError(
        fmt::format("a material of the law \"{}\" with these parameters and a Poisson's ratio of {:.6g} has a negative "
                    "stiffness against changes of volume beyond its shear part's, {:.4g} Pa; a larger Poisson's ratio "
                    "is required",
                    law_.name, elasticity().poisson_ratio(), Lambda_));
}

// U.
HyperelasticMaterial::OfVolume HyperelasticMaterial::volumetric(double change) const {
  if (p_.volumetric == VolumetricForm::quadratic) return {0.5 * Lambda_ * change * change, Lambda_ * change, Lambda_};
  const double J = 1.0 + change, square = change * (2.0 + change);  // J^2 - 1
  return {0.25 * Lambda_ * (square - 2.0 * std::log1p(change)), 0.5 * Lambda_ * square / J,
          0.5 * Lambda_ * (1.0 + 1.0 / (J * J))};
}

PotentialAt HyperelasticMaterial::potential(const Tensor& H) const {
  const Tensor F = Tensor::Identity() + H, E = green_strain(H);
  const double change = volume_change(H);
  const ShearEnergy shear = law_.shear(p_, E);
  const OfVolume U = volumetric(change);
  const Tensor inverse = (F.transpose() * F).inverse();
  Mandel S = shear.stress;
  MandelMatrix C = shear.stiffness;
  add(1.0 + change, U.slope, U.curvature, inverse, S, C);
  S += 2.0 * p0_ * to_mandel(symmetric_part(inverse * E));  // p0 (1 - C^-1)
  C += 2.0 * p0_ * product_map(inverse);
  return by_gradient(shear.energy - p0_ * std::log1p(change) + U.value, F, S, C);
}

// W(l 1) with l = J^(1/3): its slope by J is P_11/l^2, as dJ = 3 l^2 dl.
HyperelasticMaterial::OfVolume HyperelasticMaterial::dilation(double change) const {
  const double stretch = std::cbrt(1.0 + change);
  const PotentialAt at = potential(Tensor(std::expm1(std::log1p(change) / 3.0) * Tensor::Identity()));
  const double p = at.stress(0, 0) / (stretch * stretch);
  const GradientTangent& A = at.tangent;
  const double dP = A(0, 0) + A(0, 4) + A(0, 8);  // of P_11 by the stretch
  const double by_stretch = dP / (stretch * stretch) - 2.0 * p / stretch;
  return {at.energy, p, by_stretch / (3.0 * stretch * stretch)};
}

PotentialAt HyperelasticMaterial::compression(const Tensor& H) const {
  const double change = volume_change(H);
  if (change >= 0.0) return {};
  const Tensor F = Tensor::Identity() + H;
  const OfVolume f = dilation(change);
  Mandel S = Mandel::Zero();
  MandelMatrix C = MandelMatrix::Zero();
  add(1.0 + change, f.slope, f.curvature, (F.transpose() * F).inverse(), S, C);
  return by_gradient(f.value, F, S, C);
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
