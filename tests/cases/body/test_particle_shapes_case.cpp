// Particles from surface files in a case: meshed, with a cohesive interface, and what is refused.

#include "postproc/files/csv_table.h"
#include "tests/cases/pulled_composite.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

std::string cube() {
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 1 5 8 4\n";
}

// A cube of 0.4 mm in the middle of a box of 1 mm, its interface as strong as `particle` leaves it.
std::string block(const std::string& particle) {
  return R"(kind = "fracture"
title = "a cube in a matrix"
[mesh]
generator = "particles_in_box"
size = ["1 mm", "1 mm", "1 mm"]
[[mesh.particles]]
surface = "cube.obj"
)" + particle +
         "\n" + pulled_composite("bead");
}

std::string placed() { return "length_unit = \"mm\"\nscale = 0.4\nsurface_size = \"0.15 mm\"\n"; }

Outcome with_surface(const TemporaryCase& directory, const std::string& surface, const std::string& command) {
  directory.write("cube.obj", surface);
  return run({command, directory.path().string(), "--quiet"});
}

double force_of(const std::string& particle) {
  const TemporaryCase directory(block(particle));
  const Outcome outcome = with_surface(directory, cube(), "run");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return read_csv(directory.results() / "force_displacement.csv").column("force_z_N").back();
}

// Volume fraction of the particle, by the mesh.
double fraction_of(const std::string& particle) {
  const std::string fracture = block(particle);
  std::string text = replaced(fracture.substr(0, fracture.find("[[interface]]")), "fracture", "homogenize");
  for (int i = 0; i < 2; ++i) text.erase(text.find("damageable = false\n"), 19);
  const TemporaryCase directory(text + "[homogenization]\nboundary = \"uniform displacement\"\n");
  const Outcome outcome = with_surface(directory, cube(), "run");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto results = nlohmann::json::parse(content_of(directory.results() / "homogenized.json"));
  for (const auto& phase : results["phases"])
    if (phase["material"] == "glass") return phase["volume_fraction"];
  return 0.0;
}

TEST(ParticleShapesCase, ScalesACubeByUnitOrByVolume) {
  EXPECT_NEAR(fraction_of(placed()), 0.4 * 0.4 * 0.4, 1e-9);
  // The sphere of a volume of 0.027 mm3, a cube of 0.3 mm.
  const double diameter = 0.3 * std::cbrt(6.0 / std::numbers::pi);
  EXPECT_NEAR(fraction_of("diameter = \"" + std::to_string(diameter) + " mm\"\nsurface_size = \"0.15 mm\"\n"), 0.027,
              1e-6);
}

TEST(ParticleShapesCase, CarriesACohesiveInterface) {
  const double force = force_of(placed());
  // Between the matrix alone and the cube bonded across the box (Voigt of the prism below and above it).
  EXPECT_GT(force, 10e-3);
  EXPECT_LT(force, 10e-3 * (0.84 + 0.16 / 0.6) * 1.3);
  // A cube is the same after a quarter of a turn, but for its triangles.
  EXPECT_NEAR(force_of(placed() + "axis = [1, 0, 0]\nangle = \"90 degree\"\n") / force, 1.0, 0.01);
}

TEST(ParticleShapesCase, SaysWhatIsWrong) {
  const auto message = [](const std::string& particle, const std::string& surface, const char* command = "check") {
    const TemporaryCase directory(block(particle));
    const Outcome outcome = with_surface(directory, surface, command);
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  const std::string open = cube().substr(0, cube().rfind('f'));
  EXPECT_THAT(message(placed(), open), AllOf(HasSubstr("surface"), HasSubstr("cube.obj"), HasSubstr("is not closed")));
  EXPECT_THAT(message(placed(), "v 0 0 0\nf 1 2 3\n"), AllOf(HasSubstr("line 2"), HasSubstr("no point 2")));
  EXPECT_THAT(message("surface_size = \"0.1 mm\"\n", cube()), HasSubstr("either length_unit"));
  EXPECT_THAT(message("length_unit = \"mm\"\n", cube()), HasSubstr("surface_size"));
  EXPECT_THAT(message(placed() + "subdivisions = 3\n", cube()), HasSubstr("subdivisions"));
  EXPECT_THAT(message("diameter = \"1 mm\"\nscale = 2\nsurface_size = \"0.1 mm\"\n", cube()), HasSubstr("scale"));
  const std::string unit = "length_unit = \"mm\"\nscale = 0.4\n";
  EXPECT_THAT(message(unit + "surface_size = \"10 nm\"\n", cube(), "mesh"), HasSubstr("2.2e+10 triangles"));
  // Bodies of a few triangles collapse, and CGAL's relaxation of what is left may crash, by rounding.
  EXPECT_THAT(message(unit + "surface_size = \"0.6 mm\"\nsharp_angle = \"120 degree\"\n", cube(), "mesh"),
              AnyOf(HasSubstr("of its volume"), HasSubstr("CGAL crashes")));
}

}  // namespace
}  // namespace pfdm::this_file
