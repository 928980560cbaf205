#pragma once
// Hyperelastic materials at finite strain: a strain energy W(C) per reference volume, C = F^T F; first Piola-Kirchhoff
// stress P = dW/dF and its tangent A = dP/dF. All laws but Saint Venant-Kirchhoff's are
//
//   W = W_s(C) - p0 ln J + U(J),   J = det F,
//
// with a shear part W_s that has the stress p0 I at F = 1. U is Lambda times the volume energy of potential.h, Lambda
// such that at small strain the law is that of the given elasticity (lambda, mu).
//
// The shear parts: with mu_p = share_p mu, I1 = tr C, I2 = (I1^2 - tr C^2)/2 and stretches l_i
//   neo_hookean            mu/2 (I1 - 3)
//   mooney_rivlin          (mu - mu_01)/2 (I1 - 3) + mu_01/2 (I2 - 3)
//   ogden                  sum 2 mu_p/alpha_p^2 (l_1^alpha_p + l_2^alpha_p + l_3^alpha_p - 3)   (Proc. R. Soc. A 326
//                          (1972) 565)
//   lopez_pamies           sum 3^(1 - alpha_p)/(2 alpha_p) mu_p (I1^alpha_p - 3^alpha_p)  (C. R. Mecanique 338 (2010)
//   3) saint_venant_kirchhoff lambda/2 (tr E)^2 + mu E:E,  E = (C - 1)/2, for small strains and large rotations: under
//                          compression it softens and can invert
//
// A law of one's own (OwnStrainEnergy) is W_s, isotropic at F = 1; the rest is as above.
//
// Formulas start from H = F - 1 and E, so that small strains lose no digits.
//
// Where J < 0.1 the functions of J, -p0 ln J + U and W_c, go on as their expansion to second order about J = 0.1. The
// energy, convex in J still, and its stress are then finite for any F, also where a cell has turned inside out.
//
// Nearly incompressible materials (nu > 0.47): an unknown pressure q = c U'(J) carries the share c of U that is beyond
// lambda_s = 2.5 mu (solver/momentum/body/cell_pressure.h), P = dW_m/dF + q cof F with W_m = W - c U.
//
// Viscoelastic materials have Maxwell branches beside this law (viscous_branches.h), which is then what is left at
// rest. Their cells have a pressure if nu > 0.4; lambda_s relaxes as mu does. Cells with bulk branches have none.

#include "physics/materials/material.h"
#include "physics/materials/viscous_branches.h"

#include <memory>
#include <optional>
#include <vector>

namespace pfdm {

/// The shear part by the Green strain E: S - p0 I with S = 2 dW_s/dC, and dS/dE.
struct ShearEnergy {
  double energy = 0.0;                            ///< W_s [J/m^3]
  Mandel stress = Mandel::Zero();                 ///< [Pa]
  MandelMatrix stiffness = MandelMatrix::Zero();  ///< [Pa]
};

/// A shear part that is no row of the table of laws, as one that a script has written. It may have a volume energy,
/// too: U adds what the given elasticity has beyond it.
class OwnStrainEnergy {
 public:
  OwnStrainEnergy() = default;
  OwnStrainEnergy(const OwnStrainEnergy&) = delete;
  OwnStrainEnergy& operator=(const OwnStrainEnergy&) = delete;
  virtual ~OwnStrainEnergy() = default;

  virtual double initial_stress() const = 0;          ///< p0 [Pa]
  virtual ShearEnergy at(const Tensor& E) const = 0;  ///< asked by several threads
};

struct HyperelasticParameters {
  IsotropicElasticity elasticity;  ///< at small strain, of viscoelastic materials at rest [Pa]
  VolumetricForm volumetric = VolumetricForm::quadratic;
  double second_invariant = 0.0;             ///< mu_01/mu of mooney_rivlin, 0 to 1
  std::vector<double> shares{};              ///< of mu, of ogden and lopez_pamies; they sum to 1
  std::vector<double> exponents{};           ///< alpha_p, one per share; not zero
  std::vector<PronyBranch> branches{};       ///< in shear, and
  std::vector<PronyBranch> bulk_branches{};  ///< of volume changes; none: the material is elastic
  PronyDrive drive = PronyDrive::equilibrium;
  std::optional<TemperatureShift> shift{};  ///< of the branches' times; none: they do not depend on the temperature
  std::shared_ptr<const OwnStrainEnergy> own{};  ///< in place of that of a law
};

struct HyperelasticLaw {
  std::string_view name;
  double (*initial_stress)(const HyperelasticParameters&);  ///< p0 [Pa]
  ShearEnergy (*shear)(const HyperelasticParameters&, const Tensor& E);
  bool stiffens = true;  ///< N.(dP/dF).N varies with F by more than cof F and J
};

std::span<const HyperelasticLaw> hyperelastic_laws();
/// Throws InputError for an unknown name.
const HyperelasticLaw& hyperelastic_law(std::string_view name);
/// That of the parameters' own energy, which is no row of the table.
const HyperelasticLaw& own_hyperelastic_law();

/// Volume by the pressure q that the share c of U has.
struct VolumeAt {
  double change = 0.0;  ///< J - 1
  double slope = 0.0;   ///< dJ/dq [1/Pa]
};

class HyperelasticMaterial final : public Material {
 public:
  /// Throws InputError for shares that do not sum to 1 or are not as many as the exponents, an exponent of zero, and a
  /// second_invariant outside 0 to 1. Also for a Poisson's ratio above 0.47 for saint_venant_kirchhoff, which has no
  /// pressure, and parameters that make Lambda negative or the shear modulus not that of the elasticity; for branches
  /// of it, and branches that are not positive; for bulk branches with which Poisson's ratio could exceed 0.4. For an
  /// energy of one's own that is not isotropic at F = 1, and one with a volume energy of its own above a Poisson's
  /// ratio of 0.47.
  HyperelasticMaterial(const HyperelasticLaw& law, HyperelasticParameters parameters);

