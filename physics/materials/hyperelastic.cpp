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
// Of viscoelastic materials, and the share of K that a pressure has at least (relaxing_volume.h, cell_pressure.h).
constexpr double most_without_pressure = 0.4 + 1e-6, least_share = 0.2;
constexpr double rounding_of_own = 1e-6;  // of the moduli of an energy of one's own, as of differences

void check(const HyperelasticLaw& law, const HyperelasticParameters& p) {
  const double nu = p.elasticity.poisson_ratio();
  if (law.name == "saint_venant_kirchhoff" && nu > nearly_incompressible * (1.0 + 1e-9))
    throw InputError(
        fmt::format("a material of the law \"{}\" with a Poisson's ratio of {}: this law has no pressure unknown; at "
                    "most {} is allowed",
                    law.name, nu, nearly_incompressible));
  const bool has_branches = !p.branches.empty() || !p.bulk_branches.empty();
  if (law.name == "saint_venant_kirchhoff" && has_branches)
    throw InputError("a material of the law \"saint_venant_kirchhoff\" cannot have shear_branches; choose neo_hookean");
  if (p.shift && !has_branches)
    throw InputError(
        fmt::format("a material of the law \"{}\" has a temperature_shift but no shear_branches, whose times it would "
                    "shift",
                    law.name));
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
  if (p_.own) check_own(C);
  const double rounding = (p_.own ? rounding_of_own : 1e-9) * elasticity().mu;
  if (!(std::abs(0.5 * C(3, 3) + p0_ - elasticity().mu) <= rounding))
    throw InputError(fmt::format("a material of the law \"{}\" needs exponents and shares", law_.name));
  if (Lambda_ < -rounding)
    throw InputError(fmt::format(
        "a material of the law \"{}\" with these parameters and a Poisson's ratio of {:.6g} has a negative stiffness "
        "against changes of volume beyond its shear part's, {}; a larger Poisson's ratio is required",
        law_.name, elasticity().poisson_ratio(), quantity_text(Lambda_, "Pa")));
  choose_pressure(C(0, 1));
  branches_ = ViscousBranches(p_.branches, p_.volumetric, 0.0, p_.bulk_branches);
  branches_of_cells_ = ViscousBranches(p_.branches, p_.volumetric, bulk_ratio_, p_.bulk_branches);
}

// C: dS/dE at F = 1 [Pa].
void HyperelasticMaterial::check_own(const MandelMatrix& C) const {
  const double mu = elasticity().mu, nu = elasticity().poisson_ratio();
  const double lambda_s = C(0, 1), half_shear = 0.5 * C(3, 3), shear = half_shear + p0_;
  const MandelMatrix isotropic =
      lambda_s * mandel_identity() * mandel_identity().transpose() + 2.0 * half_shear * MandelMatrix::Identity();
  if (!((C - isotropic).norm() <= rounding_of_own * (C.norm() + mu)))
    throw InputError("the energy is not isotropic at F = 1; only such ones are supported");
  if (!(std::abs(shear - mu) <= rounding_of_own * mu))
    throw InputError(fmt::format(
        "the energy has the shear modulus {} at F = 1, young_modulus and poisson_ratio of the case make {}; "
        "they must be the same",
        quantity_text(shear, "Pa"), quantity_text(mu, "Pa")));
  const double limit = has_branches() ? most_without_pressure : nearly_incompressible;
  if (nu > limit && Lambda_ < 0.5 * elasticity().lambda)
    throw InputError(
        fmt::format("the energy has a volume energy of its own; with a Poisson's ratio of {:.6g}, above {:.3g}, leave "
                    "its terms in ln J or J - 1 out: they are added, by poisson_ratio and volumetric of the case",
                    nu, limit));
}

// The greatest Poisson's ratio that could come about: the shear has relaxed, and the volume has not at all.
void HyperelasticMaterial::require_no_pressure() const {
  double K = elasticity().bulk_modulus();
  for (const PronyBranch& branch : p_.bulk_branches) K += branch.modulus;
  const double mu = elasticity().mu, nu = (3.0 * K - 2.0 * mu) / (6.0 * K + 2.0 * mu);
  if (nu > most_without_pressure)
    throw InputError(fmt::format(
        "a material of the law \"{}\" with bulk_branches whose Poisson's ratio could come to {:.4g}, as all bulk "
        "branches beside the relaxed shear modulus make it: at most 0.4 is supported, where cells need no pressure",
        law_.name, nu));
}

// shear_lambda: lambda of the shear part [Pa]. Of viscoelastic materials lambda_s/mu is one that leaves the pressure a
// share of K before anything has relaxed.
void HyperelasticMaterial::choose_pressure(double shear_lambda) {
  if (!has_branches()) {
    const double moderate = std::max(moderate_lambda * elasticity().mu - shear_lambda, 0.0);
    if (elasticity().poisson_ratio() > nearly_incompressible)
      pressure_modulus_ = std::max(Lambda_ - moderate, 0.5 * Lambda_);
    return;
  }
  prony_ = {
      .relaxed = elasticity(), .shear = p_.branches, .bulk = p_.bulk_branches, .drive = p_.drive, .shift = p_.shift};
  require_branches(prony_);
  if (!p_.bulk_branches.empty()) require_no_pressure();
  if (!(elasticity().poisson_ratio() > most_without_pressure)) return;
  const IsotropicElasticity at_once = instantaneous_elasticity(prony_);
  const double ratio = std::min(moderate_lambda, (at_once.lambda - least_share * at_once.bulk_modulus()) / at_once.mu);
  pressure_modulus_ = std::min(elasticity().lambda - ratio * elasticity().mu, Lambda_);
  const double of_branches = instantaneous_shear_modulus() - elasticity().mu;
  const double most = (pressure_modulus_ - least_share * elasticity().bulk_modulus()) / of_branches;
  bulk_ratio_ = std::min(ratio + 2.0 / 3.0, most);
  if (!(bulk_ratio_ > 0.0))
    throw InputError(fmt::format(
        "a material of the law \"{}\" with shear_branches of {} in all and a Poisson's ratio of {:.6g}: its "
        "pressure is left with less than {:g} of the bulk modulus; a larger Poisson's ratio is required",
        law_.name, quantity_text(of_branches, "Pa"), elasticity().poisson_ratio(), least_share));
}

