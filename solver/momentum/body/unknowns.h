#pragma once
// Placement of the displacement unknowns: one node per cell, then one per face between two elastic zones or on the
// boundary. Faces of plane and axisymmetric patches (one-cell-thick meshes) carry none. Nearly incompressible cells
// also have a pressure (cell_pressure.h): unknowns after the nodes, each in the first component of a vector.
// The sides of a split face (a cohesive interface) are independent: each has a node of its own.
// Components of the mean strain of a box may be unknowns too: the last ones, each in the first component of a vector.

#include "mesh/mesh.h"
#include "physics/elasticity/elasticity.h"
#include "physics/elasticity/mandel.h"
#include "solver/momentum/body/boundary_condition.h"
#include "solver/momentum/body/spin_holds.h"

#include <functional>
#include <optional>
#include <vector>

namespace pfdm {

/// A face of a free patch that follows a displacement of the whole body in these directions (a projector).
struct HeldFace {
  Index face = 0;
  Tensor directions = Tensor::Identity();
};

/// Two faces of free patches that are translates of each other: the body continues across them, apart from the
/// difference of a displacement of the whole body between the two places.
struct PeriodicFaces {
  Index face = 0, image = 0;
};

/// A part of the mean strain of a box that is not prescribed: an unknown, by the mean stress that it has to meet.
struct FreeStrain {
  Tensor direction;                        ///< symmetric, of norm 1
  std::function<double(double t)> stress;  ///< mean stress along it at the load parameter t [Pa]; empty: zero
  double modulus = 0.0;                    ///< estimate of the box's, for the preconditioner [Pa]
};

/// Motion of the sides of a box that follow a displacement of the whole body.
struct BoxMotion {
  std::vector<HeldFace> held{};           ///< none twice, and no image of a periodic face
  std::vector<PeriodicFaces> periodic{};  ///< no face twice
  /// Displacement of the whole body at x [m] and the load parameter t, affine in x: for the held and the periodic faces
  /// [m]. Empty: zero. The free strains add to it.
  std::function<Vector(const Vector& x, double t)> displacement{};
  std::vector<FreeStrain> free_strains{};
  Vector size = Vector::Zero();    ///< of the box [m]
  Vector centre = Vector::Zero();  ///< of the box [m]: the free strains leave it where it is

  bool any() const { return !held.empty(); }
};

/// Loads within the cells of a mesh at the load parameter t; each may be empty: nothing. The stress under an
/// eigenstrain eps* is C (eps - eps*).
struct VolumeLoads {
  std::function<Vector(const Mesh& mesh, Index cell, double t)> force;        ///< per volume, of the reference [N/m^3]
  std::function<Mandel(const Mesh& mesh, Index cell, double t)> eigenstrain;  ///< [-]
  /// By a rise of the temperature besides; only with an eigenstrain [1/K].
  std::function<Mandel(const Mesh& mesh, Index cell)> expansion{};
};

/// The law by which a cell changes its volume.
struct VolumeLaw {
  IsotropicElasticity elasticity;  ///< undamaged, relaxed [Pa]
  /// Of cells that relax with a pressure, whatever their Poisson's ratio: the elasticity when it is least [Pa].
  std::optional<IsotropicElasticity> most_compressible{};

