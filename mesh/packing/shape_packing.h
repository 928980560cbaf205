#pragma once
// Random packings of bodies of any shape in a box, as sphere_packing has them of spheres: the convex hulls of the
// bodies grow from a dilute random arrangement while they move and turn at random without coming nearer to each other
// than the gap. Bodies that are not convex keep the distance of their hulls.

#include "mesh/packing/sphere_packing.h"

#include <vector>

namespace pfdm {

struct ShapePacking {
  Vector lower = Vector::Zero();  ///< corners of the box [m]
  Vector upper = Vector::Zero();
  std::vector<std::vector<Vector>> bodies;  ///< corners of each hull about its centre, which it holds [m]
  double gap = 0.0;                         ///< least distance between two bodies [m]
  double wall_gap = 0.0;                    ///< least distance from the sides of the box [m]
};

struct ShapePlace {
  Vector centre = Vector::Zero();  ///< [m]
  Tensor rotation = Tensor::Identity();
};

/// Throws InputError, with the size that was reached, where they find no room.
std::vector<ShapePlace> pack_shapes(const ShapePacking& packing, RandomNumbers& random);

}  // namespace pfdm
