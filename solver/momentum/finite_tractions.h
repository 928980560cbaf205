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
//   symbol              member, function
//   a, b                side_tensors_; LinkTensors::{weight, c, softness} of links
//   m, dm/dJ            Push: push_, capped_push(), side_push()
//   m ((c.y) I + c y^T) FaceTurn::turn;  dm/dJ (c.y) c  FaceTurn::swell;  q  FaceTurn::pressure

#include "physics/elasticity/gradient_stress.h"
#include "solver/momentum/bonded_sides.h"
#include "solver/momentum/cell_reconstruction.h"
#include "solver/momentum/face_tractions.h"
#include "solver/momentum/finite_law.h"
#include "solver/momentum/moved_faces.h"

namespace pfdm {

/// What a sweep of these tractions also finds.
struct FiniteSweep : Sweep {
  using Sweep::Sweep;
  // Of a cell, or of a bonded side, by its gradient H.
  struct Change {
    Tensor stress = Tensor::Zero(), cofactor = Tensor::Zero();  // A : H [Pa], and the change of cof F by H,
    double volume = 0.0;                                        // of J
  };
  PressureField pressure;
  std::vector<Tensor> bonded;  // gradients on bonded sides
  CellField<Change> changes;   // of the cells
  std::vector<Change> bonded_changes;
  // With pressures, else empty:
  std::vector<Vector> moved;         // by link: linearised displacement [m]
  std::vector<Vector> corner_moves;  // of the points of moved faces [m]
  std::vector<Vector> area_changes;  // by force: of the moved area, over the undeformed one
  std::vector<double> flux;          // by force: volume that the face sweeps [m^3]
};

class FiniteTractions final : public FaceTractions {
 public:
  FiniteTractions(const FaceSkeleton& skeleton, CellReconstruction& cells);

  /// Linearises about the displacements u, whose gradients `sweep` then has. g and `part` as of
  /// IsotropicTractions::set().
  void set(const FiniteLawAt& law, const CellField<double>& g, const std::vector<Vector>& u, double part, Sweep& sweep);

  const CellField<Tensor>& deformation() const { return F_; }       ///< F by least squares, at which it is linearised
  const CellField<Tensor>& cofactors() const { return cofactor_; }  ///< likewise
  CellField<double> face_stiffness() const;                         ///< a measure of a h [Pa]
  /// Whether a cell has lost all but this share of its stiffness.
  bool is_softer(Index cell, double share) const {
    const Unknowns& unknowns = skeleton_.unknowns;
    return laws_[cell].face.mu < share * unknowns.sound[as_size(unknowns.zone[cell])].mu;
  }

  void find_linear(const std::vector<Vector>& u, Sweep& sweep) const override;
  bool add_constant(Sweep& sweep) const override;
  void turn_springs(const Sweep& sweep, const std::vector<FaceSpring>& springs,
                    std::vector<Vector>& forces) const override;
  void balance_pressures(const std::vector<Vector>& u, Sweep& sweep, std::vector<Vector>& out) const override;
  void take_away_constant_volumes(std::vector<Vector>& load) const override;
  void find_pressure_forces(const CellField<double>& tension, Sweep& sweep) const override;
  Tensor compact_link(std::size_t link) const override;
  Tensor compact_side(std::size_t side) const override;
  double hoop_modulus(Index cell) const override;
  double shear_stiffness(Index cell) const override { return laws_[cell].face.mu; }
  Tensor softness_of_side(std::size_t side) const override { return side_tensors_[side].inverse(); }
  bool is_linearised() const override { return true; }
  CellMechanics mechanics(const std::vector<Vector>& u, bool with_gradient,
                          const CellField<IsotropicElasticity>& part) const override;

 private:
  using Change = FiniteSweep::Change;
  // m of a h = mu 1 + m c c^T, and dm/dJ.
  struct Push {
    double stiffness = 0.0, slope = 0.0;  // [Pa]
    Push operator/(double h) const { return {stiffness / h, slope / h}; }
  };
  // A cell, or a bonded side at the gradient on its surface, where it is linearised.
  struct State {
    FiniteLaw law;
    Tensor F, cofactor;
    Push push;
  };
  // What the traction on one side of a face changes by with its c = cof F N, turn dc, and the constant part of the
  // linearised traction.
  struct FaceTurn {
    Tensor turn;            // [Pa]
    Vector swell;           // by J [Pa]
    Vector initial;         // [Pa]
    double pressure = 0.0;  // on it, which acts on the moved area [Pa]
  };
  // Of a link where the jump has a stiffness other than that of the tractions: what that adds, likewise.
  struct JumpTurn {
    Tensor P, N;              // [Pa]
    Vector swell_P, swell_N;  // [Pa]
    Vector initial;           // [Pa]
  };
  // Equation of a pressure, J(q) = volume of the moved cell over the undeformed one, linearised.
  struct VolumeRow {
    double slope;    // dJ/dq [1/Pa]
    double initial;  // its constant part
  };
  static const FiniteSweep& of(const Sweep& sweep) { return static_cast<const FiniteSweep&>(sweep); }
  static FiniteSweep& of(Sweep& sweep) { return static_cast<FiniteSweep&>(sweep); }
  static Push push_of(const FiniteLaw& law, double J);
  static Push capped(double share, const FiniteLaw& law, const Push& push);

