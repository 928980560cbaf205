#pragma once
// The momentum balance on cell-centred finite volumes with two-sided faces. Both cells of a face reconstruct its
// traction, and the face displacement is the one at which the two agree, so traction is continuous for any moduli:
//
//   a = (mu_P I + (lambda+mu)_P n n^T) / h_P,  b likewise for N,  c = a (a+b)^-1 b,
//   t = b (a+b)^-1 sigma_P n + a (a+b)^-1 sigma_N n + c J,  J = (u_N + G_N d_N) - (u_P + G_P d_P),
//
// with G the least-squares gradients and d_P = x_f - x_P. On orthogonal cells the normal gradients cancel and the exact
// series flux remains: a broken cell (g -> 0) disconnects its neighbours. Faces between elastic zones and on the
// boundary carry u_f itself: each side has t_c = sigma_c n + a_c (u_f - u_c - G_c d_c).
//
// Where few layers of hexahedra bend at small strain, sigma_P is that of the mean gradient over the face of a cubic
// fit, and G_P d_P the rise of that fit (cubic_faces.h), on interface and boundary faces too. In space G is that along
// lines of cells, and J has the weight W (layer_gradients.h); t_P is then that of a gap of b (a+b)^-1 W J.
//
// Axisymmetric meshes (a sector one cell wide): the gradient also has the hoop strain u_r / r, and the two faces of the
// sector act on the cell with the hoop stress sigma_phi: -2 sin(half the angle) A sigma_phi along r.
//
// General stiffness C: the same with a = (n.C.n) / h, the acoustic tensor of the face normal, as a full 3x3 tensor.
//
// A stress that depends on the strain: C is that of the strain eps = sym(G + (u_f - u_c - G d) n^T / h) on each side of
// a face, and u_f is where the true tractions of both sides agree (momentum_law.cpp).
//
// A material with a history is linearised within each solve, sigma = C eps + sigma_0, for the stresses only: a, b and c
// remain those of its elastic moduli. The converged solution therefore does not depend on C, which may change with the
// direction of the strain increment.
//
// Polyhedra have about 14 faces against three unknowns: with a of the full lambda the jump terms lock as nu -> 0.5.
// Their c uses lambda_s = min(lambda, 1.5 mu) in the undamaged material, and the same fraction of lambda + 2 mu in a
// damaged one, blended back to the full one between cells of different damage:
// c = c(lambda_s) + theta (c(lambda) - c(lambda_s)), theta = 1 - min(mu_P, mu_N)/max(mu_P, mu_N). The weights of
// sigma_P and sigma_N keep the full lambda. On tetrahedra a smaller c would not converge. Polyhedra of general
// stiffness C keep the full a.
//
// Closed cracks in polyhedra: where the split keeps lambda, a broken cell has no shear stiffness (mu << lambda).
// Tangential displacements that alternate between such polyhedra have gradients without divergence, but cause forces on
// skew faces; without stabilisation they grow without bounds. Such cells therefore use the full c, and c_t + 0.05 c_n
// along the face between two of them in the jump term, which vanishes for a slip that is linear over the cells.
//
// Nearly incompressible cells have an additional unknown, a pressure q, which is added to sigma at the face; everywhere
// else lambda_s replaces lambda (cell_pressure.h).
//
// Where all of the displacement is prescribed, the traction of hexahedra and prisms with a pressure has the tangential
// derivatives of that displacement in place of those of the cell, and twice the a, at small and at finite strain
// (bonded_sides.h).
//
// Eigenstrains eps*, one per cell (thermal expansion, misfit): the stress is C (eps - eps*), and each side of a face
// has the initial traction -n.C eps*, so that tractions agree across a face also where eps* jumps. Pressures have V (q
// / (lambda - lambda_s) + tr eps*) = sum u_f.S.
//
// Split faces: each side has a node and a traction of its own, t_P and t_N as above, and a law of their separation
// joins them, t_P = T(u_f,N - u_f,P) = -t_N. It is linearised within each solve, T = K (u_f,N - u_f,P) + T_0. At
// finite strain T also turns with the two sides, that is with c = cof F N of both cells.
//
// Periodic faces: the image has no unknown of its own, but the displacement of its node plus what is prescribed between
// the two, and its forces act on that node: t_P + t_N = 0 as on an interface, whose sides lie at different places.
//
// Free strains E of a box move its held faces by E (x - x_0), x_0 its centre, and the images of its nodes by
// E (x_image - x_node); the work of the forces on these moves, by E, is the mean stress times the volume: that is their
// equation.
//
// Finite strain (total Lagrangian; momentum_finite.cpp): normals N, areas and distances are those of the reference
// mesh, sigma is the first Piola-Kirchhoff stress P(H) at the displacement gradients H of the same least squares, and
//
//   a = (mu I + (lambda + mu/J^2) c c^T) / h,  c = cof F N,
//
// the acoustic tensor N.(dP/dF).N of the neo-Hookean law, with a mean shear modulus of the tangent for the others. It
// is objective, positive definite for any F, and smooth; its derivative is part of the linearised balance. The factor
// FiniteLaw::swelling of mu/J^2 is 0 of broken cells, whose law is linear in F. In plane stress F is that within the
// plane. Pressures act on the area vector of the moved face, one for both cells, and V J(q) is the volume of the moved
// cell (moved_faces.h).
//
// Plane stress: the stiffness is condensed to zero stress across the plate; in all of the above, C, lambda and sigma_0
// are those of physics/elasticity/plane_stress.h. The strain across the plate is added to that of the displacements,
// at finite strain by the laws of the cells.

