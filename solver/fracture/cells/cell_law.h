#pragma once
// The stress of cells of small strain without a history: by their strain, and by what damage has left of them. One law
// a region, by its elasticity and its energy split (physics/damage/energy_split.h), or a cell where a region varies.

#include "solver/fracture/model/fracture_model.h"

#include <memory>

namespace pfdm {

class CellLaw {
 public:
  virtual ~CellLaw() = default;

  /// Whether there are isotropic secant moduli: sigma = stress(secant, eps).
  virtual bool has_secant() const { return false; }
  /// These, and the closure that belongs to a strain (energy_split.h); only of laws that have them.
  virtual IsotropicElasticity secant(double g, double closure) const;
  virtual double closure(const Tensor& strain) const;
  /// Whether damaged stiffnesses are others in compression.
  virtual bool depends_on_strain() const { return true; }
  /// d sigma/d eps [Pa] of the material degraded to g at a strain, or in its direction.
  virtual MandelMatrix tangent(const Tensor& strain, double g, double closure) const = 0;
  /// The part of the stress that damage degrades, before it does [Pa]; zero where `degradable_part` has it.
  virtual Tensor degradable_stress(const Tensor& strain) const = 0;
  /// The part of the stiffness that damage degrades, where it has isotropic moduli.
  virtual IsotropicElasticity degradable_part(double) const { return {}; }
  /// Energy that would drive damage at a mean strain [J/m^3].
  virtual double driving_energy(const Tensor& strain) const = 0;
};

/// CellLaw::degradable_part() of a split with secant moduli, which are linear in g.
IsotropicElasticity degradable_part_of(const EnergySplit& split, const IsotropicElasticity& elasticity, double closure);

std::unique_ptr<const CellLaw> make_cell_law(const FractureModel& model, const RegionModel& region);

}  // namespace pfdm
