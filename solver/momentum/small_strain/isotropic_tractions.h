#pragma once
// Tractions at small strain of cells with isotropic moduli, which may be secants of damaged ones. With
//
//   a = (mu_P I + (lambda+mu)_P n n^T) / h_P,  b likewise for N,  c = a (a+b)^-1 b,
//   t = b (a+b)^-1 sigma_P n + a (a+b)^-1 sigma_N n + c J,  J = (u_N + G_N d_N) - (u_P + G_P d_P),
//
// G the least-squares gradients and d_P = x_f - x_P, all of a, b, c have two values, along n and across it. On
// orthogonal cells the normal gradients cancel and the exact series flux remains: a broken cell (g -> 0) disconnects
// its neighbours. The jump between polyhedra has another c (polyhedral_jump.h).
//
// Where few layers of hexahedra bend, sigma_P is that of the mean gradient over the face of a cubic fit, and G_P d_P
// the rise of that fit (cubic_faces.h), on interface and boundary faces too. In space G is that along lines of cells,
// and J has the weight W (layer_gradients.h); t_P is then that of a gap of b (a+b)^-1 W J.
//
// Nearly incompressible cells have an additional unknown, a pressure q, which is added to sigma at the face; everywhere
// else lambda_s replaces lambda (cell_pressure.h). Their rows are V (q / (lambda - lambda_s) + tr eps*) = sum u_f.S.
// Where all of the displacement is prescribed, the traction of hexahedra and prisms with a pressure has the tangential
// derivatives of that displacement in place of those of the cell, and twice the a (bonded_sides.h).

#include "physics/elasticity/plane_stress.h"
#include "solver/momentum/faces/bonded_sides.h"
#include "solver/momentum/faces/polyhedral_jump.h"
#include "solver/momentum/small_strain/small_tractions.h"

namespace pfdm {

/// The traction on n [Pa] of the gradient G in a cell with these moduli.
struct IsotropicStress {
  const CellField<IsotropicElasticity>& moduli;
  Vector operator()(Index cell, const Tensor& G, const Vector& n) const {
    const IsotropicElasticity& c = moduli[cell];
    return (c.lambda * G.trace()) * n + c.mu * (G * n + G.transpose() * n);
  }
  /// Traction where the gradient at a side is not that of the cell [Pa].
  Vector at_side(Index cell, const Tensor&, const Tensor& at_side, const Vector& n) const {
    return (*this)(cell, at_side, n);
  }
};

/// Result of a sweep of these tractions.
struct IsotropicSweep : Sweep {
  using Sweep::Sweep;
  std::vector<CubicFaces::Change> cubic;  // by turn; empty without fits
  std::vector<Tensor> layers;             // by turn; empty without lines
  PressureField pressure;
  std::vector<Tensor> bonded;  // gradients on bonded sides
  std::vector<double> flux;    // by force: u_f.S [m^3]; empty without pressures
  CellField<Tensor> stress;    // by the cells' gradients [Pa], of bodies with a history; else empty
};

class IsotropicTractions : public SmallTractions {
 public:
  /// Cells that have gradients of third order do without the care for bonded sides.
  IsotropicTractions(const FaceSkeleton& skeleton, CellReconstruction& cells, const CellEigenstrain& eigenstrain);

  /// Secant moduli of every cell, and the stiffness factors g that weight the gradients; the weights are updated only
  /// where g has changed by more than the fraction `part`.
  void set(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part);

  void find_linear(const std::vector<Vector>& u, Sweep& sweep) const override;
  bool add_constant(Sweep& sweep) const override;
  void balance_pressures(const std::vector<Vector>& u, Sweep& sweep, std::vector<Vector>& out) const override;
  void take_away_constant_volumes(std::vector<Vector>& load) const override;
  void find_pressure_forces(const CellField<double>& tension, Sweep& sweep) const override;
  Tensor compact_link(std::size_t link) const override;
  Tensor compact_side(std::size_t side) const override;
  double hoop_modulus(Index cell) const override { return moduli_[cell].constrained_modulus(); }
  double shear_stiffness(Index cell) const override { return moduli_[cell].mu; }
  Tensor softness_of_side(std::size_t side) const override;

  /// The gradient [-] from which the traction on a side of a face is computed.
  Tensor gradient_at(Index cell, std::size_t turn, const Sweep& sweep) const;
  /// Gap of a side: its displacement less that of the cell, `move`, beyond the cell's own rise [m]; without the part of
  /// the jump that has no weight.
  Vector gap(Index cell, const Vector& d, std::size_t turn, const Vector& move, const std::vector<Vector>& u,
             const Sweep& sweep) const;
  /// b (a + b)^-1 v of a link.
  Vector weigh(std::size_t link, const Vector& v) const {
    const LinkValues& by = link_values_[link];
    return momentum_faces::scale(by.weight_n, by.weight_t, skeleton_.links[link].n, v);
  }
  /// (a + b)^-1 v of a link.
  Vector give(std::size_t link, const Vector& v) const;
  Vector link_displacement(std::size_t link, const std::vector<Vector>& u, const Sweep& sweep) const override;