#include "physics/elasticity/gradient_stress.h"
#include "physics/elasticity/plane_stress.h"
#include "solver/linear/block_matrix.h"
#include "solver/momentum/bonded_sides.h"
#include "solver/momentum/cell_mechanics.h"
#include "solver/momentum/cell_pressure.h"
#include "solver/momentum/cubic_faces.h"
#include "solver/momentum/finite_law.h"
#include "solver/momentum/layer_gradients.h"
#include "solver/momentum/momentum_faces.h"
#include "solver/momentum/moved_faces.h"
#include "solver/momentum/pressed_faces.h"
#include "solver/momentum/strain_law.h"
#include "solver/momentum/unknowns.h"
#include "solver/scalar/gradient.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace pfdm {

class MomentumOperator {
 public:
  MomentumOperator(const Mesh& mesh, const Unknowns& unknowns);

  /// Secant moduli of every cell, and the stiffness factors g that weight the gradients; the weights are updated only
  /// where g has changed by more than this fraction.
  /// Where `stress` is given, it replaces the stress of the moduli in every cell.
  void set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part = 0.0,
                  CellField<LinearStress> stress = {});
  /// For bodies of flat cells that bend, as plates; before set_moduli(). Layers of hexahedra without cubic faces then
  /// have the gradients of layer_gradients.h, other flat cells weaker jump terms (momentum_jump.cpp).
  void relax_flat_cells();
  /// A stress by the strain, linearised about the displacements u; being of first degree, it is exact there. The faces
  /// are found from where they were, or `afresh`.
  void set_law(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u, bool afresh, double part = 0.0);
  bool has_law() const { return static_cast<bool>(law_); }
  CellField<double> side_stiffness() const;  ///< a measure of a h with such a law [Pa]

  /// Finite strain: the balance linearised about the displacements u, and pressures on patches about the load parameter
  /// t. There it is exact. In plane stress the laws are condensed already.
  void set_finite(const FiniteLawAt& law, const CellField<double>& g, const std::vector<Vector>& u, double t,
                  double part = 0.0);
  bool is_finite() const { return finite_.size() > 0; }
  /// In some cells: cubic_faces.h, at finite strain in none; layer_gradients.h.
  bool is_of_third_order() const { return (cubic_.any() && !is_finite()) || layers_.any(); }
  const CellField<Tensor>& deformation() const { return F_; }       ///< F by least squares, at which it is linearised
  const CellField<Tensor>& cofactors() const { return cofactor_; }  ///< likewise
  CellField<double> face_stiffness() const;                         ///< a measure of a h at finite strain [Pa]
  /// Whether it has lost all but this share of its stiffness.
  bool is_softer(Index cell, double share) const {
    return finite_[cell].face.mu < share * unknowns_.sound[as_size(unknowns_.zone[cell])].mu;
  }

  /// The eigenstrains of the body at the load parameter t, or none; before set_moduli() and set_law(). Returns whether
  /// they have changed.
  bool set_eigenstrain(std::optional<double> t);
  const CellField<Mandel>& eigenstrain() const { return eigenstrain_; }  ///< of now [-]; empty: none
  /// Twice the energy that the eigenstrains of now would store in the undamaged body if nothing moved, at finite strain
  /// by its elasticity at small strain [J].
  double energy_if_held() const;

  const std::vector<FaceSpring>& springs() const { return springs_; }
  /// In the order of the split faces.
  void set_springs(std::vector<FaceSpring> springs) { springs_ = std::move(springs); }
  /// load += the forces of the springs' offsets, [N].
  void add_spring_offsets(std::vector<Vector>& load) const;
  /// Separation of the sides of split face number k [m].
  Vector separation(std::size_t k, const std::vector<Vector>& u) const {
    const SplitFace& face = split_faces_[k];
    return u[as_size(face.beyond)] - u[as_size(face.node)];
  }

  /// What each side of the split faces does about the displacements u, in their order.
  struct SplitSides {
    Vector traction, traction_beyond;  ///< outwards from the owner, from the neighbour [Pa]
    Tensor give, give_beyond;          ///< a^-1: displacement of the side by its traction [m/Pa]
  };
  std::vector<SplitSides> split_sides(const std::vector<Vector>& u) const;
  /// Moves the sides of split face number k.
  void part(std::size_t k, const Vector& move, const Vector& move_beyond, std::vector<Vector>& u) const {
    u[as_size(split_faces_[k].node)] += move;
    u[as_size(split_faces_[k].beyond)] += move_beyond;
  }

  /// out = A u, [N]: minus the sum of forces on each cell; the free part of the forces on each face node; for each
  /// pressure V q / (lambda - lambda_s) - sum u_f.S [m^3]. Without initial stresses.
  void apply(const std::vector<Vector>& u, std::vector<Vector>& out) const;
  /// Forces from prescribed tractions, pressures and body forces at the load parameter t [N]; pressures on the areas of
  /// the last linearisation.
  std::vector<Vector> traction_forces(double t) const;
  /// The same with those from initial stresses, [N].
  std::vector<Vector> load_vector(double t) const;
  /// Writes the prescribed components of the boundary nodes at the load parameter t.
  void prescribe(double t, std::vector<Vector>& u) const;
  /// Removes the component across the plane of a plane mesh.
  void keep_in_plane(std::vector<Vector>& v) const;
  /// Gives images of periodic nodes what their nodes have, in a v without free strains.
  void move_images(std::vector<Vector>& v) const;

  /// The compact symmetric matrix for the preconditioner of A: c between cells, a from a cell to its face nodes. It is
  /// diagonal in what is prescribed and in the direction across a plane mesh.
  BlockTriplets compact_matrix() const;
  /// Approximate diagonal of the Schur complement, per pressure [m^3/Pa].
  std::vector<double> pressure_compliance() const;
  /// r -= the forces of the pressures q (stored among the unknowns) on the nodes.
  void take_away_pressure_forces(const std::vector<Vector>& q, std::vector<Vector>& r) const;

  enum class Wanted { all, without_gradient };
  /// `part`: of the stiffness of each cell, whose energy is wanted.
  CellMechanics mechanics(const std::vector<Vector>& u, Wanted wanted = Wanted::all,
                          const CellField<IsotropicElasticity>& part = {}) const;
  std::vector<Vector> boundary_forces(const std::vector<Vector>& u) const;  ///< per boundary face [N]
  /// Traction [Pa] on each interior face that carries a node, on its owner.
  std::vector<std::pair<Index, Vector>> interface_tractions(const std::vector<Vector>& u) const;
  /// On every face along its normal [Pa]; zero on the faces of plane and axisymmetric patches.
  FaceField<Vector> tractions(const std::vector<Vector>& u) const;
  std::vector<Vector> patch_displacements(const std::vector<Vector>& u) const;  ///< per patch, area mean [m]

 private:
  friend class StiffnessCoupling;
  using Link = momentum_faces::Link;
  using Side = momentum_faces::Side;
  using SplitFace = momentum_faces::SplitFace;
  using LinkTensors = momentum_faces::LinkTensors;
  using SideLaw = momentum_faces::SideLaw;
  using FaceTurn = momentum_faces::FaceTurn;
  using Push = momentum_faces::Push;
  using JumpTurn = momentum_faces::JumpTurn;
  using VolumeRow = momentum_faces::VolumeRow;
  using BondedLaw = momentum_faces::BondedLaw;
  struct SignedForce {
    Index force;
    double sign;
  };

  // (across I + (along - across) n n^T) v for a unit normal n.
  static Vector scale(double along, double across, const Vector& n, const Vector& v) {
    return across * v + ((along - across) * n.dot(v)) * n;
  }

  // A cell whose centre lies almost in the plane of its face would be too stiff.
  static double bounded_height(const Vector& d, const Vector& n) {
    return std::max(std::abs(d.dot(n)), 1e-3 * d.norm());
  }

  void add_links();
  void add_sides();
  void list_forces_of_cells();
  std::vector<CubicFaces::Side> sides_by_turn() const;
  std::vector<MovedFaces::Place> places_by_force() const;
  Vector turned_spring(std::size_t k) const;
  void pull_by_springs(const std::vector<Vector>& u, std::vector<Vector>& out) const;
  // Forces of the displacements, of the initial stresses, and of both, into forces_.
  void compute_linear_forces(const std::vector<Vector>& u) const;
  void add_initial_forces() const;
  void compute_forces(const std::vector<Vector>& u) const;
  void sum_forces(std::vector<Vector>& out) const;
  double prescribed_slope(const SpinHold& hold, double t) const;
  double shear_stiffness(Index cell) const;
  void resist_spin(const SpinHold& hold, double much, std::vector<Vector>& v) const;
  void hold_spins(std::vector<Vector>& out) const;
  void add_spin_targets(double t, std::vector<Vector>& load) const;
  void add_free_part(std::vector<Vector>& forces, std::vector<Vector>& out) const;
  void gather_from_images(std::vector<Vector>& forces) const;
  void work_on_free_strains(std::vector<Vector>& out) const;
  Vector place(Index face_node) const {
    return mesh_.face_centre[unknowns_.face_of_node[as_size(face_node - unknowns_.n_cells)]];
  }
  void take_away_initial_forces(std::vector<Vector>& load) const;
  void take_away_initial_volumes(std::vector<Vector>& load) const;
  void find_initial_stress();
  double link_flux(std::size_t i, const Vector& u_P, const Vector& jump, const Vector& stress_jump) const;
  double side_flux(const Side& side, const Vector& u_f) const;
  void balance_pressures(std::vector<Vector>& out) const;
  bool has_linear_stress() const { return linear_stress_.size() > 0; }
  bool is_isotropic() const { return stiffness_.size() == 0 && !is_finite(); }
  bool has_eigenstrain() const { return eigenstrain_.size() > 0 && !is_finite(); }
  bool has_initial_stress() const { return has_linear_stress() || is_finite() || has_eigenstrain(); }
  // On the P side, the N side of a link, or on a side: `turn` is its number among face_turns_.
  Vector initial_traction(Index cell, const Vector& n, std::size_t turn) const {
    if (is_finite()) return face_turns_[turn].initial;
    return has_law() ? side_laws_[turn].initial : (initial_stress(cell) * n).eval();
  }
  Tensor initial_stress(Index cell) const {
    return has_linear_stress() ? to_tensor(linear_stress_[cell].initial) : initial_stress_[cell];
  }
  static std::size_t turn_P(std::size_t link) { return 2 * link; }
  static std::size_t turn_N(std::size_t link) { return 2 * link + 1; }
  std::size_t turn_of_side(std::size_t side) const { return 2 * links_.size() + side; }
  struct AtStrain {
    MandelMatrix C;                   // condensed in plane stress, as the
    Mandel initial = Mandel::Zero();  // stress without strain [Pa]
    Tensor strain;                    // with that across a plate
  };
  AtStrain law_at(Index cell, const Tensor& strain) const;
  SideLaw side_law(Index cell, const Tensor& strain, const Vector& n) const;
  struct LinkBalance;
  void settle_link(std::size_t i, bool has_faces, const std::vector<Vector>& u);
  std::size_t turn_at(const SignedForce& on) const {
    const auto i = as_size(on.force);
    return i >= links_.size() ? turn_of_side(i - links_.size()) : (on.sign > 0.0 ? turn_P(i) : turn_N(i));
  }
  // a h, of cells that are not isotropic.
  Tensor acoustic(Index cell, const Vector& n) const;
  Tensor capped_acoustic(Index cell, const Vector& n) const;
  Push capped_push(Index cell) const;
  Push side_push(std::size_t side) const;
  Tensor side_acoustic(std::size_t side) const;
  Tensor jump_tensor(const Link& link, double h_P, double h_N) const;
  double stiffness_difference(const Link& link) const;
  void set_face_tensors();
  void reconstruct(const std::vector<Vector>& u) const;
  void find_gradients(const std::vector<Vector>& u) const;
  // Of finite strain.
  // Of a cell, or of a bonded side: the true and the linearised stress [Pa], the cofactor and what changes it.
  struct FiniteAt {
    const Tensor &true_stress, &stress, &cofactor, &cofactor_change;
    double volume_rate;
  };
  FiniteAt finite_at(Index cell, std::size_t turn) const {
    const Index k = bonded_at(turn);
    if (k < 0)
      return {finite_[cell].stress, stresses_[cell], cofactor_[cell], cofactor_change_[cell], volume_rate_[cell]};
    const BondedLaw& by = bonded_laws_[as_size(k)];
    return {by.law.stress, by.stress, by.cofactor, by.cofactor_change, by.volume_rate};
  }
  // Number of the bonded side that side number `turn` is; -1: none.
  Index bonded_at(std::size_t turn) const {
    return turn >= 2 * links_.size() ? bonded_.number(turn - 2 * links_.size()) : -1;
  }
  // a over that of sides that are not bonded.
  double stiffer_at(std::size_t turn) const { return bonded_at(turn) < 0 ? 1.0 : BondedSides::stiffer; }
  std::size_t force_at(std::size_t turn) const { return turn < 2 * links_.size() ? turn / 2 : turn - links_.size(); }
  void find_bonded_gradients(const std::vector<Vector>& u) const;
  MovedFaces::Field field(const std::vector<Vector>& u) const { return {u, gradients_, bonded_gradients_}; }
  void set_bonded_laws(const FiniteLawAt& law);
  Vector true_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn) const;
  FaceTurn face_turn(Index cell, const Vector& n, const Vector& d, std::size_t turn, const Push& m,
                     const Vector& y) const;
  void place_moved_faces();
  bool has_polygon(std::size_t side) const;
  void find_area_changes() const;
  CellField<double> swept_changes(const std::vector<Vector>& u_face) const;
  void turn_link(std::size_t i, const std::vector<Vector>& u);
  void turn_jump(std::size_t i, const Vector& jump);
  void turn_side(std::size_t i, const std::vector<Vector>& u);
  void find_initial_sector_stress();
  void find_linear_stresses() const;
  Vector turned_jump(std::size_t i) const;
  Vector linear_face_displacement(std::size_t i, const Vector& u_P, const Vector& jump,
                                  const Vector& stress_jump) const;
  void find_finite_fluxes(const std::vector<Vector>& u) const;
  double flux_out_of(Index cell) const;
  std::vector<Vector> moves_of_faces(const std::vector<Vector>& u, const FaceField<Vector>& u_face) const;
  Vector moved_area(const SignedForce& on) const;
  void balance_finite_pressures(const std::vector<Vector>& u, std::vector<Vector>& out) const;
  void find_initial_volumes(const std::vector<Vector>& u);
  void find_pressure_forces(const CellField<double>& tension) const;
  void find_finite_pressure_forces(const CellField<double>& q) const;
  Vector moved_with(Index cell, Index face, const std::vector<Vector>& u) const;
  Vector normal_stress(Index cell, const Vector& n) const { return normal_stress(cell, gradients_[cell], n); }
  Vector normal_stress(Index cell, const Tensor& G, const Vector& n) const {
    if (!is_isotropic()) return to_tensor(stiffness_[cell] * to_mandel(symmetric_part(G))) * n;
    if (has_linear_stress()) return to_tensor(linear_stress_[cell].C * to_mandel(symmetric_part(G))) * n;
    const IsotropicElasticity& c = moduli_[cell];
    return (c.lambda * G.trace()) * n + c.mu * (G * n + G.transpose() * n);
  }
  // On side number `turn`, at the distance d from the cell's centre. Within a cell the pressure varies, and the
  // gradient where cells fit a cubic or lie in layers that bend.
  Vector normal_stress(Index cell, const Vector& n, const Vector& d, std::size_t turn) const {
    Vector stress = varies_within_cells() ? normal_stress(cell, gradient_at(cell, turn), n) : normal_stress(cell, n);
    if (pressure_.any()) stress += pressure_.at(cell, d) * n;
    return stress;
  }
  bool varies_within_cells() const { return cubic_.any() || layers_.any() || bonded_.size() > 0; }
  Tensor gradient_at(Index cell, std::size_t turn) const {
    Tensor gradient = mean_gradient_at(cell, turn);
    if (cubic_.any()) gradient += cubic_.at(turn).gradient;
    if (layers_.any()) gradient += layers_.at(turn);
    return gradient;
  }
  // That of the cell, or of the surface on which side number `turn` is bonded.
  const Tensor& mean_gradient_at(Index cell, std::size_t turn) const {
    const Index k = bonded_at(turn);
    return k < 0 ? gradients_[cell] : bonded_gradients_[as_size(k)];
  }
  // What the cell's displacement rises by to the centre of side number `turn`.
  Vector rise(Index cell, const Vector& d, std::size_t turn) const {
    Vector linear = mean_gradient_at(cell, turn) * d;
    if (cubic_.any()) linear += cubic_.at(turn).rise;
    return linear;
  }
  // Part of it that varies with the displacements.
  Vector linear_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn) const {
    if (has_law()) return side_laws_[turn].rows * to_mandel(symmetric_part(gradients_[cell]));
    if (!is_finite()) return normal_stress(cell, n, d, turn);
    const FaceTurn& by = face_turns_[turn];
    const FiniteAt at = finite_at(cell, turn);
    const Vector t = at.stress * n + by.turn * (at.cofactor_change * n) + by.swell * at.volume_rate;
    if (!pressure_.any()) return t;
    const std::size_t i = force_at(turn);
    return t + pressure_.at(cell, d) * moved_faces_.area(i) + by.pressure * area_changes_[i];
  }
  static constexpr double moderate_lambda = 1.5;  // lambda_s / mu of undamaged polyhedra, at most
  static CellField<double> jump_shares(const Mesh& mesh, const Unknowns& unknowns);
  void renew_liquidity();
  double jump_modulus(Index cell) const;
  IsotropicElasticity with_jump_modulus(Index cell, IsotropicElasticity part) const;
  double jump_stiffness(Index P, Index N, double h_P, double h_N, double full) const;
  double slip_stiffness(Index P, Index N, double c_n, double c_t) const;
  double bending_part(const Link& link) const;
  void leave_out_third_order() {
    cubic_.leave_out();
    layers_.leave_out();
  }
  void weigh_third_order(const CellField<double>& g) {
    cubic_.weigh(g);
    layers_.weigh(g);
  }
  bool is_of_third_order(std::size_t link) const {
    const auto& [P, N] = std::pair(links_[link].P, links_[link].N);
    return (cubic_.fits(P) && cubic_.fits(N)) || (layers_.cover(P) && layers_.cover(N)) || layers_.weighs(link);
  }
  // The weight of P's side, c and (a + b)^-1 of link i, and a of side i, times v.
  Vector weigh(std::size_t i, const Vector& v) const {
    return is_isotropic() ? scale(links_[i].weight_n, links_[i].weight_t, links_[i].n, v) : link_tensors_[i].weight * v;
  }
  Vector pull(std::size_t i, const Vector& v) const {
    return is_isotropic() ? scale(links_[i].jump_n, links_[i].jump_t, links_[i].n, v) : link_tensors_[i].c * v;
  }
  Vector pull_jump(std::size_t i, const Vector& v) const {
    return layers_.any() ? pull(i, layers_.weight(i) * v) : pull(i, v);
  }
  Vector give(std::size_t i, const Vector& v) const;
  Vector hold(std::size_t i, const Vector& v) const {
    return is_isotropic() ? scale(sides_[i].a_n, sides_[i].a_t, sides_[i].n, v) : side_tensors_[i] * v;
  }
  Tensor compact_link(std::size_t i) const;
  Tensor compact_side(std::size_t i) const;
  Tensor compact_sector(Index cell) const;
  // Stress [Pa] across the plane of a plane mesh, per unit of n (x) n.
  double stress_across(Index cell, const Tensor& strain) const;
  // Stores the coefficients of the strain across the plate, and replaces the stiffness by the condensed one.
  void condense(CellField<IsotropicElasticity>& moduli);
  void condense(CellField<LinearStress>& stress);
  Tensor without_eigenstrain(Index cell, const Tensor& strain) const {
    return has_eigenstrain() ? (strain - to_tensor(eigenstrain_[cell])).eval() : strain;
  }
  // In plane stress the strain across the plate is added; else the gradient stays as it is.
  Tensor with_strain_across(Index cell, const Tensor& gradient) const;
  Vector face_displacement(std::size_t link, const std::vector<Vector>& u) const;
  FaceField<Vector> face_displacements(const std::vector<Vector>& u) const;
  template <class Stress>
  double part_energy(Index cell, const Stress& stress_of, const Tensor& strain, const FaceField<Vector>& u_face,
                     const std::vector<Vector>& u) const;
  Vector gap(Index cell, const Vector& d, std::size_t turn, const Vector& move, const std::vector<Vector>& u) const;
  Vector seen_from(Index cell, Index face, const FaceField<Vector>& u_face, const std::vector<Vector>& u) const;

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  Gradient gradient_;
  mutable CubicFaces cubic_;       // its sides are numbered as face_turns_
  mutable LayerGradients layers_;  // likewise
  CellField<IsotropicElasticity> moduli_;
  CellField<double> jump_share_;  // lambda_s + 2 mu over lambda + 2 mu, undamaged; 1 except in polyhedra
  CellField<double> liquidity_;   // 0 to 1: how closed (without shear stiffness) the crack of a polyhedron is
  CellField<MandelMatrix>
      stiffness_;  // of such a law; empty while all cells are isotropic, as are the tensors of the faces
  StrainLaw law_;  // may be empty
  std::vector<SideLaw> side_laws_;          // of it: two per link, then one per side
  CellField<LinearStress> linear_stress_;   // may be empty
  std::optional<double> eigenstrain_load_;  // load parameter of
  CellField<Mandel> eigenstrain_;           // [-]; empty: none; and
  CellField<Tensor> initial_stress_;        // -C eps* [Pa], condensed in plane stress; of isotropic cells and of laws
  CellField<FiniteLaw> finite_;             // of finite strain, as what follows; else empty
  CellField<Tensor> F_, cofactor_;          // at which the laws are linearised
  CellField<Push> push_;                    // of their faces
  std::vector<FaceTurn> face_turns_;        // two per link, then one per side
  std::vector<JumpTurn> jump_turns_;        // per link; empty where the jump's stiffness is that of the tractions
  std::vector<VolumeRow> volume_rows_;      // per pressure
  BondedSides bonded_;                      // of cells with a pressure
  MovedFaces moved_faces_;                  // likewise, at finite strain
  CellField<double> pressure_at_;           // q there [Pa]; zero without
  CellField<double> initial_sector_;        // of sector_stress_ [Pa]
  CellField<StrainAcross> strain_across_;   // empty but in plane stress
  std::vector<Link> links_;
  bool has_relaxed_flat_cells_ = false;
  std::vector<Side> sides_;
  std::vector<SplitFace> split_faces_;
  PressedFaces pressed_faces_;
  std::vector<FaceSpring> springs_;  // of them; empty: none
  std::vector<LinkTensors> link_tensors_;
  std::vector<Tensor> side_tensors_;        // a [Pa/m]
  std::vector<Index> force_of_face_;        // owner's side; -1 for plane and axisymmetric patches
  std::vector<Index> second_side_of_node_;  // of interface nodes that are not split: the neighbour's side, else -1
  std::vector<Index> first_side_of_node_;
  std::vector<std::size_t> cell_offsets_;
  std::vector<SignedForce> cell_forces_;
  CellField<Tensor> closure_;  // K^-1 of K = (1/V) sum S (x) (x_f - x_c): the identity where faces are plane
  // Of axisymmetric meshes, else empty: the sum of the area vectors of the sector's faces of each cell, and the stress
  // across them [Pa], with which they pull.
  CellField<Vector> sector_area_;
  mutable CellField<double> sector_stress_;
  mutable CellPressure pressure_;
  mutable std::vector<double> flux_;              // as forces_: u_f.S [m^3]; empty without pressures
  mutable CellField<Tensor> gradients_;           // work space of apply
  mutable CellField<Tensor> stresses_;            // likewise, at finite strain: A : H [Pa]
  mutable CellField<Tensor> cofactor_change_;     // and that of cof F by H,
  mutable CellField<double> volume_rate_;         // of J
  mutable std::vector<Vector> moved_;             // with pressures: the linearised displacement of each link [m],
  mutable std::vector<Vector> corner_moves_;      // of the points of moved_faces_ [m],
  mutable std::vector<Vector> area_changes_;      // and of its areas, over the undeformed ones
  mutable std::vector<Tensor> bonded_gradients_;  // of bonded_
  mutable std::vector<BondedLaw> bonded_laws_;    // likewise, at finite strain
  mutable std::vector<Vector> forces_;  // per link, then per side: A t outwards from P or from the side's cell
};

}  // namespace pfdm
