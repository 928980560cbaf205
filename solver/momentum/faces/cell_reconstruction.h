#pragma once
// Variation of displacements within the cells: gradients of one ring (solver/scalar/gradient.h), faces of third order
// and lines of cells where few layers bend, and the pressures of nearly incompressible cells.

#include "solver/momentum/bending/cubic_faces.h"
#include "solver/momentum/bending/layer_gradients.h"
#include "solver/momentum/body/cell_pressure.h"
#include "solver/momentum/faces/face_skeleton.h"
#include "solver/scalar/gradient.h"

namespace pfdm {

class CellReconstruction {
 public:
  explicit CellReconstruction(const FaceSkeleton& skeleton);

  /// Prepares bodies of flat cells that bend, as plates: layers of hexahedra without cubic faces then have the
  /// gradients of layer_gradients.h, other flat cells weaker jump terms (polyhedral_jump.cpp).
  void relax_flat_cells();
  bool relaxes_flat_cells() const { return relaxes_flat_cells_; }
  /// Prepares tractions by one gradient a cell, as at finite strain: lines of cells in plane meshes too, in place of
  /// cubic faces. Returns itself.
  CellReconstruction& take_lines_alone();

  /// The weights of the gradients of one ring by the stiffness factors g, where these have changed by more than this
  /// fraction.
  void weigh(const CellField<double>& g, double part) { gradient_.update(g, part); }
  void weigh_third_order(const CellField<double>& g);
  void weigh_pressures(const CellField<double>& g) { pressure_.weigh(g); }
  void take_over(CellField<IsotropicElasticity>& moduli, const CellField<double>& g,
                 const CellField<IsotropicElasticity>& sound, const CellField<char>& relaxes) {
    pressure_.take_over(moduli, g, sound, relaxes);
  }
  void bear_closed_cracks(CellField<IsotropicElasticity>& of_stress) { pressure_.bear_closed_cracks(of_stress); }

  /// Gradients of one ring [-], with the hoop strain about an axis.
  void find_gradients(const std::vector<Vector>& u, CellField<Tensor>& gradients) const;

  const Gradient& gradient() const { return gradient_; }
  const CubicFaces& cubic() const { return cubic_; }
  const LayerGradients& layers() const { return layers_; }
  const CellPressure& pressure() const { return pressure_; }
  /// Both cells have fits or lines, or the jump has a weight of its own.
  bool is_of_third_order(std::size_t link) const;

 private:
  const FaceSkeleton& skeleton_;
  Gradient gradient_;
  CubicFaces cubic_;       // its sides are numbered by turn,
  LayerGradients layers_;  // and so are these
  CellPressure pressure_;
  bool relaxes_flat_cells_ = false, has_lines_alone_ = false;
};

}  // namespace pfdm
