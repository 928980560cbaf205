#pragma once
// The momentum balance on cell-centred finite volumes with two-sided faces. Both cells of a face reconstruct its
// traction, and the face displacement is the one at which the two agree, so traction is continuous for any moduli. With
// a, b the normal stiffness of both sides over their distance from the face,
//
//   t = b (a+b)^-1 sigma_P n + a (a+b)^-1 sigma_N n + a (a+b)^-1 b J,  J = (u_N + G_N d_N) - (u_P + G_P d_P).
//
// Faces between elastic zones and on the boundary carry u_f itself: each side has t_c = sigma_c n + a_c (u_f - u_c -
// G_c d_c). What sigma, a and b are is chosen by the first law that is set: face_tractions.h.
//
// Split faces: each side has a node and a traction of its own, t_P and t_N as above, and a law of their separation
// joins them (face_springs.h).
//
// Periodic faces: the image has no unknown of its own, but the displacement of its node plus what is prescribed between
// the two. Its forces act on that node: t_P + t_N = 0 as on an interface, whose sides lie at different places.
//
// Free strains E of a box move its held faces by E (x - x_0), x_0 its centre, and the images of its nodes by E (x_image
// - x_node). Their equation: the work of the forces on these moves, by E, is the mean stress times the volume.
//
// Const functions keep nothing between calls: the work space of a sweep belongs to its caller.

#include "solver/linear/block_matrix.h"
#include "solver/momentum/body/cell_eigenstrain.h"
#include "solver/momentum/body/cell_mechanics.h"
#include "solver/momentum/body/unknowns.h"
#include "solver/momentum/faces/boundary_loads.h"
#include "solver/momentum/faces/cell_reconstruction.h"
#include "solver/momentum/faces/face_springs.h"
#include "solver/momentum/faces/face_tractions.h"
#include "solver/momentum/finite_strain/finite_law.h"
#include "solver/momentum/small_strain/history_stress.h"
#include "solver/momentum/small_strain/strain_law.h"
#include "solver/momentum/spin_forces.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pfdm {

class FiniteTractions;
class IsotropicTractions;
class LawTractions;

class MomentumOperator {
 public:
  MomentumOperator(const Mesh& mesh, const Unknowns& unknowns);  ///< for use while both exist

