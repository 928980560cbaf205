#pragma once
// Tractions at finite strain (total Lagrangian), linearised about the last displacements: normals N, areas and
// distances are those of the reference mesh, sigma is the first Piola-Kirchhoff stress P(H) at the least-squares
// displacement gradients H, and
//
//   a = (mu I + (lambda + mu/J^2) c c^T) / h,  c = cof F N,
//
// the acoustic tensor N.(dP/dF).N of the neo-Hookean law, with a mean shear modulus of the tangent for the others. It
// is objective, positive definite for any F, and smooth. The factor FiniteLaw::swelling of mu/J^2 is 0 of broken cells,
// whose law is linear in F. In plane stress F is that within the plane, and the laws are condensed already.
//
// With y_P = u_f - u_P - H_P d_P and y_N = u_N + H_N d_N - u_f on the two sides of a face,
//
//   t = tau_P + a y_P = tau_N + b y_N,  tau = P(H) N + q s,
//
// s being the area vector of the moved face over the undeformed area, one for both cells (moved_faces.h). A change of
// F, in cells whose a turns with c = cof F N, adds m ((c.y) I + c y^T) dc + dm/dJ (c.y) c dJ + q ds to tau,
// m = (lambda + mu phi(J))/h. The balance is linear in the displacements, with these as they were at the last ones; its
// constant part makes it exact there. Pressures have V J(q) = volume of the moved cell, linearised likewise.
//
// Where few layers of hexahedra bend, H is that along lines of cells, in plane meshes too; surfaces have gradients of
// their own, and the jump y_P + y_N of t has weights (layer_gradients.h, turned_weights.h).
//
// Viscoelastic cells have an initial traction of earlier gaps y on their faces besides (finite_memory.h).
//
//   symbol              member, function
//   a, b                side_tensors_; LinkTensors::{weight, c, softness} of links
//   m, dm/dJ            FiniteStates::Push
//   m ((c.y) I + c y^T) FaceTurn::turn;  dm/dJ (c.y) c  FaceTurn::swell;  q  FaceTurn::pressure

#include "solver/momentum/body/cell_eigenstrain.h"
#include "solver/momentum/faces/cell_reconstruction.h"
#include "solver/momentum/faces/cell_sums.h"
#include "solver/momentum/faces/face_tractions.h"
#include "solver/momentum/finite_strain/finite_memory.h"
#include "solver/momentum/finite_strain/finite_pressure.h"
#include "solver/momentum/finite_strain/finite_states.h"
#include "solver/momentum/finite_strain/turned_weights.h"

namespace pfdm {

/// Result of a sweep of these tractions.
struct FiniteSweep : Sweep, FinitePressureSweep {
  using Sweep::Sweep;
  std::vector<Tensor> layers;  // by turn; empty without lines
  FiniteStates::Changes changes;
};

class FiniteTractions final : public FaceTractions {
 public:
  FiniteTractions(const FaceSkeleton& skeleton, CellReconstruction& cells, const CellEigenstrain& eigenstrain);

  /// Linearises about the displacements u, whose gradients `sweep` then has. g and `part` as of
  /// IsotropicTractions::set(); gaps: what is left of earlier ones (FiniteMemory::set).
  void set(const FiniteLawAt& law, const std::vector<GapStress>& gaps, const CellField<double>& g,
           const std::vector<Vector>& u, double part, Sweep& sweep);
  /// F by least squares and what follows from it, where it is linearised.
  const FiniteStates& states() const { return states_; }
  bool remembers() const { return memory_.any(); }  ///< some cell is viscoelastic

  void find_linear(const std::vector<Vector>& u, Sweep& sweep) const override;
  bool add_constant(Sweep& sweep) const override;
  void turn_springs(const Sweep& sweep, const std::vector<FaceSpring>& springs,
                    std::vector<Vector>& forces) const override;
  void balance_pressures(const std::vector<Vector>&, Sweep& sweep, std::vector<Vector>& out) const override {
    pressure_.balance(of(sweep), out);
  }
  void take_away_constant_volumes(std::vector<Vector>& load) const override { pressure_.take_away_constant(load); }
  void find_pressure_forces(const CellField<double>& tension, Sweep& sweep) const override;
  Tensor compact_link(std::size_t link) const override;
  Tensor compact_side(std::size_t side) const override;
  double hoop_modulus(Index cell) const override;
  double shear_stiffness(Index cell) const override { return states_.law(cell).face.mu; }
  Tensor softness_of_side(std::size_t side) const override { return side_tensors_[side].inverse(); }
  bool has_third_order() const override { return cells_.layers().any(); }
  bool is_linearised() const override { return true; }
  CellMechanics mechanics(const std::vector<Vector>& u, bool with_gradient,
                          const CellField<IsotropicElasticity>& part) const override;

