#pragma once
// Cells at finite strain where their laws are linearised, and on sides that have a gradient of their own, bonded ones
// and surfaces of layers that bend, the laws at that gradient; the stiffness of their faces,
//
//   a h = mu I + m c c^T,  m = lambda + mu phi(J),  c = cof F N,
//
// phi = FiniteLaw::swelling / J^2. With the shares of lambda + 2 mu of polyhedral_jump.h it is "capped": m of
// undeformed polyhedra is that of lambda_s.

#include "physics/elasticity/gradient_stress.h"
#include "physics/elasticity/mandel.h"
#include "solver/momentum/bending/layer_gradients.h"
#include "solver/momentum/faces/bonded_sides.h"
#include "solver/momentum/faces/face_skeleton.h"
#include "solver/momentum/finite_strain/finite_law.h"

namespace pfdm {

class FiniteStates {
 public:
  /// m of a face, over its distance from the cell's centre or times one, and dm/dJ.
  struct Push {
    double stiffness = 0.0, slope = 0.0;  ///< [Pa]
    Push operator/(double h) const { return {stiffness / h, slope / h}; }
  };
  /// Change of a cell by a gradient H, or of a side that has a gradient of its own.
  struct Change {
    Tensor stress = Tensor::Zero();    ///< A : H [Pa]
    Tensor cofactor = Tensor::Zero();  ///< of cof F [-]
    double volume = 0.0;               ///< of J [-]
  };
  /// Changes of all cells and of all sides that have a gradient of their own.
  struct Changes {
    CellField<Change> of_cell;
    std::vector<Change> on_side;
  };

  /// For use while the skeleton exists.
  FiniteStates(const FaceSkeleton& skeleton, const LayerGradients& layers);

  /// Extrapolates these eigenstrains, empty: none, so that each surface of layers that bend has that of the line of
  /// cells beneath it.
  void extrapolate(const LayerGradients& layers, const CellField<Mandel>& eigenstrains);
  /// About these gradients of the cells, and on the sides that have their own.
  void linearise(const FiniteLawAt& law, const CellField<Tensor>& gradients, const std::vector<Tensor>& on_sides);
  /// The changes by these gradients.
  void find_changes(const CellField<Tensor>& gradients, const std::vector<Tensor>& on_sides, Changes& changes) const;

  const BondedSides& bonded() const { return bonded_; }
  /// Number of the bonded side that side number `turn` is; -1: none.
  Index bonded_at(std::size_t turn) const { return skeleton_.is_side(turn) ? bonded_.number(side_at(turn)) : -1; }
  /// Sides with a gradient of their own: the bonded ones, in their order, then the surfaces.
  std::size_t n_own() const { return own_sides_.size(); }
  std::size_t side_of_own(std::size_t k) const { return own_sides_[k]; }
  /// Number of a side among them; -1: it is none.
  Index own(std::size_t side) const { return own_of_side_.empty() ? -1 : own_of_side_[side]; }
  /// Cells of the sides with a gradient of their own, in their order.
  std::vector<Index> cells_of_own() const;
  /// The gradient H of one of them as the law of its cell sees it, whose eigenstrain is the cell's.
  Tensor as_law_sees(std::size_t own, const Tensor& H) const;
  const FiniteLaw& law(Index cell) const { return laws_[cell]; }
  /// As side number `turn` sees it.
  const FiniteLaw& law_at(Index cell, std::size_t turn) const {
    const Index k = own_at(turn);
    return k < 0 ? laws_[cell] : side_states_[k].law;
  }
  const CellField<Tensor>& deformation() const { return F_; }
  const CellField<Tensor>& cofactors() const { return cofactor_; }
  const Tensor& deformation_on(Index own) const { return side_states_[own].F; }
  /// Stress, cofactor and change as side number `turn` sees them: of the cell, or of the side's own gradient.
  const Tensor& stress_at(Index cell, std::size_t turn) const {
    const Index k = own_at(turn);
    return k < 0 ? laws_[cell].stress : side_states_[k].law.stress;
  }
  const Tensor& cofactor_at(Index cell, std::size_t turn) const {
    const Index k = own_at(turn);
    return k < 0 ? cofactor_[cell] : side_states_[k].cofactor;
  }
  const Change& change_at(Index cell, std::size_t turn, const Changes& changes) const {
    const Index k = own_at(turn);
    return k < 0 ? changes.of_cell[cell] : changes.on_side[k];
  }

