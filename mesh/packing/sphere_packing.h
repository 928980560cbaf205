#pragma once
// Random packings of spheres in a box. Hard spheres grow from a dilute random arrangement while they move at random, so
// that they make room for each other (Monte Carlo form of Lubachevsky, Stillinger, J. Stat. Phys. 60 (1990) 561):
// random sequential addition, which never moves a sphere, ends at a volume fraction of about 0.3.

#include "mesh/fields.h"
#include "physics/random_numbers.h"

#include <cstdint>
#include <vector>

namespace pfdm {

struct SpherePacking {
  Vector lower = Vector::Zero();  ///< corners of the box [m]
  Vector upper = Vector::Zero();
  std::vector<double> radii;  ///< [m]
  double gap = 0.0;           ///< least distance between two spheres [m]
  double wall_gap = 0.0;      ///< least distance from the sides of the box [m]
};

/// Centres [m] of spheres of these radii, wholly inside the box. Throws InputError, with the fraction that was reached,
/// where they find no room.
std::vector<Vector> pack_spheres(const SpherePacking& packing, RandomNumbers& random);

/// Volume of all spheres over that of the box.
double volume_fraction(const SpherePacking& packing);

}  // namespace pfdm
