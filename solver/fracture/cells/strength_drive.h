#pragma once
// The external driving force of cells with a strength model (physics/materials/strength_model.h), and the energy that
// it takes.
//
// Where damage evolves the elastic energy that it releases is -g'(d) psi_plus dd. The surface energy takes of it what
// the damage equation says; the rest, -(g(d) c + g'(d) (psi_plus - psi_open)) dd, is dissipated besides. In tension it
// is negative: the surface energy counts delta Gc, of which a crack dissipates Gc in all.

#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/momentum.h"

namespace pfdm {

/// External driving force of an equilibrium and its energy [J/m^3]. Both are empty without a strength model, and zero
/// in cells that have none.
struct StrengthDrive {
  CellField<double> force;   ///< c
  CellField<double> closed;  ///< psi_plus - psi_open
};

StrengthDrive strength_drive(const Mesh& mesh, const FractureModel& model, const CellStiffness& stiffness,
                             const CellMechanics& mechanics, const FractureState& state,
                             const CellField<double>& psi_plus);

/// Dissipated besides the surface energy [J] while the damage goes from one field to the other and the driving force
/// with it: second order in the step. `from` may be empty, of no load.
double strength_dissipation(const Mesh& mesh, const FractureModel& model, const StrengthDrive& from,
                            const StrengthDrive& to, const CellField<double>& d_from, const CellField<double>& d_to);

}  // namespace pfdm