 protected:
  virtual bool has_initial_stress() const { return eigenstrain_.any(); }
  virtual Tensor initial_stress(Index cell) const { return initial_stress_[cell]; }  // [Pa]
  // Initial traction on n of side number `turn` of the cell [Pa].
  virtual Vector initial_traction(Index cell, const Vector& n, std::size_t turn) const;
  // N's less P's on a link [Pa].
  Vector initial_jump(std::size_t link) const {
    const momentum_faces::Link& on = skeleton_.links[link];
    return initial_traction(on.N, on.n, FaceSkeleton::turn_N(link)) -
           initial_traction(on.P, on.n, FaceSkeleton::turn_P(link));
  }
  // Volume change [-] of a cell whose pressure is zero.
  virtual double free_volume_change(Index cell) const { return to_tensor(eigenstrain_[cell]).trace(); }
  // stress_of(cell, G, n): the traction on n of the gradient G [Pa]; stress_of.at_side(cell, G, at_side, n) where the
  // gradient at a side is another one than G of the cell.
  template <class StressOf>
  void sweep_faces(const std::vector<Vector>& u, IsotropicSweep& s, const StressOf& stress_of) const;
  // Traction on side number `turn`, at the distance d from the cell's centre [Pa].
  template <class StressOf>
  Vector traction(Index cell, const Vector& n, const Vector& d, std::size_t turn, const IsotropicSweep& s,
                  const StressOf& stress_of) const {
    Vector stress = varies_at(turn) ? stress_of.at_side(cell, s.gradients[cell], gradient_at(cell, turn, s), n)
                                    : stress_of(cell, s.gradients[cell], n);
    if (cells_.pressure().any()) stress += s.pressure.at(cell, d) * n;
    return stress;
  }
  // Traction on side number `turn` with the stress of these cells [Pa].
  virtual Vector own_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                              const IsotropicSweep& s) const;
  // `sound`: undamaged moduli, empty: those of the zones; `relaxes`: cells that relax, whose `sound` is
  // that of the step; empty: none.
  void set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g,
                  const CellField<IsotropicElasticity>& sound, const CellField<char>& relaxes);
  void set_coefficients();
  Tensor with_strain_across(Index cell, const Tensor& gradient) const override;
  double stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const override;
  double energy_of_part(Index cell, const IsotropicElasticity& part, const Tensor& strain,
                        const FaceMoves& moves) const override;
  std::unique_ptr<Sweep> new_sweep() const override;
  PressureRow pressure_row(std::size_t k) const override;

  static const IsotropicSweep& of(const Sweep& sweep) { return static_cast<const IsotropicSweep&>(sweep); }
  static IsotropicSweep& of(Sweep& sweep) { return static_cast<IsotropicSweep&>(sweep); }
  // Number of the bonded side that side number `turn` is; -1: none.
  Index bonded_at(std::size_t turn) const {
    return skeleton_.is_side(turn) ? bonded_.number(turn - 2 * skeleton_.links.size()) : -1;
  }
  // Whether the gradient at side number `turn` may be another one than the cell's.
  bool varies_at(std::size_t turn) const {
    return cells_.cubic().any() || cells_.layers().any() || bonded_at(turn) >= 0;
  }
  // a over that of sides that are not bonded.
  double stiffer_at(std::size_t turn) const { return bonded_at(turn) < 0 ? 1.0 : BondedSides::stiffer; }
  const CellField<IsotropicElasticity>& moduli() const { return moduli_; }
  const CellField<IsotropicElasticity>& of_stress() const { return of_stress_; }
  double jump_modulus(Index cell) const { return jump_.modulus(cell, moduli_[cell]); }

  CellField<StrainAcross> strain_across_;  // of plane stress, else empty

 private:
  // Values of a link: the weight of sigma_P in the traction (that of sigma_N completes it to 1); c, and c as the jump
  // has it.
  struct LinkValues {
    double weight_n = 0.0, weight_t = 0.0;
    double c_n = 0.0, c_t = 0.0;        // [Pa/m]
    double jump_n = 0.0, jump_t = 0.0;  // [Pa/m]
  };
  struct SideValues {
    double a_n = 0.0, a_t = 0.0;  // [Pa/m]
  };
  void condense();
  void find_initial_stress();
  LinkValues values_of(std::size_t link) const;
  SideValues values_of_side(std::size_t side) const;
  void reconstruct(const std::vector<Vector>& u, IsotropicSweep& s) const;
  // Gradient of the cell, or of the surface on which side number `turn` is bonded.
  const Tensor& mean_gradient_at(Index cell, std::size_t turn, const IsotropicSweep& s) const {
    const Index k = bonded_at(turn);
    return k < 0 ? s.gradients[cell] : s.bonded[k];
  }
  // Rise of the cell's displacement to the centre of side number `turn` [m].
  Vector rise(Index cell, const Vector& d, std::size_t turn, const IsotropicSweep& s) const {
    Vector linear = mean_gradient_at(cell, turn, s) * d;
    if (cells_.cubic().any()) linear += s.cubic[turn].rise;
    return linear;
  }
  Vector pull_jump(std::size_t link, const Vector& jump) const {
    const LinkValues& by = link_values_[link];
    const Vector& n = skeleton_.links[link].n;
    return cells_.layers().any() ? momentum_faces::scale(by.jump_n, by.jump_t, n, cells_.layers().weight(link) * jump)
                                 : momentum_faces::scale(by.jump_n, by.jump_t, n, jump);
  }
  double link_flux(std::size_t link, const Vector& u_P, const Vector& jump, const Vector& stress_jump,
                   const IsotropicSweep& s) const;
  // Distance [m] by which a change of strain moves a surface with a gradient of its own farther out than the faces
  // between cells, whose tractions are those of the cells' mean gradients.
  double lag(std::size_t side, const Tensor& change) const;
  double side_flux(std::size_t side, const Vector& u_f, const IsotropicSweep& s) const;

  CellField<IsotropicElasticity> moduli_;     // as faces and preconditioner have them, and
  CellField<IsotropicElasticity> of_stress_;  // the cells' stress, which leaves more of closed cracks to the pressure
  PolyhedralJump jump_;
  BondedSides bonded_;
  CellField<Tensor> initial_stress_;  // -C eps* [Pa], condensed in plane stress; empty without eigenstrains
  std::vector<LinkValues> link_values_;
  std::vector<SideValues> side_values_;
};

}  // namespace pfdm
