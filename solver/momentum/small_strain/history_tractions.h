#pragma once
// Tractions at small strain of bodies with a history (viscoelastic, plastic, endochronic cells), linearised within each
// solve: sigma = C eps + sigma_0 of the cell's strain. The gaps at its faces, by which a, b and c act
// (isotropic_tractions.h), are borne
//
// - by plastic and endochronic cells with the share of the moduli that the flow of the step leaves, and what is left of
//   earlier gaps; by polyhedra of these elastically. The converged solution does not depend on C, which may change with
//   the direction of the strain increment;
// - by relaxing materials, which are linear, as strains are: a, b and c are of the moduli that a change of strain
//   meets in the step, and what is left of earlier gaps is an initial traction of the side (history_stress.h). A body
//   that has relaxed is then the elastic one of the relaxed moduli with the same gradients. In plane stress gaps keep
//   the Poisson's ratio at once: the modulus along a face's normal is not linear in mu.
//
// As gaps are borne differences of the gradient on a side from that of its cell: on bonded sides, and where few layers
// bend, which have gradients along lines of cells, in plane meshes too (layer_gradients.h).
//
// Nearly incompressible cells have a pressure (cell_pressure.h): of p = K tr eps + p_0, with K and p_0 of C and
// sigma_0, it carries all but K_s tr eps, V (q - p_0)/(K - K_s) = sum u_f.S. In relaxing cells K_s = lambda_s + 2 mu/3
// relaxes as mu does. The mean stress is K tr eps + K_s (tr G - tr eps), tr eps being the volume change by the flux;
// what is left of earlier tr G in K_s is an initial stress of the cell, what is left of tr eps one of its pressure.

#include "solver/momentum/small_strain/history_stress.h"
#include "solver/momentum/small_strain/isotropic_tractions.h"

namespace pfdm {

class HistoryTractions final : public IsotropicTractions {
 public:
  HistoryTractions(const FaceSkeleton& skeleton, CellReconstruction& cells, const CellEigenstrain& eigenstrain)
      : IsotropicTractions(skeleton, cells.take_lines_alone(), eigenstrain) {}

  /// Sets the moduli as IsotropicTractions::set(), with the history of the body.
  void set(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part,
           HistoryStress history);

  void find_linear(const std::vector<Vector>& u, Sweep& sweep) const override;

 private:
  bool has_initial_stress() const override { return true; }
  Tensor initial_stress(Index cell) const override { return to_tensor(stress_[cell].initial); }
  Vector initial_traction(Index, const Vector&, std::size_t turn) const override { return initial_[turn]; }
  double free_volume_change(Index cell) const override;
  Vector own_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                      const IsotropicSweep& s) const override;
  double stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const override;
  void add_histories(const FaceMoves& moves, CellMechanics& result) const override;

  void give_to_pressures(const HistoryStress& history, const CellField<double>& g);
  void bear_gaps(const HistoryStress& history, const CellField<double>& g);
  void find_initial_tractions();
  void add_gaps(Index cell, const FaceMoves& moves, CellMechanics& result) const;
  // Adds to a gap, as strain, what the gradient on a side has beyond that of the cell.
  void add_strain_on_side(Index cell, const Vector& n, std::size_t turn, const Sweep& sweep, FaceGap& gap) const;
  template <class Visit>
  void visit_sides(Index cell, const Visit& visit) const;

  // Stiffness of the gaps of a relaxing cell along the normal of a face, over the shear and the bulk modulus. Zero for
  // other cells.
  struct GapStiffness {
    double by_shear = 0.0, by_bulk = 0.0;
  };
  GapStiffness gap_stiffness(Index cell, const HistoryStress& history) const;
  bool relaxes(Index cell) const { return gaps_.size() > 0 && gaps_[cell].by_shear > 0.0; }
  // K_s / mu of a cell with a pressure.
  double moderate_bulk(Index cell) const { return cells_.pressure().moderate_ratio(cell) + 2.0 / 3.0; }

  CellField<LinearStress> stress_;  // condensed in plane stress; less the pressure
  CellField<double> pressure_;      // p_0 [Pa]; empty without pressures
  CellField<GapStiffness> gaps_;    // empty without relaxing cells
  std::vector<Vector> initial_;     // tractions by turn, on the normals of links and sides [Pa]
};

}  // namespace pfdm
