#pragma once
// Strength as a property of its own, beside elasticity and toughness: a driving force of damage that is not the
// derivative of an energy (Kumar, Bourdin, Francfort, Lopez-Pamies, J. Mech. Phys. Solids 142 (2020) 104027; Larsen,
// Dolbow, Lopez-Pamies, Int. J. Fract. 247 (2024) 319). AT1, with g = (1 - d)^2:
//
//   delta Gc/(c0 ell) alpha'(d) + g'(d) psi_open - g(d) c - div((2 delta Gc ell/c0) grad d) = 0,
//
// psi_open = psi_plus where the undamaged stress has tr sigma >= 0, else 0; c [J/m^3] is a linear function of the
// invariants of that stress. Its coefficients, which depend on ell, are such that a sound cell begins to break at the
// strengths, whatever ell. In other directions of stress it does so on a surface that tends to the given one as ell ->
// 0. The factor delta has a long crack dissipate Gc. At finite strain the stress is Biot's and the energies at the
// strengths are those of the material's own law (Kumar, Lopez-Pamies, J. Mech. Phys. Solids 150 (2021) 104359).

#include "physics/elasticity/elasticity.h"

#include <memory>
#include <span>
#include <string_view>

namespace pfdm {

class Material;

/// Data of a material for its strength model.
struct StrengthData {
  IsotropicElasticity elasticity;
  double tensile = 0.0;      ///< strength in uniaxial tension [Pa]
  double hydrostatic = 0.0;  ///< strength in hydrostatic tension [Pa]; more than a third of the tensile one
  double Gc = 0.0;           ///< [J/m^2]
  double ell = 0.0;          ///< [m]
  /// Hyperelastic: the strengths are Biot stresses; null: linear elastic.
  std::shared_ptr<const Material> material{};
};

/// Energy densities of the undamaged material [J/m^3].
struct StrengthEnergies {
  double tensile = 0.0;      ///< at the strength in uniaxial tension
  double hydrostatic = 0.0;  ///< at that in hydrostatic tension
};
/// Throws InputError if a hyperelastic material does not reach a strength.
StrengthEnergies energies_at_strengths(const StrengthData& data);

/// c = by_shear sqrt(J2) + by_trace tr(sigma), of dimension one [J/m^3 per Pa].
struct StrengthCoefficients {
  double by_shear = 0.0;
  double by_trace = 0.0;
};

/// A row of the table of strength models.
struct StrengthLaw {
  std::string_view name;
  std::string_view description;
  std::string_view crack;  ///< its crack geometric function
  /// The tr(sigma) and sqrt(J2) for which this is 1 are the strength surface; of degree one.
  double (*surface)(const StrengthData&, double trace, double sqrt_J2);
  /// delta on a mesh of size h [m] that is taken into account, 0: none.
  double (*delta)(const StrengthData&, double h);
  StrengthCoefficients (*coefficients)(const StrengthData&, double delta);
};

/// The strength in hydrostatic tension of a Drucker-Prager surface [Pa], compressive > tensile > 0.
double hydrostatic_strength(double tensile, double compressive);

/// 3 Gc/(16 W), W the energy density at the tensile strength: ell has to be smaller [m]. Throws InputError as
/// energies_at_strengths does.
double largest_length(const StrengthData& data);

/// A strength model with its parameters.
class StrengthModel {
 public:
  StrengthModel() = default;  ///< none
  /// Throws InputError for strengths that no surface has.
  StrengthModel(const StrengthLaw& law, const StrengthData& data, double delta);

  bool is_chosen() const { return law_ != nullptr; }
  const StrengthLaw& law() const { return *law_; }
  const StrengthData& data() const { return data_; }
  double delta() const { return delta_; }
  /// c [J/m^3] at the undamaged stress [Pa]; here and below Biot's at finite strain.
  double force(const Tensor& sigma) const;
  /// Whether psi_plus drives damage at the undamaged stress.
  static bool opens(const Tensor& sigma) { return sigma.trace() >= 0.0; }
  /// Undamaged stress over the strength surface: 1 on it.
  double surface(const Tensor& sigma) const;

 private:
  const StrengthLaw* law_ = nullptr;
  StrengthData data_{};
  double delta_ = 1.0;
  StrengthCoefficients coefficients_{};
};

std::span<const StrengthLaw> strength_laws();
/// Throws InputError naming those there are.
const StrengthLaw& strength_law(std::string_view name);

}  // namespace pfdm
