#pragma once
// What damage leaves of a cell at finite strain, and the energies of which it leaves that (finite_cells.h).

namespace pfdm {

/// What damage has left of a cell: its stiffness factor g, and how closed its crack is (crack_closures.h). Both are
/// held while equilibrium is found.
struct Degraded {
  double g = 1.0, closure = 0.0;
};

/// The energies of a cell at some displacements, each of which has its share by the damage [J/m^3].
struct FiniteEnergies {
  double moderate = 0.0, network = 0.0, pressure = 0.0;
  double branches = 0.0;         ///< of viscoelastic materials, degraded as the moderate one
  bool branches_drive = false;   ///< the damage
  double locked = 0.0;           ///< stored in gaps beyond half the work of their tractions, likewise
  double dilation = 0.0;         ///< W_c, where compression does not drive the damage
  double taken = 0.0;            ///< there, the share of it that does not
  double closure = 0.0;          ///< the share of the pressure's that does not
  double faces = 0.0, of = 1.0;  ///< energy of the faces, at the g with which the displacements were found
  /// Share of the energies of faces, and of what a pressure is lost by faster than W_m, that drives the damage: less
  /// than 1 where branches do not.
  double drive = 1.0;
  double moments = 0.0;  ///< of the moments of the faces, where these do not drive the damage
};

}  // namespace pfdm
