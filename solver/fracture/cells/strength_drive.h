#pragma once
// The external driving force of cells with a strength model (physics/materials/strength_model.h), and the energy that
// it takes. BodyStrength itself is that of a body without: nothing.
//
// Where damage evolves the elastic energy that it releases is -g'(d) psi_plus dd. The surface energy takes of it what
// the damage equation says; the rest, -(g(d) c + g'(d) (psi_plus - psi_open)) dd, is dissipated besides. In tension it
// is negative: the surface energy counts delta Gc, of which a crack dissipates Gc in all.

#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/momentum.h"

#include <functional>
#include <memory>

namespace pfdm {

class BodyStrength {
 public:
  /// An equilibrium, and the driving energy psi_plus of its cells [J/m^3].
  struct Seen {
    CellMechanics mechanics;
    CellField<double> psi_plus;
  };

  BodyStrength() = default;
  virtual ~BodyStrength() = default;
  BodyStrength(const BodyStrength&) = delete;
  BodyStrength& operator=(const BodyStrength&) = delete;

  /// Begins a step at a state, whose equilibrium is asked for only where strength is seen.
  virtual void begin(const FractureState&, const std::function<Seen()>&) {}
  /// Takes the driving force of the step to that of an equilibrium, with its psi_plus [J/m^3].
  virtual void see(const CellMechanics&, const FractureState&, const CellField<double>&) {}
  /// Gives to `take` the force c of the cells [J/m^3] at `scale` times the last equilibrium's displacements.
  virtual void give(double, const std::function<void(CellField<double>)>&) const {}
  /// psi_open of a cell [J/m^3], by psi_plus at `scale` times the last equilibrium's displacements.
  virtual double opening(Index, double psi_plus, double) const { return psi_plus; }
  /// Whether no energy opens a cell at the last equilibrium, while some is stored.
  virtual bool is_closed(Index) const { return false; }
  /// Dissipated besides the surface energy [J] since the step's start, while the damage went from one field to the
  /// other and the driving force with it: second order in the step.
  virtual double dissipation(const CellField<double>&, const CellField<double>&) const { return 0.0; }
};

/// Keeps references to all three.
std::unique_ptr<BodyStrength> make_body_strength(const Mesh& mesh, const FractureModel& model,
                                                 const CellStiffness& stiffness);

}  // namespace pfdm
