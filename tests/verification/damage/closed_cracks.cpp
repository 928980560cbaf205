// Cracks right through a plate that are pressed shut or sheared, with each energy split.

#include "tests/verification/damage/split_plates.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

std::vector<BoundaryCondition> pressed(double displacement, double sideways = 0.0) {
  const auto fixed = [](const Vector&) -> Vector { return Vector::Zero(); };
  return {displacement_on("ymin", fixed), plane_on("zmin"), plane_on("zmax"),
          displacement_on("ymax", [=](const Vector&) -> Vector {
            return {sideways, displacement, 0.0};
          })};
}

CellField<double> broken_row(const Mesh& mesh) {
  CellField<double> damage(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (std::abs(mesh.cell_centre[c][1] - 0.5) < 0.01) damage[c] = 1.0;
  return damage;
}

// A crack right through a plate in plane strain, pulled and pressed.
void expect_recovery(const char* split, bool sides_may_move) {
  SCOPED_TRACE(split);
  const Mesh mesh = plate(15);
  const auto force = [&](double displacement, bool broken) {
    FractureModel model = damaged_model(energy_split(split), pressed(displacement));
    if (!sides_may_move)
      for (const char* side : {"xmin", "xmax"}) model.boundary.push_back(symmetry_on(side));
    const Equilibrated on =
        equilibrium(mesh, model, broken ? broken_row(mesh) : CellField<double>(mesh.n_cells(), 0.0));
    report_row(std::string(split) + (broken ? ", broken" : ", sound"),
               {{"displacement", displacement},
                {"force", reaction(mesh, on, "ymax")[1]},
                {"iterations", static_cast<double>(on.iterations)},
                {"of FGMRES", static_cast<double>(on.krylov)}});
    EXPECT_LE(on.iterations, 14);
    return reaction(mesh, on, "ymax")[1];
  };
  const double sound = force(1e-3, false), pulled = force(1e-3, true), pressed_shut = force(-1e-3, true);
  report_row(std::string(split) + ", over the sound plate's",
             {{"pulled", pulled / sound}, {"pressed shut, and 1", pressed_shut / sound + 1.0}});
  EXPECT_NEAR(pulled, 0.0, 4e-5 * sound);
  EXPECT_NEAR(pressed_shut, -sound, (sides_may_move ? 1e-4 : 1e-11) * sound);
  EXPECT_NEAR(force(-1e-3, false), -sound, 1e-9 * sound);
}

// Pulled, the plate parts; pressed shut, it is as stiff as a sound one.
TEST(EnergySplits, AClosedCrackRecoversTheStiffness) {
  expect_recovery("spectral", false);
  expect_recovery("no_tension", false);
  expect_recovery("no_tension", true);  // the spectral split loses what resists the expansion to the sides
}

// Sheared to one side and to the other: mirror images.
TEST(EnergySplits, ShearDoesNotKnowLeftFromRight) {
  const Mesh mesh = plate(15);
  for (const char* split : {"volumetric_deviatoric", "spectral", "no_tension"}) {
    SCOPED_TRACE(split);
    const auto force = [&](double sideways) {
      return reaction(mesh,
                      equilibrium(mesh, damaged_model(energy_split(split), pressed(-5e-4, sideways)), broken_row(mesh)),
                      "ymax");
    };
    const Vector right = force(1e-3), left = force(-1e-3);
    EXPECT_NEAR(right[0], -left[0], 1e-6 * right.norm());
    EXPECT_NEAR(right[1], left[1], 1e-6 * right.norm());
    EXPECT_GT(right[0], 0.0);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
