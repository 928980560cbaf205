#pragma once
// Energy splits psi = psi_plus + psi_minus: only psi_plus is degraded by damage and drives it. (One that is not
// variational has a driving energy psi_plus that is no part of the stored one.)
//
// Energies are of second degree in the strain, so the stress g dpsi_plus/deps + dpsi_minus/deps is the tangent times
// the strain. Some splits have isotropic secant moduli besides: with them sigma = stress(secant, eps). The others say
// what compression keeps, in principal strains.
//
// Where the elasticity depends on the direction a split says what it keeps by the whole stiffness. It keeps the nearest
// stress, in the norm of the energy, of those that it may keep, or a part that is orthogonal to the rest. Then psi_plus
// and psi_minus add up to the energy, and isotropic constants give the isotropic split.

#include "physics/elasticity/anisotropy.h"
#include "physics/elasticity/elasticity.h"
#include "physics/elasticity/principal.h"
#include "physics/law_parameters.h"

#include <span>
#include <string>
#include <string_view>

namespace pfdm {

struct SplitEnergy {
  double psi_plus = 0.0;   ///< [J/m^3]
  double psi_minus = 0.0;  ///< [J/m^3]
};

/// A row of the table of splits.
struct SplitLaw {
  std::string_view name;
  std::string_view description;
  bool variational;  ///< psi_plus + psi_minus is the elastic energy, and the stress its slope when degraded
  SplitEnergy (*energy)(const IsotropicElasticity&, const Tensor& eps, const LawParameters& p);
  /// 1 where the strain closes cracks, so that part of the stiffness is kept; 0 where it opens them. Null without
  /// isotropic secant moduli.
  double (*closure)(const Tensor& eps) = nullptr;
  /// Secant moduli of the material degraded to g (residual stiffness included). With closure(eps) they give the stress
  /// of the law; values between 0 and 1 occur while an iteration settles. Null where there are no isotropic ones.
  IsotropicElasticity (*secant)(const IsotropicElasticity&, double g, double closure, const LawParameters& p) = nullptr;
  /// dpsi_minus/deps in the principal directions of the strain, by its principal values in ascending order, and its
  /// slope. Null with isotropic secant moduli.
  PrincipalStress (*kept)(const IsotropicElasticity&, const Vector& principal_strain, const LawParameters& p) = nullptr;
  /// d2psi_minus/deps2 [Pa] of an elasticity that depends on the direction, at the strain eps or in its direction.
  /// Null: the split is one of isotropic elasticity.
  MandelMatrix (*kept_of)(const AnisotropicElasticity&, const Tensor& eps) = nullptr;
  std::span<const LawParameter> parameters{};
};

/// A split with its parameters.
class EnergySplit {
 public:
  EnergySplit() = default;  ///< none is chosen
  explicit EnergySplit(const SplitLaw& law) : EnergySplit(law, default_values(law.parameters)) {}
  EnergySplit(const SplitLaw& law, const LawParameters& p) : law_(&law), p_(p) {}

  bool is_chosen() const { return law_ != nullptr; }
  const SplitLaw& law() const { return *law_; }
  std::string_view name() const { return law_->name; }
  bool is_variational() const { return law_->variational; }
  bool has_secant() const { return law_->secant != nullptr; }  ///< isotropic secant moduli
  /// Whether elasticity may depend on the direction.
  bool suits_anisotropy() const { return law_->kept_of != nullptr; }

  SplitEnergy energy(const IsotropicElasticity& c, const Tensor& eps) const { return law_->energy(c, eps, p_); }
  double closure(const Tensor& eps) const { return law_->closure(eps); }
  IsotropicElasticity secant(const IsotropicElasticity& c, double g, double closure) const {
    return law_->secant(c, g, closure, p_);
  }
  PrincipalStress kept(const IsotropicElasticity& c, const Vector& principal_strain) const {
    return law_->kept(c, principal_strain, p_);
  }

 private:
  const SplitLaw* law_ = nullptr;
  LawParameters p_{};
};

/// d sigma / d eps [Pa] of the material degraded to g at the strain eps, or in its direction: the length of eps has no
/// influence. At eps = 0 cracks are open.
MandelMatrix degraded_tangent(const EnergySplit& split, const IsotropicElasticity& c, double g, const Tensor& eps);

/// The part of the stress that damage degrades, before it does [Pa]: dpsi_plus/deps of a variational split.
Tensor degradable_stress(const EnergySplit& split, const IsotropicElasticity& c, const Tensor& eps);
Tensor degraded_stress(const EnergySplit& split, const IsotropicElasticity& c, double g, const Tensor& eps);

/// Tangent [Pa], degradable stress [Pa] and energies where the elasticity depends on the direction, which the split
/// must allow.
MandelMatrix degraded_tangent(const EnergySplit& split, const AnisotropicElasticity& c, double g, const Tensor& eps);
Tensor degradable_stress(const EnergySplit& split, const AnisotropicElasticity& c, const Tensor& eps);
SplitEnergy energy(const EnergySplit& split, const AnisotropicElasticity& c, const Tensor& eps);

std::span<const SplitLaw> energy_splits();
/// The names of those with isotropic secant moduli, for messages: "none, volumetric_deviatoric ...".
std::string splits_with_secant();
/// Names of the splits that allow elasticity which depends on the direction.
std::string splits_for_anisotropy();
/// Throws InputError naming those there are.
const SplitLaw& split_law(std::string_view name);
/// Split with the default values of its parameters. Throws InputError naming those there are, or if it has a parameter
/// without a default.
EnergySplit energy_split(std::string_view name);

}  // namespace pfdm