  /// Secant moduli of every cell, and the stiffness factors g that weight the gradients; the weights are updated only
  /// where g has changed by more than this fraction. Where a `history` is given, its stress
  /// replaces that of the moduli in every cell.
  void set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part = 0.0,
                  HistoryStress history = {});
  /// A stress by the strain, linearised about the displacements u; being of first degree, it is exact there. The faces
  /// are found from where they were, or `afresh`. Returns a measure of the stiffness of each cell's faces [Pa].
  CellField<double> set_law(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u, bool afresh,
                            double part = 0.0);
  /// Finite strain: the balance linearised about the displacements u, and pressures on patches about the load parameter
  /// t. There it is exact. In plane stress the laws are condensed already. `gaps`: what is left of earlier ones, by
  /// Mesh::cell_faces; empty: no cell relaxes. Returns a measure of the stiffness of each cell's faces [Pa].
  CellField<double> set_finite(const FiniteLawAt& law, const std::vector<GapStress>& gaps, const CellField<double>& g,
                               const std::vector<Vector>& u, double t, double part = 0.0);
  /// Cells of the sides that have a gradient of their own at finite strain, in their order.
  std::vector<Index> own_sides_at_finite_strain();
  /// The eigenstrains of the body at the load parameter t and these rises of the temperature [K], empty: none; or none;
  /// before set_moduli(), set_law() and set_finite(). Returns whether they have changed.
  bool set_eigenstrain(std::optional<double> t, const CellField<double>& rise = {});
  const CellField<Mandel>& eigenstrain() const { return eigenstrain_->all(); }  ///< of now [-]; empty: none
  /// Twice the energy that the eigenstrains of now would store in the undamaged body if nothing moved, at finite strain
  /// by its elasticity at small strain [J].
  double energy_if_held() const;
  /// Twice the energy that the stresses of viscoelastic cells at finite strain have by their shear moduli: they are
  /// there also where nothing is prescribed any more [J]. Zero of others.
  double energy_remembered() const;
  /// Prepares bodies of flat cells that bend (CellReconstruction::relax_flat_cells); before set_moduli().
  void relax_flat_cells();

  /// Null but at finite strain, and but with isotropic moduli.
  const FiniteTractions* finite() const { return finite_; }
  const IsotropicTractions* isotropic() const { return isotropic_; }
  /// Whether the law is linearised about displacements.
  bool is_linearised() const { return tractions_->is_linearised(); }
  /// Whether some cells have faces or gradients of third order: cubic_faces.h, at finite strain none;
  /// layer_gradients.h.
  bool is_of_third_order() const { return tractions_->has_third_order(); }
  /// Whether a tenth of the surface or more has layers of prisms, tetrahedra or polyhedra across a slender part of the
  /// body (slender_layers.h).
  bool is_slender() const;

  /// The laws of the split faces, in their order.
  const std::vector<FaceSpring>& springs() const { return springs_.all(); }
  void set_springs(std::vector<FaceSpring> springs) { springs_.set(std::move(springs)); }
  /// load += the forces of the springs' offsets, [N].
  void add_spring_offsets(std::vector<Vector>& load) const { springs_.add_offsets(load); }
  /// out -= forces [N] of the split faces, on the owner's side, on their nodes.
  void pull_split_faces(const std::vector<Vector>& forces, std::vector<Vector>& out) const {
    springs_.pull(forces, out);
  }
  /// Displacement of the neighbour's side of split face number k, less that of the owner's [m].
  Vector separation(std::size_t k, const std::vector<Vector>& u) const { return springs_.separation(k, u); }
  /// Tractions and compliances of each side of the split faces under the displacements u, in their order.
  struct SplitSides {
    Vector traction, traction_beyond;  ///< outwards from the owner, from the neighbour [Pa]
    Tensor give, give_beyond;          ///< a^-1: displacement of the side by its traction [m/Pa]
  };
  std::vector<SplitSides> split_sides(const std::vector<Vector>& u) const;
  /// Moves the sides of split face number k.
  void part(std::size_t k, const Vector& move, const Vector& move_beyond, std::vector<Vector>& u) const {
    u[skeleton_->split_faces[k].node] += move;
    u[skeleton_->split_faces[k].beyond] += move_beyond;
  }

  /// out = A u, [N]: minus the sum of forces on each cell; the free part of the forces on each face node; for each
  /// pressure V q / (lambda - lambda_s) - sum u_f.S [m^3]. Without initial stresses.
  void apply(const std::vector<Vector>& u, std::vector<Vector>& out) const { apply(u, out, *sweep()); }
  /// out = A u with this sweep, which then has the gradients and forces of u.
  void apply(const std::vector<Vector>& u, std::vector<Vector>& out, Sweep& sweep) const;
  SpareSweeps::Lease sweep() const { return tractions_->sweep(); }
  /// Forces from prescribed tractions, pressures and body forces at the load parameter t [N]; pressures on the areas of
  /// the last linearisation.
  std::vector<Vector> traction_forces(double t) const { return loads_.forces(t); }
  /// Those and what turns with the body: of the potential of the loads, which the elastic energy of strains less
  /// eigenstrains is without.
  std::vector<Vector> applied_forces(double t) const;
  /// Forces from prescribed tractions, pressures, body forces and initial stresses at the load parameter t [N].
  std::vector<Vector> load_vector(double t) const;
  /// Energy in elastic foundations, which is none of the body's [J].
  double foundation_energy(const std::vector<Vector>& u) const { return loads_.stored(u); }
  /// Writes the prescribed components of the boundary nodes at the load parameter t.
  void prescribe(double t, std::vector<Vector>& u) const { loads_.prescribe(t, u); }
  /// Removes the component across the plane of a plane mesh.
  void keep_in_plane(std::vector<Vector>& v) const { skeleton_->keep_in_plane(v); }
  /// Gives images of periodic nodes what their nodes have, in a v without free strains.
  void move_images(std::vector<Vector>& v) const { skeleton_->move_images(v); }

  /// The compact symmetric matrix for the preconditioner of A: c between cells, a from a cell to its face nodes. It is
  /// diagonal in what is prescribed and in the direction across a plane mesh.
  BlockTriplets compact_matrix() const;
  /// Approximate diagonal of the Schur complement, per pressure [m^3/Pa].
  std::vector<double> pressure_compliance() const { return tractions_->pressure_compliance(); }
  /// r -= the forces of the pressures q (stored among the unknowns) on the nodes.
  void take_away_pressure_forces(const std::vector<Vector>& q, std::vector<Vector>& r) const;

  enum class Wanted { all, without_gradient };
  /// `part`: of the stiffness of each cell, whose energy is wanted.
  CellMechanics mechanics(const std::vector<Vector>& u, Wanted wanted = Wanted::all,
                          const CellField<IsotropicElasticity>& part = {}) const;
  std::vector<Vector> boundary_forces(const std::vector<Vector>& u) const;  ///< per boundary face [N]
  /// Traction [Pa] on each interior face that carries a node, on its owner.
  std::vector<std::pair<Index, Vector>> interface_tractions(const std::vector<Vector>& u) const;
  /// Traction on every face along its normal [Pa]; zero on the faces of plane and axisymmetric patches.
  FaceField<Vector> tractions(const std::vector<Vector>& u) const;
  std::vector<Vector> patch_displacements(const std::vector<Vector>& u) const;  ///< per patch, area mean [m]

  const FaceSkeleton& skeleton() const { return *skeleton_; }

 private:
  template <class Kind, class... Parts>
  Kind& choose(const Parts&... parts);
  SpareSweeps::Lease forces_of(const std::vector<Vector>& u) const;
  void take_away_constant_forces(std::vector<Vector>& load) const;

  std::unique_ptr<const FaceSkeleton> skeleton_;  // the others refer to it
  std::unique_ptr<CellReconstruction> cells_;
  std::unique_ptr<CellEigenstrain> eigenstrain_;
  BoundaryLoads loads_;
  FaceSprings springs_;
  SpinForces spins_;
  std::unique_ptr<FaceTractions> tractions_;
  FiniteTractions* finite_ = nullptr;  // the tractions, if they are of this kind
  IsotropicTractions* isotropic_ = nullptr;
};

}  // namespace pfdm