  std::unique_ptr<Sweep> new_sweep() const override;
  Vector link_displacement(std::size_t link, const std::vector<Vector>& u, const Sweep& sweep) const override;
  PressureRow pressure_row(std::size_t k) const override;

  // finite_linearisation.cpp
  void linearise_cells(const FiniteLawAt& law, const FiniteSweep& s);
  void set_face_tensors();
  void turn_link(std::size_t link, const std::vector<Vector>& u, const FiniteSweep& s);
  void turn_jump(std::size_t link, const Vector& jump, const FiniteSweep& s);
  void turn_side(std::size_t side, const std::vector<Vector>& u, const FiniteSweep& s);
  FaceTurn face_turn(Index cell, const Vector& n, const Vector& d, std::size_t turn, const Push& m, const Vector& y,
                     const FiniteSweep& s) const;
  void find_initial_sector_stress(const FiniteSweep& s);
  Vector true_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn, const FiniteSweep& s) const;
  Push capped_push(Index cell) const { return capped(jump_share_[cell], laws_[cell], push_[cell]); }
  Push side_push(std::size_t side) const;
  // a h
  Tensor acoustic(Index cell, const Vector& n) const;
  Tensor capped_acoustic(Index cell, const Vector& n) const;
  Tensor side_acoustic(std::size_t side) const;
  Tensor jump_tensor(const momentum_faces::Link& link, double h_P, double h_N) const;
  double stiffness_difference(const momentum_faces::Link& link) const;

  // finite_tractions.cpp
  void reconstruct(const std::vector<Vector>& u, FiniteSweep& s) const;
  void find_changes(FiniteSweep& s) const;
  Change change_of(const FiniteLaw& law, const Tensor& F, const Tensor& cofactor, const Tensor& H) const;
  Vector linear_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn, const FiniteSweep& s) const;
  Vector turned_jump(std::size_t link, const FiniteSweep& s) const;
  // Number of the bonded side that side number `turn` is; -1: none.
  Index bonded_at(std::size_t turn) const {
    return skeleton_.is_side(turn) ? bonded_.number(turn - 2 * skeleton_.links.size()) : -1;
  }
  const Change& change_at(Index cell, std::size_t turn, const FiniteSweep& s) const {
    const Index k = bonded_at(turn);
    return k < 0 ? s.changes[cell] : s.bonded_changes[as_size(k)];
  }
  const Tensor& true_stress_at(Index cell, std::size_t turn) const {
    const Index k = bonded_at(turn);
    return k < 0 ? laws_[cell].stress : bonded_states_[as_size(k)].law.stress;
  }
  const Tensor& cofactor_at(Index cell, std::size_t turn) const {
    const Index k = bonded_at(turn);
    return k < 0 ? cofactor_[cell] : bonded_states_[as_size(k)].cofactor;
  }
  // What the cell's displacement rises by to the centre of side number `turn` [m].
  Vector rise(Index cell, const Vector& d, std::size_t turn, const FiniteSweep& s) const {
    const Index k = bonded_at(turn);
    return (k < 0 ? s.gradients[cell] : s.bonded[as_size(k)]) * d;
  }

  // finite_pressure.cpp
  bool has_pressures() const { return cells_.pressure().any(); }
  bool has_polygon(std::size_t side) const;
  void place_areas();
  void find_area_changes(FiniteSweep& s) const;
  void find_fluxes(const std::vector<Vector>& u, FiniteSweep& s) const;
  void find_initial_volumes(const std::vector<Vector>& u, FiniteSweep& s);
  CellField<double> swept_changes(const std::vector<Vector>& u_face, FiniteSweep& s) const;
  std::vector<Vector> moves_of_faces(const std::vector<Vector>& u, const FaceField<Vector>& u_face) const;
  Vector moved_area(const FaceSkeleton::SignedForce& on) const;

  CellReconstruction& cells_;
  CellField<FiniteLaw> laws_;
  CellField<Tensor> F_, cofactor_;  // at which the laws are linearised
  CellField<Push> push_;
  CellField<double> initial_sector_;  // constant part of the stress across the sector [Pa]
  CellField<double> jump_share_;      // of polyhedra (polyhedral_jump.h)
  std::vector<FaceTurn> face_turns_;  // by turn
  std::vector<JumpTurn> jump_turns_;  // by link; empty where the jump's stiffness is that of the tractions
  std::vector<momentum_faces::LinkTensors> link_tensors_;
  std::vector<Tensor> side_tensors_;  // a [Pa/m]
  // Nearly incompressible cells:
  CellField<double> pressure_at_;  // q where it is linearised [Pa]; zero without
  BondedSides bonded_;             // also of cells with cubic faces, which count at small strain alone
  std::vector<State> bonded_states_;
  MovedFaces moved_faces_;
  std::vector<VolumeRow> volume_rows_;  // per pressure
};

}  // namespace pfdm