  /// m and dm/dJ times h.
  const Push& push(Index cell) const { return push_[cell]; }
  Push capped_push(Index cell) const { return capped(jump_share_[cell], laws_[cell], push_[cell]); }
  Push side_push(std::size_t side) const;
  /// m of what is left of earlier gaps, over mu, and dm/dJ; capped in polyhedra (finite_memory.h).
  Push memory_push(Index cell, std::size_t turn) const;
  /// Share of the stiffness along the normals that a cell's jumps keep.
  double jump_share(Index cell) const { return jump_share_[cell]; }
  /// Factor of a on a side: more than 1 on bonded ones.
  double stiffer_at(std::size_t turn) const { return skeleton_.is_side(turn) ? stiffer(side_at(turn)) : 1.0; }
  /// a h [Pa].
  Tensor acoustic(Index cell, const Vector& n) const;
  Tensor capped_acoustic(Index cell, const Vector& n) const;
  Tensor side_acoustic(std::size_t side) const;
  /// c [Pa/m]: the stiffness of both sides in series; between polyhedra that of the capped ones, blended back to the
  /// full one where the stiffness of the cells differs.
  Tensor jump_tensor(const momentum_faces::Link& link, double h_P, double h_N) const;
  /// theta: 0 between cells of equal stiffness, to 1.
  double stiffness_difference(const momentum_faces::Link& link) const;
  /// Whether the jump of a link has a stiffness other than that of the tractions.
  bool is_capped(const momentum_faces::Link& link) const {
    return jump_share_[link.P] < 1.0 || jump_share_[link.N] < 1.0;
  }
  CellField<double> face_stiffness() const;  ///< a measure of a h [Pa]
  /// Whether a cell has lost all but this share of its stiffness.
  bool is_softer(Index cell, double share) const {
    const Unknowns& unknowns = skeleton_.unknowns;
    return laws_[cell].face.mu < share * laws_[cell].sound_share * unknowns.sound[unknowns.zone[cell]].mu;
  }
  /// J over that of the free deformation.
  double elastic_volume(Index cell) const { return F_[cell].determinant() / (1.0 + laws_[cell].free_change); }

 private:
  struct SideState {
    FiniteLaw law;
    Tensor F, cofactor;
    Push push;
  };
  std::size_t side_at(std::size_t turn) const { return turn - 2 * skeleton_.links.size(); }
  Index own_at(std::size_t turn) const { return skeleton_.is_side(turn) ? own(side_at(turn)) : -1; }
  double stiffer(std::size_t side) const { return bonded_.number(side) < 0 ? 1.0 : BondedSides::stiffer; }
  FiniteLaw law_on_side(const FiniteLawAt& law, std::size_t own, const Tensor& H) const;
  static Push push_of(const FiniteLaw& law, double J);
  static Push capped(double share, const FiniteLaw& law, const Push& push);

  const FaceSkeleton& skeleton_;
  CellField<FiniteLaw> laws_;
  CellField<Tensor> F_, cofactor_;
  CellField<Push> push_;
  CellField<double> jump_share_;
  BondedSides bonded_;
  std::vector<std::size_t> own_sides_;
  std::vector<Index> own_of_side_;
  std::vector<SideState> side_states_;
  std::vector<Tensor> relative_;  // of each of them: F*^-1 of the side times F* of its cell; empty: all alike
};

}  // namespace pfdm
