// Compressible layers that are held on both faces and pulled, against quadratic elements (layered_elements.py): how
// much too soft coarse ones are, and what is said of it.

#include "mesh/generators/cylinder_sector.h"
#include "solver/fracture/words/stiffness_words.h"
#include "tests/verification/slender/cell_beams.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

constexpr double azimuth = std::numbers::pi / 36.0;

// Forces by unit nominal strain, thickness 1, E 1: a disc of radius 5; half a strip 6 wide, and with it between plates
// of its thickness, E 1000.
struct Reference {
  double nu, disc, strip, plates;
};
const std::vector<Reference> references{
    {0.35, 117.073, 4.52609, 13.5397}, {0.44, 201.307, 7.91925, 23.6296}, {0.469, 302.871, 12.0187, 35.7503}};

Vector nothing(const Vector&) { return Vector::Zero(); }

struct Found {
  double error = 0.0;  // stiffness over that of the elements, less 1
  std::string warning;
};

Found compare(const std::string& label, const Mesh& mesh, const FractureModel& model, const std::string& top,
              const Vector& up, double scale) {
  const auto solution = solve_elastic(mesh, model, {}, 1e-9);
  EXPECT_TRUE(solution->equilibrium.converged);
  Found found{.error = reactions(mesh, *solution)[mesh.patch_index(top)].dot(up) * scale - 1.0, .warning = {}};
  for (const std::string& warning : stiffness_warnings(mesh, model)) found.warning += warning;
  report_row(label, {{"stiffness, less 1", found.error}, {"warned", found.warning.empty() ? 0.0 : 1.0}});
  return found;
}

// A warning where the error is above 4 %, within two thirds; none below 2 %.
void expect_truth(const Found& found) {
  const std::size_t at = found.warning.find("about ");
  const double said = at == std::string::npos ? 0.0 : 0.01 * std::stod(found.warning.substr(at + 6));
  if (found.error < -0.04) {
    EXPECT_NEAR(-said / found.error, 1.0, 0.67) << found.warning;
  }
  if (found.error > -0.02) {
    EXPECT_EQ(found.warning, "");
  }
}

// Half of it, on a plane of symmetry, or all.
TEST(ConfinedLayers, Discs) {
  for (const Reference& of : references)
    for (const bool is_half : {true, false})
      for (const Index layers : {2, 4, 8}) {
        const double height = is_half ? 0.5 : 1.0;
        const Mesh mesh = make_cylinder_sector({.azimuth = azimuth,
                                                .radius = {{5.0, 5 * layers / 2, 1.0}},
                                                .height = {{height, is_half ? layers / 2 : layers, 1.0}}});
        const FractureModel model =
            elastic_model({from_young_poisson(1.0, of.nu)},
                          {axisymmetric_on("front"), axisymmetric_on("back"),
                           is_half ? symmetry_on("bottom") : displacement_on("bottom", nothing),
                           displacement_on("top", [=](const Vector&) -> Vector { return height * Vector::UnitZ(); })});
        expect_truth(compare(fmt::format("disc, nu {}, {} layers{}", of.nu, layers, is_half ? ", half" : ""), mesh,
                             model, "top", Vector::UnitZ(), 2.0 * std::numbers::pi / std::sin(azimuth) / of.disc));
      }
}

FractureModel pulled(std::vector<IsotropicElasticity> moduli, bool is_plane, double height) {
  const auto side = is_plane ? plane_on : symmetry_on;
  return elastic_model(moduli,
                       {side("zmin"), side("zmax"), symmetry_on("xmin"), displacement_on("ymin", nothing),
                        displacement_on("ymax", [=](const Vector&) -> Vector { return height * Vector::UnitY(); })});
}

TEST(ConfinedLayers, StripsOfAllCells) {
  for (const Reference& of : references)
    for (const BoxCut cut :
         {BoxCut::prisms_across, BoxCut::prisms_within, BoxCut::prisms_along, BoxCut::six_tetrahedra})
      for (const Index layers : {2, 4, 8}) {
        const double size = 1.0 / static_cast<double>(layers);
        const Mesh mesh = make_cell_beam({.cut = cut, .boxes = {3 * layers, layers, 1}, .size = {3.0, 1.0, size}});
        expect_truth(compare(fmt::format("strip {}, nu {}, {} layers", static_cast<int>(cut), of.nu, layers), mesh,
                             pulled({from_young_poisson(1.0, of.nu)}, false, 1.0), "ymax", Vector::UnitY(),
                             1.0 / (size * of.strip)));
      }
}

TEST(ConfinedLayers, BetweenStiffPlates) {
  for (const Reference& of : references)
    for (const bool is_plane : {true, false})
      for (const Index layers : {2, 4, 8}) {
        BoxHexesSettings box;
        box.axes[0] = {{3.0, 3 * layers, 1.0}};
        box.axes[1] = {{3.0, 3 * layers, 1.0}};
        box.axes[2] = {{1.0, 1, 1.0}};
        box.base_region = "plate";
        box.regions = {{.name = "layer", .lower = {-1.0, 1.0, -1.0}, .upper = {9.0, 2.0, 9.0}}};
        const Mesh mesh = make_box_hexes(box);
        const Found found =
            compare(fmt::format("between plates, nu {}, {} layers{}", of.nu, layers, is_plane ? ", plane" : ""), mesh,
                    pulled({from_young_poisson(1000.0, 0.3), from_young_poisson(1.0, of.nu)}, is_plane, 3.0), "ymax",
                    Vector::UnitY(), 1.0 / of.plates);
        expect_truth(found);
        if (!found.warning.empty()) {
          EXPECT_NE(found.warning.find("region \"layer\""), std::string::npos) << found.warning;
        }
      }
}

// A face that is free, or beside a material that is three times as stiff, does not hold it; a moderate Poisson's ratio
// needs little.
TEST(ConfinedLayers, OthersAreNotWarnedOf) {
  const Mesh mesh = make_cell_beam({.cut = BoxCut::prisms_along, .boxes = {6, 2, 1}, .size = {3.0, 1.0, 0.5}});
  FractureModel model = pulled({from_young_poisson(1.0, 0.44)}, false, 1.0);
  EXPECT_EQ(stiffness_warnings(mesh, model).size(), 1u);
  model.boundary.back() = traction_on("ymax", [](const Vector&) -> Vector { return Vector::UnitY(); });
  EXPECT_TRUE(stiffness_warnings(mesh, model).empty());
  EXPECT_TRUE(stiffness_warnings(mesh, pulled({from_young_poisson(1.0, 0.25)}, false, 1.0)).empty());
  EXPECT_TRUE(
      stiffness_warnings(mesh, pulled({from_young_poisson(1.0, 0.49)}, false, 1.0)).empty());  // it has pressures
}

}  // namespace
}  // namespace pfdm::verification::this_file
