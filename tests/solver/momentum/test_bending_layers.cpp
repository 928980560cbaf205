// Which cells are taken for layers that bend.

#include "mesh/geometry.h"
#include "solver/momentum/bending/bending_layers.h"
#include "tests/solver/solver_checks.h"

#include <gtest/gtest.h>

#include <vector>

namespace pfdm::this_file {
namespace {

std::size_t n_bending(double length, const Tensor& rotation) {
  Mesh mesh = box(6, 3, 3, Vector(length, 2e-3, 2e-3));
  for (Vector& point : mesh.points) point = rotation * point;
  compute_geometry(mesh);
  FractureModel model;
  model.regions.push_back({.elasticity = from_young_poisson(1e9, 0.3)});
  model.boundary = {clamped("xmin")};
  return cells_of_layers(mesh, place_unknowns(mesh, elastic_body(model))).size();
}

// Of a body three times as long as thick, which is the limit, rounding of the coordinates decided.
TEST(BendingLayers, DoNotDependOnHowTheBodyIsTurned) {
  const std::size_t straight = n_bending(6e-3, Tensor::Identity());
  EXPECT_EQ(straight, 2u * 54u) << "across both directions";
  for (int i = 1; i <= 40; ++i) {
    const Tensor turned = Eigen::AngleAxisd(0.07 * i, Vector(1.0, 0.3 * i, -2.0).normalized()).toRotationMatrix();
    EXPECT_EQ(n_bending(6e-3, turned), straight) << i;
    EXPECT_EQ(n_bending(5.9e-3, turned), 0u) << i;
  }
}

}  // namespace
}  // namespace pfdm::this_file
