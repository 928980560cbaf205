#pragma once
// Degradation functions g(d): how much of the tensile energy a damaged material keeps. g(0) = 1, g(1) = 0; the
// residual stiffness k enters in one place, g_k = (1 - k) g + k.

#include "physics/damage/softening_law.h"
#include "physics/law_parameters.h"

#include <span>
#include <string_view>

namespace pfdm {

/// A row of the table of degradation functions.
struct DegradationLaw {
  std::string_view name;
  std::string_view description;
  bool needs_strength;  ///< takes its parameters from a softening law, a strength and a toughness
  double (*g)(double d, const LawParameters& p);
  double (*g_prime)(double d, const LawParameters& p);
  double (*g_second)(double d, const LawParameters& p);
  std::span<const LawParameter> parameters{};
};

/// A degradation function with its parameters.
class Degradation {
 public:
  Degradation() = default;  ///< none is chosen
  explicit Degradation(const DegradationLaw& law) : Degradation(law, default_values(law.parameters)) {}
  Degradation(const DegradationLaw& law, const LawParameters& p) : law_(&law), p_(p) {}

  bool is_chosen() const { return law_ != nullptr; }
  const DegradationLaw& law() const { return *law_; }
  std::string_view name() const { return law_->name; }
  double g(double d) const { return law_->g(d, p_); }
  double g_prime(double d) const { return law_->g_prime(d, p_); }
  double g_second(double d) const { return law_->g_second(d, p_); }

 private:
  const DegradationLaw* law_ = nullptr;
  LawParameters p_{};
};

/// The rational one with the coefficients of a softening law.
Degradation rational_degradation(const RationalCoefficients& c);

std::span<const DegradationLaw> degradations();
/// Throws InputError naming those there are.
const DegradationLaw& degradation_law(std::string_view name);
/// Degradation with the default values of its parameters. Throws InputError naming those there are.
Degradation degradation(std::string_view name);

}  // namespace pfdm
