#pragma once
// A box of matrix with many spheres, packed at random or placed, or bodies of any shape, packed and turned at random:
// the representative volume of a composite.

#include "mesh/generators/particles_in_box.h"
#include "mesh/surfaces/surface_checks.h"

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace pfdm {

struct PackedShape {
  NamedSurface given;                      ///< of any size
  double sharp = 0.25 * std::numbers::pi;  ///< angle from which on edges are kept [radian]
};

struct PackedSpheresSettings {
  ParticlesInBoxSettings box;  ///< without its particles
  Particle like;               ///< surface size, region and layers of every sphere
  /// Of the spheres, or rather of their polyhedra: these have the same volume, and their corners lie a little outside.
  std::vector<double> diameters;  ///< [m]
  std::vector<Vector> centres;    ///< [m]; none: packed at random
  double gap = 0.0;               ///< least distance between two polyhedra, layers included [m]
  double wall_gap = 0.0;          ///< and from the sides of the box [m]
  std::uint64_t seed = 1;         ///< of the places, and of the directions in which the polyhedra are turned
  /// Where a surface is near another one its edges are at most this times their distance, down to
  /// `smallest_surface_size` of those elsewhere; 0: as elsewhere.
  double edges_over_gap = 1.0;
  double smallest_surface_size = 0.5;
  bool numbered = false;  ///< regions particle_1, particle_2 ... instead of one
  /// Surfaces in place of the spheres, taken in turn; `diameters` are those of the spheres of their volumes, and
  /// `like.surface_size` is the edge length of their new triangles. They are packed at random.
  std::vector<PackedShape> shapes{};
};

/// Of sphere i, from 0: particle_1 ...
std::string numbered_region(const std::string& region, std::size_t i);

/// The particles with which make_particles_in_box makes the mesh. Throws InputError, as that does, and where the
/// spheres find no room.
ParticlesInBoxSettings packed_particles(const PackedSpheresSettings& settings);

Mesh make_packed_spheres(const PackedSpheresSettings& settings);

/// How diameters are distributed, by number.
struct DiameterDistribution {
  enum class Kind { constant, uniform, lognormal, list };
  Kind kind = Kind::constant;
  double mean = 0.0;             ///< of a constant and of a lognormal distribution [m]
  double coefficient = 0.0;      ///< standard deviation over mean, of a lognormal one
  double least = 0.0;            ///< cuts a lognormal distribution; ends of a uniform one [m]
  double most = 0.0;             ///< 0: no limit
  std::vector<double> values{};  ///< of a list, each as probable as the others [m]
};

/// `count` diameters of the distribution, or, with count 0, as many as come nearest to this volume; they are multiplied
/// by one factor so that the volume is that exactly. Volume 0: they stay as they are. Throws InputError if the factor
/// differs from 1 by more than a tenth, and the diameters are not only ratios.
std::vector<double> draw_diameters(const DiameterDistribution& distribution, Index count, double volume, bool ratios,
                                   std::uint64_t seed);

}  // namespace pfdm
