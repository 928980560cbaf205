#pragma once
// A box of matrix with particles, spheres or of any shape, each in thin prism layers if wanted: wedges in the layers,
// tetrahedra inside the particles and in the matrix, all conforming. Without particles: a box of tetrahedra.

#include <limits>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/surfaces/triangle_surface.h"

namespace pfdm {

struct Particle {
  Vector centre = Vector::Zero();  ///< [m]
  double radius = 0.0;             ///< [m]
  /// Its surface: either the edge length [m] or the subdivision n of an icosahedron (20 n^2 triangles); the other 0.
  double surface_size = 0.0;
  Index subdivision = 0;
  /// By which that icosahedron is turned about z [radian]. It is alike on both sides of the planes x = 0 and y = 0, not
  /// along x and y; turned by 45 degrees it is alike along these as well.
  double angle = 0.0;
  /// In place of that icosahedron, if it has triangles: directions of the points, and the triangles. `subdivision` then
  /// only tells the size of the cells around it.
  TriangleSurface directions{};
  /// In place of the sphere, if it has triangles: a closed surface about `centre` [m]. `radius` is not used then;
  /// `surface_size` is the edge length of its triangles, and tells the size of the cells around it.
  TriangleSurface shape{};
  std::string region = "bead";
  Index n_layers = 0;            ///< 0: the particle's surface itself is the interface
  double layer_thickness = 0.0;  ///< of all layers together [m]
  std::string layer_region = "interface";
};

struct ParticlesInBoxSettings {
  Vector lower = Vector::Zero();  ///< corners of the box [m]
  Vector upper = Vector::Zero();
  std::vector<Particle> particles;
  std::string matrix_region = "matrix";
  /// Wanted edge length in the matrix: that of the nearest outermost layer + grading * distance from it, at most
  /// size_far; inside a particle that of its surface + grading * depth, at most particle_size_factor times that of the
  /// surface (of spheres only).
  double grading = 0.4;                                                   ///< [-]
  double size_far = std::numeric_limits<double>::infinity();              ///< [m]
  double particle_size_factor = std::numeric_limits<double>::infinity();  ///< [-]; 1: uniform
  double boundary_size = 0.0;          ///< edge length on the box's surface [m]; 0: as wanted there by the rule above
  double max_radius_edge_ratio = 1.4;  ///< of tetrahedra: circumradius over shortest edge [-]
  double min_dihedral_angle = 10.0;    ///< of tetrahedra, as far as the surfaces allow [degrees]
};

/// Patches xmin, xmax, ymin, ymax, zmin, zmax. Layers are of equal thickness, around spheres their side faces are
/// plane. The same settings give the same mesh. Throws InputError naming particle and numbers if one leaves the box,
/// touches another or has a size that is not positive; ComputationError if the mesh does not fill the box.
Mesh make_particles_in_box(const ParticlesInBoxSettings& settings);

}  // namespace pfdm
