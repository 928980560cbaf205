#pragma once
// Fatigue: cycles of load lower the toughness of a damageable material from Gc to f(alpha_bar) Gc, where alpha_bar is
// the driving energy that loading has accumulated (Carrara, Ambati, Alessi, De Lorenzis, CMAME 361 (2020) 112731):
//
//   d alpha_bar/dt = H(d alpha/dt) |d alpha/dt|,   alpha = g(d) psi_plus.
//
// Unloading accumulates nothing. Up to the threshold alpha_T f = 1; beyond, with x = alpha_bar/alpha_T,
//
//   asymptotic    f = (2/(x + 1))^2
//   logarithmic   f = (1 - kappa log10 x)^2 up to x = 10^(1/kappa), then 0
//
// No f here is below 1e-6, so that the damage equation of a cell without toughness stays regular.

#include "physics/law_parameters.h"

#include <span>
#include <string_view>

namespace pfdm {

/// A row of the table of fatigue laws.
struct FatigueLaw {
  std::string_view name;
  std::string_view description;
  double (*factor)(double x, const LawParameters& p);  ///< f by x = alpha_bar/alpha_T from 1 on
  std::span<const LawParameter> parameters{};
};

/// A fatigue law with its threshold alpha_T [J/m^3] and its parameters.
class Fatigue {
 public:
  Fatigue() = default;  ///< none is chosen: f = 1
  Fatigue(const FatigueLaw& law, double threshold, const LawParameters& p) : law_(&law), threshold_(threshold), p_(p) {}

  bool is_chosen() const { return law_ != nullptr; }
  double threshold() const { return threshold_; }  ///< [J/m^3]
  /// f [-] at an accumulated driving energy [J/m^3].
  double factor(double energy) const;

 private:
  const FatigueLaw* law_ = nullptr;
  double threshold_ = 0.0;
  LawParameters p_{};
};

std::span<const FatigueLaw> fatigue_laws();
/// Throws InputError naming those there are.
const FatigueLaw& fatigue_law(std::string_view name);

}  // namespace pfdm
