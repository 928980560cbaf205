#pragma once
// A material as the field solver sees it: from deformation and history of a point to stress, tangent and energies, all
// of the undamaged material. What damage degrades, and what the energy split keeps, is the solver's. Deformations are
// displacement gradients H = F - 1 and stresses first Piola-Kirchhoff stresses P, so that finite strain has the same
// interface; laws of small strain look at the symmetric part of H (small_strain_material.h).
//
// A history is a list of numbers whose meaning is the law's own; the solver copies and stores it.

#include "physics/damage/energy_split.h"
#include "physics/elasticity/gradient_stress.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

struct PronyLaw;

struct MaterialStep {
  Tensor from;                      ///< H at the start of the step [-]
  Tensor to;                        ///< H at its end [-]
  double duration = 0.0;            ///< of the step [s], over a_T of materials whose times shift
  std::span<const double> history;  ///< at its start
};

struct MaterialResponse {
  Tensor stress = Tensor::Zero();                     ///< P at the end of the step [Pa]
  GradientTangent tangent = GradientTangent::Zero();  ///< consistent with the step
  bool solved = true;                                 ///< false: no finite solution
};

/// Energies per volume [J/m^3].
struct MaterialEnergy {
  double driving = 0.0;               ///< psi_plus: what drives damage
  double idle = 0.0;                  ///< stored and degraded, but without part in driving: heat where damage frees it
  double locked = 0.0;                ///< stored besides the elastic energy, as by hardening
  double dissipated = 0.0;            ///< as heat, since the virgin state
  Tensor inelastic = Tensor::Zero();  ///< the part of H that is not elastic [-]; zero at finite strain
};

/// Numbers of a history that results show, by their name there: a symmetric tensor in Mandel components if there are
/// six.
struct HistoryField {
  std::string_view name;
  std::string_view unit;
  std::size_t first = 0;
  std::size_t size = 1;
};

class Material {
 public:
  Material(std::string_view name, const IsotropicElasticity& elasticity) : name_(name), elasticity_(elasticity) {}
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;
  virtual ~Material() = default;

  std::string_view name() const { return name_; }                        ///< of the law
  const IsotropicElasticity& elasticity() const { return elasticity_; }  ///< of the virgin state
  /// Whether P is that of F itself; else the law looks at the symmetric part of H alone.
  virtual bool is_finite_strain() const { return false; }
  /// Whether the response depends on the duration of a step, which must then be positive.
  virtual bool depends_on_rate() const { return false; }
  /// Elasticity that is left after any time under a strain that is held.
  virtual IsotropicElasticity relaxed_elasticity() const { return elasticity_; }
  /// Whether pressure and volume change are linear in each other over a step, p = K tr eps + p_0, whatever the deviator
  /// does. Nearly incompressible cells of such a law have p as an unknown.
  virtual bool has_linear_volume() const { return false; }
  /// The moduli of a law that is linear and relaxes; null: another one.
  virtual const PronyLaw* relaxing() const { return nullptr; }

  /// Whether it flows: strains beyond the elastic ones stay, as plastic ones.
  virtual bool flows() const { return false; }
  /// Share of a small deviatoric stress on top of that of the step which the flow of the step leaves, as of the stress
  /// itself: 1 without flow, above 0. `history` is that at the end of the step.
  virtual double left_by_flow(const MaterialStep&, std::span<const double> /*history*/) const { return 1.0; }

  virtual std::size_t history_size() const = 0;
  virtual void start(std::span<double> history) const { std::ranges::fill(history, 0.0); }  ///< the virgin state
  virtual std::vector<HistoryField> history_fields() const { return {}; }

  /// Writes the history at the end of the step.
  virtual MaterialResponse update(const MaterialStep& step, std::span<double> history) const = 0;
  virtual Tensor stress(const Tensor& H, std::span<const double> history) const = 0;  ///< P [Pa]
  virtual MaterialEnergy energy(const Tensor& H, std::span<const double> history, const EnergySplit& split) const = 0;

 private:
  std::string_view name_;
  IsotropicElasticity elasticity_;
};

}  // namespace pfdm