  const IsotropicElasticity& least() const { return most_compressible ? *most_compressible : elasticity; }
};

/// Elasticity of a cell that depends on the direction [Pa]; null where it does not.
using DirectedStiffness = std::function<const MandelMatrix*(const Mesh& mesh, Index cell)>;

/// Body of the momentum balance.
struct ElasticBody {
  std::vector<IsotropicElasticity> elasticity;  ///< of each region of the mesh, undamaged, at once
  /// First region with the same law, for each region. Faces between different laws carry unknowns.
  std::vector<Index> zone;
  std::vector<BoundaryCondition> boundary;     ///< patches that are not named are free
  std::vector<IsotropicElasticity> relaxed{};  ///< after any time; empty: that at once
  DirectedStiffness stiffness{};               ///< undamaged; empty: isotropic
  std::vector<Index> split_faces{};            ///< interior ones, none twice
  BoxMotion motion{};
  VolumeLoads loads{};
  /// Nearly incompressible cells have a pressure: not where the stress is not that of isotropic moduli.
  bool has_pressure = true;
  /// Law by which a cell has a pressure, or none, as where it is nearly incompressible. No law: it has none whatever it
  /// is. Empty: by the elasticity of its region.
  std::function<std::optional<VolumeLaw>(const Mesh& mesh, Index cell)> volume_law{};
};

/// One boundary condition, found on its patch.
struct PatchCondition {
  Index patch = 0;
  BoundaryCondition condition;
};

/// The image moves as the node does, and by the body's displacement between the two.
struct PeriodicNodes {
  Index node = 0, image = 0;
};

struct Unknowns {
  CellField<Index> zone;                     ///< cells of one law share a zone
  std::vector<IsotropicElasticity> sound;    ///< elasticity of each zone, undamaged, at once
  std::vector<IsotropicElasticity> relaxed;  ///< and after any time
  DirectedStiffness stiffness{};             ///< as the body has it
  FaceField<Index> node_of_face;             ///< -1 where a face carries no unknown
  std::vector<Index> face_of_node;           ///< entry k is the face of node n_cells + k
  std::vector<Index> split_faces{};          ///< node_of_face is that of their owner's side,
  FaceField<Index> neighbour_node{};         ///< and this that of the neighbour's; -1 elsewhere; empty without any
  std::vector<PatchCondition> conditions;    ///< one per patch of the mesh, free by default
  VolumeLoads loads{};                       ///< as the body has them
  BoxMotion motion{};                        ///< as the body has it, and
  std::vector<PeriodicNodes> periodic{};     ///< its pairs
  std::vector<Tensor> free_directions;  ///< per face node: projector onto the displacements that are not prescribed
  /// Across the one cell of plane and axisymmetric meshes; zero in three-dimensional ones.
  Vector plane_normal = Vector::Zero();
  bool plane_stress = false;       ///< across the plane patches; else plane strain
  Vector radial = Vector::Zero();  ///< of axisymmetric meshes: from the axis z along the middle of the sector
  Index n_cells = 0;
  std::vector<SpinHold> spin_holds{};      ///< of cells in columns one cell wide; else empty
  std::vector<Index> pressure_cells;       ///< entry k is the cell of unknown n_nodes() + k
  std::vector<VolumeLaw> pressure_laws{};  ///< of each of them

  /// Elasticity of a cell that depends on the direction [Pa]; null where it does not.
  const MandelMatrix* stiffness_of(const Mesh& mesh, Index cell) const {
    return stiffness ? stiffness(mesh, cell) : nullptr;
  }
  bool is_axisymmetric() const { return radial != Vector::Zero(); }
  Index n_nodes() const { return n_cells + count_of(face_of_node); }
  Vector place(const Mesh& mesh, Index node) const {
    return node < n_cells ? mesh.cell_centre[node] : mesh.face_centre[face_of_node[node - n_cells]];
  }
  /// Whether both sides of a face have nodes of their own.
  bool is_split(Index face) const { return neighbour_node.size() > 0 && neighbour_node[face] >= 0; }
  /// Node of a face on the side of one of its cells; -1 where it carries none.
  Index node_beside(const Mesh& mesh, Index cell, Index face) const {
    return is_split(face) && mesh.owner[face] != cell ? neighbour_node[face] : node_of_face[face];
  }
  /// Free directions of a face node, that across a plane or sectional mesh left out: whatever is prescribed along it,
  /// nothing moves there.
  Tensor free_within(Index node) const {
    const Tensor& all = free_directions[node - n_cells];
    return all - all * plane_normal * plane_normal.transpose();
  }
  /// Whether a face node with this normal is held across its face, and free in some direction within it.
  bool glides(Index node, const Vector& normal) const {
    constexpr double rounding = 1e-9;
    return !free_within(node).isZero() && (free_directions[node - n_cells] * normal).norm() < rounding;
  }
  Index first_strain() const { return n_nodes() + count_of(pressure_cells); }
  Index n_unknowns() const { return first_strain() + count_of(motion.free_strains); }  ///< vectors
  bool has_free_strains() const { return !motion.free_strains.empty(); }
  /// The sum of the free strains among the unknowns u.
  Tensor free_strain(const std::vector<Vector>& u) const {
    Tensor sum = Tensor::Zero();
    for (std::size_t k = 0; k < motion.free_strains.size(); ++k)
      sum += u[first_strain() + k][0] * motion.free_strains[k].direction;
    return sum;
  }
  /// Elasticity of each cell's zone, without damage.
  CellField<IsotropicElasticity> sound_moduli() const;
  /// All nodes where the prescribed motion of the box has them at the load parameter t, its free strains zero.
  std::vector<Vector> moved_with_box(const Mesh& mesh, double t) const;
};

/// Whether cells of this elasticity have a pressure: nu above 0.47.
bool is_nearly_incompressible(const IsotropicElasticity& elasticity);

/// Throws InputError for a condition on an unknown patch, two conditions on one patch, a symmetry patch that is not
/// plane, and plane stress together with plane strain. Also for a plane mesh without a front or a back, and a part of
/// the body that nothing holds against a rigid motion.
Unknowns place_unknowns(const Mesh& mesh, const ElasticBody& body);

}  // namespace pfdm