// U.
OfVolume HyperelasticMaterial::volumetric(double Lambda, double change) const {
  const OfVolume U = volume_energy(p_.volumetric, change);
  return {Lambda * U.value, Lambda * U.slope, Lambda * U.curvature};
}

// -p0 ln J + U, of J >= least_volume.
OfVolume HyperelasticMaterial::of_volume(double Lambda, double change) const {
  const double J = 1.0 + change;
  const OfVolume U = volumetric(Lambda, change);
  return {U.value - p0_ * std::log1p(change), U.slope - p0_ / J, U.curvature + p0_ / (J * J)};
}

double HyperelasticMaterial::instantaneous_shear_modulus() const {
  return std::accumulate(p_.branches.begin(), p_.branches.end(), elasticity().mu,
                         [](double sum, const PronyBranch& branch) { return sum + branch.modulus; });
}

double HyperelasticMaterial::volume_strain(double change) const {
  return extended_volume_energy(p_.volumetric, change).slope;
}

VolumeAt HyperelasticMaterial::volume(double q, double modulus) const {
  const double x = q / modulus;
  if (p_.volumetric == VolumetricForm::quadratic) return {x, 1.0 / modulus};
  const double root = std::sqrt(1.0 + x * x);
  return {x + x * x / (root + 1.0), (1.0 + x / root) / modulus};
}

PotentialAt HyperelasticMaterial::potential_with(double Lambda, const Tensor& H, double change) const {
  const Tensor F = Tensor::Identity() + H, E = green_strain(H);
  const double det = 1.0 + volume_change(H), J = 1.0 + change;
  const ShearEnergy shear = law_.shear(p_, E);
  const OfVolume f = extended(change, [&](double at) { return of_volume(Lambda, at); });
  const PotentialAt by_J = by_volume(F, f);
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
OfVolume HyperelasticMaterial::dilation(double Lambda, double change) const {
  const double stretch = std::cbrt(1.0 + change);
  const Tensor H = std::expm1(std::log1p(change) / 3.0) * Tensor::Identity();
  const PotentialAt at = potential_with(Lambda, H, volume_change(H));
  const double p = at.stress(0, 0) / (stretch * stretch);
  const GradientTangent& A = at.tangent;
  const double dP = A(0, 0) + A(0, 4) + A(0, 8);  // of P_11 by the stretch
  const double by_stretch = dP / (stretch * stretch) - 2.0 * p / stretch;
  return {at.energy, p, by_stretch / (3.0 * stretch * stretch)};
}

PotentialAt HyperelasticMaterial::dilation_of(double Lambda, const Tensor& H) const {
  const OfVolume f = extended(volume_change(H), [&](double at) { return dilation(Lambda, at); });
  return by_volume(Tensor::Identity() + H, f);
}

// At F = 1 the trace of N.A.N is 4 mu + lambda.
double HyperelasticMaterial::shear_modulus(const Tensor& F, const GradientTangent& A, double lambda) const {
  if (!law_.stiffens) return elasticity().mu;
  const Tensor cof = cofactor(F);
  double sum = 0.0;
  for (Index k = 0; k < 3; ++k) sum += acoustic_tensor(A, Vector::Unit(k)).trace() - lambda * cof.col(k).squaredNorm();
  return std::clamp(sum / 12.0, 0.5 * elasticity().mu, 50.0 * elasticity().mu);
}

MaterialResponse HyperelasticMaterial::update(const MaterialStep& step, std::span<double> history) const {
  if (!(volume_change(step.to) > -1.0)) return {.solved = false};
  const PointBefore before{step.from, step.duration, step.history};
  PotentialAt at = potential(step.to);
  at += branches_.over(step.to, before);
  branches_.advance(step.to, before, history);
  return {.stress = at.stress, .tangent = at.tangent, .solved = std::isfinite(at.energy)};
}

Tensor HyperelasticMaterial::stress(const Tensor& H, std::span<const double> history) const {
  return potential(H).stress + branches_.over(H, {H, 0.0, history}).stress;
}

MaterialEnergy HyperelasticMaterial::energy(const Tensor& H, std::span<const double> history,
                                            const EnergySplit& split) const {
  const double kept = split.name() == "none" ? 0.0 : compression(H).energy;
  const double in_branches = branches_.over(H, {H, 0.0, history}).energy;
  const bool drives = p_.drive == PronyDrive::stored;
  return {.driving = potential(H).energy - kept + (drives ? in_branches : 0.0),
          .idle = drives ? 0.0 : in_branches,
          .dissipated = branches_.heat(history)};
}

std::shared_ptr<const Material> make_hyperelastic(std::string_view law, HyperelasticParameters parameters) {
  return std::make_shared<const HyperelasticMaterial>(hyperelastic_law(law), std::move(parameters));
}

std::shared_ptr<const Material> make_own_hyperelastic(HyperelasticParameters parameters) {
  return std::make_shared<const HyperelasticMaterial>(own_hyperelastic_law(), std::move(parameters));
}

}  // namespace pfdm
