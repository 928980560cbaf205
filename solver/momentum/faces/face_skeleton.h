#pragma once
// Skeleton of the momentum balance, which the mesh and the placement of the unknowns alone decide: its faces, the
// forces that act on each cell, and their sums in the balance of every node. Constant after construction.
//
// Forces stand in one order: first those of the links, then those of the sides. "Turns" number what each cell sees of
// its faces: 2 i and 2 i + 1 are P's and N's side of link i, the sides follow.

#include "solver/momentum/bending/cubic_faces.h"
#include "solver/momentum/body/momentum_faces.h"
#include "solver/momentum/body/unknowns.h"
#include "solver/momentum/faces/moved_faces.h"

#include <span>
#include <vector>

namespace pfdm {

/// Forces on the faces for given displacements.
struct FaceForces {
  std::vector<Vector> force;          ///< in the order above: area times traction, outwards from P or from the side [N]
  CellField<double> sector_stress{};  ///< across the sector's own faces of axisymmetric meshes [Pa]; empty of others
};

struct FaceSkeleton {
  struct SignedForce {
    Index force;
    double sign;  ///< -1 as seen from a link's N
  };

  FaceSkeleton(const Mesh& mesh, const Unknowns& unknowns);  ///< for use while both exist

  const Mesh& mesh;
  const Unknowns& unknowns;
  std::vector<momentum_faces::Link> links;
  std::vector<momentum_faces::Side> sides;
  std::vector<momentum_faces::SplitFace> split_faces;
  FaceField<Index> force_of_face;          ///< owner's side; -1 for plane and axisymmetric patches
  std::vector<Index> first_side_of_node;   ///< by face node
  std::vector<Index> second_side_of_node;  ///< of interface nodes that are not split: the neighbour's side, else -1
  CellField<Tensor> closure;  ///< K^-1, K = (1/V) sum S (x) (x_f - x_c): the identity where faces are plane
  CellField<Vector>
      sector_area;  ///< sum of the areas of the sector's own faces [m^2]; empty but in axisymmetric meshes

  std::size_t n_forces() const { return links.size() + sides.size(); }
  std::size_t n_turns() const { return 2 * links.size() + sides.size(); }
  static std::size_t turn_P(std::size_t link) { return 2 * link; }
  static std::size_t turn_N(std::size_t link) { return 2 * link + 1; }
  /// Of the part of a link's jump that no traction bears, what the displacement of the face has beyond the gap of the
  /// cell at side number `turn` [m]. `towards_N`: what it has beyond that of P.
  static Vector idle_share(std::size_t turn, const Vector& idle, const Vector& towards_N) {
    return turn % 2 == 0 ? towards_N : Vector(towards_N - idle);
  }
  std::size_t turn_of_side(std::size_t side) const { return 2 * links.size() + side; }
  bool is_side(std::size_t turn) const { return turn >= 2 * links.size(); }
  std::size_t force_at(std::size_t turn) const { return is_side(turn) ? turn - links.size() : turn / 2; }
  std::size_t turn_at(const SignedForce& on) const {
    const std::size_t i = on.force;
    return i >= links.size() ? turn_of_side(i - links.size()) : (on.sign > 0.0 ? turn_P(i) : turn_N(i));
  }
  /// Forces of a cell in the order of its faces, without those of plane and axisymmetric patches.
  std::span<const SignedForce> forces_of(Index cell) const {
    return {cell_forces_.data() + cell_offsets_[cell], cell_forces_.data() + cell_offsets_[cell + 1]};
  }
  /// Sum of what leaves a cell through its faces, given in the order of the forces.
  double out_of(Index cell, const std::vector<double>& flux) const {
    double sum = 0.0;
    for (const SignedForce& on : forces_of(cell)) sum += on.sign * flux[on.force];
    return sum;
  }
  std::size_t number_of(Index face_node) const { return as_size(face_node - unknowns.n_cells); }

  /// Sides of all cells, in the order of the turns.
  std::vector<CubicFaces::Side> sides_by_turn() const;
  /// Places of all faces, in the order of the forces.
  std::vector<MovedFaces::Place> places_by_force() const;

  /// out: minus the sum of the forces on each cell, the free part of those on each face node, and what they do along
  /// the free strains of a box [N, N m].
  void sum_forces(const FaceForces& forces, std::vector<Vector>& out) const;
  /// Removes the component across the plane of a plane mesh: it neither moves nor is loaded across.
  void keep_in_plane(std::vector<Vector>& v) const;
  /// Gives images of periodic nodes what their nodes have.
  void move_images(std::vector<Vector>& v) const;

 private:
  void add_links();
  void add_sides();
  void list_forces_of_cells();
  void gather_from_images(std::vector<Vector>& forces) const;
  void work_on_free_strains(const FaceForces& forces, std::vector<Vector>& out) const;

  std::vector<std::size_t> cell_offsets_;
  std::vector<SignedForce> cell_forces_;
};

}  // namespace pfdm
