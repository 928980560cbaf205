#pragma once
// Whether particles can be meshed in their box, and whether the mesh fills it.

#include <string>

#include "mesh/generators/particles_in_box.h"

namespace pfdm {

/// Thickness of all layers of a particle [m]; 0 without layers.
inline double layers_thickness(const Particle& p) { return p.n_layers > 0 ? p.layer_thickness : 0.0; }
/// Radius of the outermost layer of a sphere [m].
inline double outer_radius(const Particle& p) { return p.radius + layers_thickness(p); }
inline bool is_sphere(const Particle& p) { return p.shape.triangles.empty(); }

/// "particle 3 (centre ..., radius 1 mm)", with its number from 1.
std::string describe_particle(const ParticlesInBoxSettings& settings, std::size_t i);

/// Throws InputError naming particle and numbers if one leaves the box, touches another or has a size that is not
/// positive. Shapes other than spheres are checked by their surfaces.
void check_particles_in_box(const ParticlesInBoxSettings& settings);

/// Throws ComputationError if volume or boundary of the mesh are not those of the box: a gap or an overlap between
/// layers and tetrahedra would show here, as cells close and have positive volumes already.
void check_filled(const Mesh& mesh, const ParticlesInBoxSettings& settings);

}  // namespace pfdm
