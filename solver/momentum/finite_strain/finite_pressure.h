#pragma once
// Pressures q of nearly incompressible cells at finite strain: the moved faces that they act on (moved_faces.h), and
// their equations V J(q) = volume of the moved cell, linearised about the last displacements and pressures.

#include "solver/momentum/body/cell_pressure.h"
#include "solver/momentum/faces/face_skeleton.h"
#include "solver/momentum/faces/moved_faces.h"
#include "solver/momentum/finite_strain/finite_states.h"

namespace pfdm {

/// Moved faces as a sweep finds them; all but the gradients empty without pressures.
struct FinitePressureSweep {
  PressureField pressure;
  std::vector<Tensor> on_sides;      ///< gradients on sides that have their own (FiniteStates::own)
  std::vector<Vector> moved;         ///< by force: linearised displacement of the face [m]
  std::vector<Vector> corner_moves;  ///< of the points of moved faces [m]
  std::vector<Vector> area_changes;  ///< by force: of the moved area, over the undeformed one
  std::vector<double> flux;          ///< by force: volume that the face sweeps [m^3]
};

class FinitePressure {
 public:
  /// For use while all of these exist.
  FinitePressure(const FaceSkeleton& skeleton, const CellPressure& pressure, const FiniteStates& states);

  bool any() const { return pressure_.any(); }
  void prepare(FinitePressureSweep& s) const;
  /// Pressures, gradients on bonded sides, and displacements of the points, with these gradients of the cells.
  void read(const std::vector<Vector>& u, const CellField<Tensor>& gradients, FinitePressureSweep& s) const;
  void find_area_changes(const CellField<Tensor>& gradients, FinitePressureSweep& s) const;

  /// Weighs the points by the stiffness factors g of the cells; before read().
  void weigh(const CellField<double>& g) { moved_faces_.weigh(g); }
  /// Areas and pressures about which it is linearised, once the states are.
  void linearise(const FinitePressureSweep& s);
  /// Linearises the equations of the pressures about the displacements of s, with which the faces have moved by u_face
  /// (by force).
  void linearise_volumes(const std::vector<Vector>& u_face, FinitePressureSweep& s);

  /// Area vector of a force on which the pressure acts, over the undeformed area.
  const Vector& area(std::size_t force) const { return moved_faces_.area(force); }
  /// Area vector of a face as a cell sees it, outwards [m^2].
  Vector moved_area(const FaceSkeleton::SignedForce& on) const;
  double section(Index cell) const { return moved_faces_.section(cell); }
  double section_change(Index cell, const FinitePressureSweep& s) const {
    return moved_faces_.section_change(cell, s.corner_moves);
  }
  double linearised_at(Index cell) const { return pressure_at_[cell]; }  ///< q [Pa]; zero without

  /// Rows of the pressures, their constant part, and dJ/dq [1/Pa].
  void balance(FinitePressureSweep& s, std::vector<Vector>& out) const;
  void take_away_constant(std::vector<Vector>& load) const;
  double slope(std::size_t k) const { return rows_[k].slope; }
  /// J - 1 of the cells with a pressure [-], of faces that have moved by u_face, in the order of the forces.
  CellField<double> swept_changes(const std::vector<Vector>& u_face, FinitePressureSweep& s) const;

 private:
  // Equation of a pressure, J(q) = volume of the moved cell over the undeformed one, linearised.
  struct Row {
    double slope;    // dJ/dq [1/Pa]
    double initial;  // its constant part
  };
  bool has_polygon(std::size_t side) const;
  void find_fluxes(FinitePressureSweep& s) const;

  const FaceSkeleton& skeleton_;
  const CellPressure& pressure_;
  const FiniteStates& states_;
  MovedFaces moved_faces_;
  CellField<double> pressure_at_;
  std::vector<Row> rows_;
};

}  // namespace pfdm
