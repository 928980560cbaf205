#pragma once
// Tractions at small strain of cells whose stress is a function of the strain (strain_law.h): energy splits without
// secant moduli, elasticity that depends on the direction. With y_P = u_f - u_P - G_P d_P and y_N = u_N + G_N d_N - u_f
// on the two sides of a face, the strains there are
//
//   eps_P = sym(G_P + y_P n^T/h_P),  eps_N = sym(G_N + y_N n^T/h_N),
//
// and u_f is where sigma(eps_P) n = sigma(eps_N) n: the least of h_P psi(eps_P) + h_N psi(eps_N), which is convex. It
// is found face by face, so that the tractions are continuous functions of the displacements. Linear ones about a
// strain of the cell's own jump where one of its principal strains changes sign, and have no equilibrium there.
//
// The balance is linear in the displacements, with a = (n.C.n)/h of the tangents C at these strains; it is exact where
// it was linearised. There are no pressures.
//
// Where few layers of hexahedra bend, G is that along lines of cells, in plane meshes too; surfaces have gradients of
// their own, and y_P + y_N is the jump with its weights (layer_gradients.h).

#include "physics/elasticity/linear_stress.h"
#include "solver/momentum/small_strain/small_tractions.h"
#include "solver/momentum/small_strain/strain_law.h"

namespace pfdm {

/// Result of a sweep of these tractions.
struct LawSweep : Sweep {
  using Sweep::Sweep;
  std::vector<Tensor> layers;  // by turn; empty without lines
};

class LawTractions final : public SmallTractions {
 public:
  LawTractions(const FaceSkeleton& skeleton, CellReconstruction& cells, const CellEigenstrain& eigenstrain)
      : SmallTractions(skeleton, cells.take_lines_alone(), eigenstrain) {}

  /// The law, linearised about the displacements u. The faces are found from where they were, or `afresh`. g and
  /// `part` as of IsotropicTractions::set().
  void set(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u, bool afresh, double part);
  /// Mean of the normal stiffness of each cell's faces: a measure of a h [Pa].
  CellField<double> side_stiffness() const;

  void find_linear(const std::vector<Vector>& u, Sweep& sweep) const override;
  bool add_constant(Sweep& sweep) const override;
  Tensor compact_link(std::size_t link) const override;
  Tensor compact_side(std::size_t side) const override;
  double hoop_modulus(Index cell) const override;
  double shear_stiffness(Index cell) const override { return stiffness_[cell].trace() / 15.0; }  // lambda = mu
  Tensor softness_of_side(std::size_t side) const override { return side_tensors_[side].inverse(); }
  bool is_linearised() const override { return true; }

 private:
  // One side of a face at its strain.
  struct SideLaw {
    Eigen::Matrix<double, 3, 6> rows;  // n.C: traction on n by the strain [Pa]
    Tensor acoustic;                   // n.C.n [Pa]
    Vector initial = Vector::Zero();   // traction without strain [Pa]
  };
  struct AtStrain {
    MandelMatrix C;                   // condensed in plane stress, as the
    Mandel initial = Mandel::Zero();  // stress without strain [Pa]
    Tensor strain;                    // with that across a plate
  };
  struct LinkBalance;

  static SideLaw side_law_of(const MandelMatrix& C, const Mandel& initial, const Vector& n);
  LinearStress linear_at(Index cell, const MandelMatrix& C) const;
  AtStrain law_at(Index cell, const Tensor& strain) const;
  SideLaw side_law(Index cell, const Tensor& strain, const Vector& n) const;
  SideLaw law_of_cell(Index cell, const Vector& n) const;
  void settle_link(std::size_t link, bool has_faces, const std::vector<Vector>& u, const LawSweep& s);
  void settle_side(std::size_t side, const std::vector<Vector>& u, const LawSweep& s);
  void set_free(SideLaw& law, std::size_t turn) const;
  void reconstruct(const std::vector<Vector>& u, LawSweep& s) const;
  // The gradient [-] from which the traction on a side of a face is computed.
  Tensor gradient_at(Index cell, std::size_t turn, const LawSweep& s) const {
    return cells_.layers().any() ? Tensor(s.gradients[cell] + s.layers[turn]) : s.gradients[cell];
  }
  // That of a law: less what the eigenstrain there has beyond that of the cell.
  Tensor strain_at(Index cell, std::size_t turn, const LawSweep& s) const {
    return symmetric_part(gradient_at(cell, turn, s)) - eigenstrain_change(turn);
  }
  // What a displacement of second order across uneven layers adds to the jump, by the difference of both gradients [m].
  Vector leaned(std::size_t link, const Tensor& difference) const {
    return cells_.layers().any() ? Vector(cells_.layers().lean(link) * (difference * skeleton_.links[link].n))
                                 : Vector(Vector::Zero());
  }
  // The jump at a link as the gaps bear it [m].
  Vector weighed(std::size_t link, const Vector& jump) const {
    return cells_.layers().any() ? Vector(cells_.layers().weight(link) * jump) : jump;
  }
  Vector idle(std::size_t turn, const FaceMoves& moves) const;
  static const LawSweep& of(const Sweep& sweep) { return static_cast<const LawSweep&>(sweep); }
  static LawSweep& of(Sweep& sweep) { return static_cast<LawSweep&>(sweep); }
  // Part that varies with the displacements [Pa].
  Vector linear_traction(std::size_t turn, const Tensor& G) const {
    return side_laws_[turn].rows * to_mandel(symmetric_part(G));
  }
  Vector link_displacement(std::size_t link, const std::vector<Vector>& u, const Sweep& sweep) const override;
  Tensor with_strain_across(Index cell, const Tensor& gradient) const override;
  double stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const override;
  double energy_of_part(Index cell, const IsotropicElasticity& part, const Tensor& strain,
                        const FaceMoves& moves) const override;
  std::unique_ptr<Sweep> new_sweep() const override;

  StrainLaw law_;
  CellField<MandelMatrix> stiffness_;  // at the strain of the cell [Pa]
  CellField<Tensor> initial_stress_;   // there, of eigenstrains [Pa]; empty without
  std::vector<SideLaw> side_laws_;     // by turn
  std::vector<momentum_faces::LinkTensors> link_tensors_;
  std::vector<Tensor> side_tensors_;  // a [Pa/m]
};

}  // namespace pfdm