  const HyperelasticParameters& parameters() const { return p_; }
  bool is_finite_strain() const override { return true; }
  bool depends_on_rate() const override { return branches_.any(); }
  std::size_t history_size() const override { return branches_.size(); }
  const PronyLaw* relaxing() const override { return branches_.any() ? &prony_ : nullptr; }

  /// W and its derivatives. For laws whose shear part is not finite for every F the energy may be infinite or NaN where
  /// det F <= 0.
  PotentialAt potential(const Tensor& H) const { return potential_with(Lambda_, H, volume_change(H)); }
  /// W_s(C) - p0 ln J + U(J) where the volume J = 1 + `change` is another than det F, and its derivatives with those of
  /// J in the direction of cof F. For cells whose volume is not that of their mean gradient.
  PotentialAt potential(const Tensor& H, double change) const { return potential_with(Lambda_, H, change); }
  /// W_c = W(J^(1/3) 1) where J < 1, zero elsewhere, and its derivatives: the part that a split into volumetric (J >=
  /// 1) and isochoric energy keeps from damage.
  PotentialAt compression(const Tensor& H) const {
    return volume_change(H) < 0.0 ? dilation_of(Lambda_, H) : PotentialAt();
  }
  /// W_m, which has no share c of U, and its derivatives.
  PotentialAt moderate_potential(const Tensor& H) const { return moderate_potential(H, volume_change(H)); }
  PotentialAt moderate_potential(const Tensor& H, double change) const {
    return potential_with(Lambda_ - pressure_modulus_, H, change);
  }
  /// W_m(J^(1/3) 1) at any J, and its derivatives.
  PotentialAt moderate_dilation(const Tensor& H) const { return dilation_of(Lambda_ - pressure_modulus_, H); }
  /// Shear modulus of the tangent A at F, which has this lambda at F = 1: mu, or for laws that stiffen a mean over
  /// three directions [Pa].
  double shear_modulus(const Tensor& F, const GradientTangent& A, double lambda) const;
  /// c Lambda [Pa]; zero of materials that have no pressure.
  double pressure_modulus() const { return pressure_modulus_; }
  /// Shear modulus at small strain with all branches [Pa].
  double instantaneous_shear_modulus() const;
  /// Volume by the pressure q [Pa] of this modulus [Pa], that of the share c of U as it is degraded and relaxed.
  VolumeAt volume(double q, double modulus) const;
  /// u by J - 1: the pressure of a modulus is this times it.
  double volume_strain(double change) const;
  PronyDrive drive() const { return p_.drive; }
  /// The branches of a point of the material, and of cells, which have a pressure if the material needs one. Both are
  /// beside potential().
  const ViscousBranches& branches() const { return branches_; }
  const ViscousBranches& branches_of_cells() const { return branches_of_cells_; }
  /// lambda over mu of the branches of cells at small strain.
  double branch_ratio() const { return bulk_ratio_ - 2.0 / 3.0; }

  MaterialResponse update(const MaterialStep& step, std::span<double> history) const override;
  Tensor stress(const Tensor& H, std::span<const double> history) const override;
  /// Energies for the splits `none` and `volumetric_deviatoric`.
  MaterialEnergy energy(const Tensor& H, std::span<const double> history, const EnergySplit& split) const override;

 private:
  void check_own(const MandelMatrix& C) const;
  bool has_branches() const { return !p_.branches.empty() || !p_.bulk_branches.empty(); }
  void require_no_pressure() const;
  void choose_pressure(double shear_lambda);
  PotentialAt potential_with(double Lambda, const Tensor& H, double change) const;
  PotentialAt dilation_of(double Lambda, const Tensor& H) const;
  OfVolume volumetric(double Lambda, double change) const;
  OfVolume of_volume(double Lambda, double change) const;
  OfVolume dilation(double Lambda, double change) const;

  const HyperelasticLaw& law_;
  HyperelasticParameters p_;
  double p0_ = 0.0, Lambda_ = 0.0;  // [Pa]
  double pressure_modulus_ = 0.0;   // [Pa]
  PronyLaw prony_;
  double bulk_ratio_ = 0.0;
  ViscousBranches branches_, branches_of_cells_;
};

/// Throws InputError as the constructor does.
std::shared_ptr<const Material> make_hyperelastic(std::string_view law, HyperelasticParameters parameters);
/// Likewise, of the parameters' own energy.
std::shared_ptr<const Material> make_own_hyperelastic(HyperelasticParameters parameters);

}  // namespace pfdm