 private:
  using Change = FiniteStates::Change;
  using Push = FiniteStates::Push;
  // Change of the traction on one side of a face with its c = cof F N, turn dc, and the constant part of the linearised
  // traction.
  struct FaceTurn {
    Tensor turn;            // [Pa]
    Vector swell;           // by J [Pa]
    Vector initial;         // [Pa]
    double pressure = 0.0;  // on it, which acts on the moved area [Pa]
  };
  // Change of the traction of a link where the jump has a stiffness other than that of the tractions, and its constant
  // part.
  struct JumpTurn {
    Tensor P, N;              // [Pa]
    Vector swell_P, swell_N;  // [Pa]
    Vector initial;           // [Pa]
  };
  static const FiniteSweep& of(const Sweep& sweep) { return static_cast<const FiniteSweep&>(sweep); }
  static FiniteSweep& of(Sweep& sweep) { return static_cast<FiniteSweep&>(sweep); }

  std::unique_ptr<Sweep> new_sweep() const override;
  Vector link_displacement(std::size_t link, const std::vector<Vector>& u, const Sweep& sweep) const override;
  PressureRow pressure_row(std::size_t k) const override;
  void reconstruct(const std::vector<Vector>& u, FiniteSweep& s) const;
  void find_changes(FiniteSweep& s) const;
  Vector linear_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn, const FiniteSweep& s) const;
  Vector turned_jump(std::size_t link, const FiniteSweep& s) const;
  // Rise of the cell's displacement to the centre of side number `turn` [m].
  Vector rise(Index cell, const Vector& d, std::size_t turn, const FiniteSweep& s) const {
    const Index k = states_.bonded_at(turn);
    return (k < 0 ? s.gradients[cell] : s.on_sides[k]) * d;
  }

  // Distance [m] by which a free surface with a gradient of its own lies farther out than the faces between cells,
  // whose tractions are those of the cells' mean gradients.
  Vector lag(std::size_t side, const Tensor& stress_on_side, const Tensor& stress_of_cell) const;
  // Moves of the faces with these pressures, in the order of the forces, by a sweep [m].
  std::vector<Vector> moves_of_faces(const FiniteSweep& s) const;

  // finite_linearisation.cpp
  void set_face_tensors();
  void turn_link(std::size_t link, const std::vector<Vector>& u, const FiniteSweep& s);
  void turn_jump(std::size_t link, const Vector& jump, const FiniteSweep& s);
  void turn_side(std::size_t side, const std::vector<Vector>& u, const FiniteSweep& s);
  FaceTurn face_turn(Index cell, const Vector& n, const Vector& d, std::size_t turn, const Push& m, const Vector& y,
                     const FiniteSweep& s) const;
  Vector true_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn, const FiniteSweep& s) const;
  void find_initial_sector_stress(const FiniteSweep& s);
  void linearise_volumes(const std::vector<Vector>& u, FiniteSweep& s);
  // Change of what is left of earlier gaps, and its value.
  void remember(Index cell, const Vector& c, std::size_t turn, FaceTurn& by) const;
  Vector remembered(Index cell, const Vector& n, std::size_t turn) const;
  // finite_mechanics.cpp
  // What of the gradient's variation along a line of a cell is elastic.
  Tensor elastic_spread(Index cell, Index line, const CellField<Tensor>& gradients) const;
  void find_within_layers(const CellField<Tensor>& gradients, CellMechanics& result) const;
  void add_work_of_moments(CellMechanics& result) const;
  void add_gaps(const FaceMoves& moves, CellMechanics& result) const;
  Vector gap(Index cell, const Vector& d, std::size_t turn, const Vector& move, const FaceMoves& moves) const;

  CellReconstruction& cells_;
  const CellEigenstrain& eigenstrain_;
  FiniteStates states_;
  FinitePressure pressure_;
  TurnedWeights weights_;
  FiniteMemory memory_;
  CellField<double> initial_sector_;  // constant part of the stress across the sector [Pa]
  std::vector<FaceTurn> face_turns_;  // by turn
  std::vector<JumpTurn> jump_turns_;  // by link; empty where the jump's stiffness is that of the tractions
  std::vector<momentum_faces::LinkTensors> link_tensors_;
  std::vector<Tensor> side_tensors_;   // a [Pa/m]
  std::vector<Vector> moved_initial_;  // by force: constant part of the faces' moves [m]; empty without pressures
};

}  // namespace pfdm
