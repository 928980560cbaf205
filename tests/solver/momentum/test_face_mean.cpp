// Means over faces of loads that vary over them.

#include "solver/momentum/body/face_mean.h"
#include "tests/solver/solver_checks.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

TEST(FaceMean, IsExactForQuadratics) {
  const Mesh mesh = box(1, 1, 1, {1.0, 2.0, 3.0});
  const Index f = mesh.patch("xmax").first_face;
  // Of y^2 over 0 to 2 and of y z over 0 to 2 and 0 to 3.
  EXPECT_NEAR(mean_over_face(mesh, f, [](const Vector& x) { return x.y() * x.y(); }), 4.0 / 3.0, 1e-13);
  const Vector mean = mean_over_face(mesh, f, [](const Vector& x) -> Vector { return {x.y() * x.z(), 7.0, x.z()}; });
  EXPECT_NEAR((mean - Vector(1.5, 7.0, 1.5)).norm(), 0.0, 1e-13);
}

TEST(FaceMean, OfAFieldThatEndsWithinTheFaceIsTheValueAtItsCentre) {
  const Mesh mesh = box(1, 1, 1, {1.0, 2.0, 3.0});
  const Index f = mesh.patch("xmax").first_face;
  const auto ends = [](const Vector& x) {
    if (x.y() > 1.5) throw InputError("outside");
    return x.y() * x.y();
  };
  EXPECT_EQ(mean_over_face(mesh, f, ends), 1.0);
}

}  // namespace
}  // namespace pfdm::this_file
