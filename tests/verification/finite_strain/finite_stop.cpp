// What is said where no increment converges at finite strain.

#include "physics/error.h"
#include "tests/verification/finite.h"

#include <gtest/gtest.h>

#include <string>

namespace pfdm::verification::this_file {
namespace {

// What is said of a cube of 1 m that is pressed on its top; empty if it bears that.
std::string said_of_cube(const BoundaryCondition& pressed) {
  const Mesh mesh = mapped_box({2, 2, 2}, [](const Vector& s) { return s; });
  const FractureModel model =
      finite_body(mesh, make_hyperelastic("saint_venant_kirchhoff", {.elasticity = from_young_poisson(1e6, 0.3)}),
                  {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"), pressed});
  try {
    draw(mesh, model, 20);
  } catch (const NoConvergence& stop) {
    return stop.what();
  }
  return {};
}

// Saint Venant and Kirchhoff's law bears at most E/sqrt(27) of pressure, at a stretch of 1/sqrt(3).
TEST(FiniteStop, NamesTheCellAndWhatTheCaseAllows) {
  BoundaryCondition pressed{.patch = "zmax", .value = {}};
  pressed.value = [](const Vector&, double t) -> Vector { return -0.25e6 * t * Vector::UnitZ(); };
  const std::string said = said_of_cube(pressed);
  for (const char* part : {"in region \"body\" is distorted most: J = 0.", "principal stretches", "a finer mesh",
                           "loading.maximum_increment", "displacements in place of tractions"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  for (const char* part : {"maximum_dissipation", "maximum_iterations", "crack", "damage"})
    EXPECT_EQ(said.find(part), std::string::npos) << said;
}

// Pressed by displacements to a hundredth of its height: no tractions to replace, also where it is free sideways.
TEST(FiniteStop, SpeaksOfTractionsOnlyWhereThereAreAny) {
  const std::string said = said_of_cube(moved(
      "zmax", {false, false, true}, [](const Vector&, double t) -> Vector { return -0.99 * t * Vector::UnitZ(); }));
  EXPECT_NE(said.find("is distorted most"), std::string::npos) << said;
  EXPECT_EQ(said.find("tractions"), std::string::npos) << said;
}

}  // namespace
}  // namespace pfdm::verification::this_file
