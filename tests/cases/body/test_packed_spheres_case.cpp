// Many spheres in a case file: meshed as they were asked for, pulled with cohesive interfaces, and what is refused.

#include "postproc/files/csv_table.h"
#include "tests/cases/pulled_composite.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

// Five glass spheres in a soft matrix.
std::string composite() {
  return R"(kind = "fracture"
title = "spheres in a matrix"
[mesh]
generator = "packed_spheres"
size = ["1 mm", "1 mm", "1 mm"]
count = 5
volume_fraction = 0.1
gap = "20 um"
subdivisions = 2
edges_over_gap = 0
)" + pulled_composite("particle");
}

// The lower bound of Hashin and Shtrikman for a tenth of rigid spheres is 1.22 times Young's modulus of this matrix.
TEST(PackedSpheresCase, StiffensTheBlock) {
  const auto force = [](const std::string& text) {
    const TemporaryCase directory(text);
    const Outcome outcome = run({"run", directory.path().string(), "--quiet", "--threads", "1"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_csv(directory.results() / "force_displacement.csv").column("force_z_N").back();
  };
  const std::string soft =
      replaced(replaced(composite(), "\"70 GPa\"", "\"1 MPa\""), "poisson_ratio = 0.2", "poisson_ratio = 0.3");
  const std::string strong = replaced(composite(), "\"0.1 MPa\"", "\"1 MPa\"");
  const double with = force(strong), without = force(replaced(soft, "\"0.1 MPa\"", "\"1 MPa\""));
  EXPECT_GT(with, 1.15 * without);
  EXPECT_LT(with, 1.6 * without);
}

TEST(PackedSpheresCase, MeshHasTheVolumeThatWasAskedFor) {
  const TemporaryCase directory(composite());
  const Outcome outcome = run({"mesh", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("particle"));
}

// Bricks in place of the spheres.
std::string bricks() {
  std::string text = replaced(composite(), "subdivisions = 2\nedges_over_gap = 0\n", "surface_size = \"150 um\"\n");
  return replaced(text, "[materials.glass]", "[[mesh.shapes]]\nsurface = \"brick.obj\"\n[materials.glass]");
}

constexpr const char* brick_obj =
    "# synthetic: a brick\n"
    "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 1\nv 3 0 1\nv 3 2 1\nv 0 2 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(PackedSpheresCase, TakesShapesInPlaceOfSpheres) {
  const TemporaryCase directory(bricks());
  directory.write("brick.obj", brick_obj);
  const Outcome outcome = run({"run", directory.path().string(), "--threads", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(read_csv(directory.results() / "force_displacement.csv").column("force_z_N").back(), 0.0);
  const std::string copy = (directory.path() / "copy").string();
  EXPECT_EQ(run({"init", copy, "--like", directory.path().string()}).status, 0);
  EXPECT_EQ(run({"check", copy}).status, 0);
  directory.write("brick.obj", replaced(brick_obj, "f 4 1 5 8\n", ""));
  const Outcome open = run({"check", directory.path().string()});
  EXPECT_EQ(open.status, 2);
  EXPECT_THAT(open.err, HasSubstr("is not closed"));
  for (const auto& [good, bad, said] :
       {std::tuple("surface_size = \"150 um\"", "subdivisions = 2", "\"surface_size\" is missing"),
        std::tuple("gap = \"20 um\"", "gap = \"20 um\"\nedges_over_gap = 1", "it belongs to spheres"),
        std::tuple("\"brick.obj\"", "\"brick.obj\"\nlength_unit = \"mm\"", "\"length_unit\" is not known here")}) {
    const TemporaryCase other(replaced(bricks(), good, bad));
    other.write("brick.obj", brick_obj);
    const Outcome refused = run({"check", other.path().string()});
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr(said));
  }
}

class BadSpheres : public testing::TestWithParam<BadInput> {};

TEST_P(BadSpheres, AreRefused) {
  const TemporaryCase directory(replaced(composite(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_inputs[] = {
    {"too_little_said", "count = 5\n", "", {"[mesh] say which spheres: two of diameter, count and volume_fraction"}},
    {"more_than_can_be_packed", "volume_fraction = 0.1", "volume_fraction = 0.7", {"must be between 0 and 0.6"}},
    {"no_room",
     "volume_fraction = 0.1",
     "volume_fraction = 0.55",
     {"[mesh]", "5 spheres with gaps of 20 um found no room", "% smaller"}},
    {"triangles_without_end",
     "volume_fraction = 0.1",
     "volume_fraction = 0.1\nboundary_size = \"1 nm\"",
     {"[mesh]", "the surface of the box would get ", "triangles of 1 nm; at most 1e+07"}},
    {"tetrahedra_without_end",
     "volume_fraction = 0.1",
     "volume_fraction = 0.1\nsize_far = \"10 nm\"",
     {"[mesh]", "tetrahedra of 10 nm (size_far), too many to number"}},
    {"tetrahedra_better_than_regular",
     "volume_fraction = 0.1",
     "volume_fraction = 0.1\nmax_radius_edge_ratio = 0.5",
     {"max_radius_edge_ratio: 0.5 must be between 1.1 and 1000"}},
    {"cells_without_end_inside",
     "volume_fraction = 0.1",
     "volume_fraction = 0.1\nparticle_size_factor = 1e-3",
     {"particle_size_factor: 0.001 must be at least 1"}},
    {"no_gap", "gap = \"20 um\"\n", "", {"\"gap\" is missing"}},
    {"placed_and_drawn",
     "gap = \"20 um\"",
     "gap = \"20 um\"\nspheres = [{ diameter = \"100 um\", centre = [\"0 mm\", \"0 mm\", \"0 mm\"] }]",
     {"it cannot be combined with [[mesh.spheres]]"}},
    {"unknown_distribution",
     "count = 5\n",
     "diameter = { distribution = \"normal\" }\n",
     {"[mesh.diameter] distribution: ", "\"normal\" is not a distribution of diameters (allowed: uniform, lognormal)"}},
    {"distribution_upside_down",
     "count = 5\n",
     "diameter = { distribution = \"uniform\", least = \"2 um\", most = \"1 um\" }\n",
     {"the largest diameter (most) is smaller than the smallest (least)"}},
    {"diameters_that_do_not_fill",
     "count = 5\n",
     "diameter = \"0.9 mm\"\n",
     {"no whole number of such spheres has the volume fraction wanted"}},
    {"spheres_that_overlap",
     "count = 5\nvolume_fraction = 0.1\n",
     "spheres = [{ diameter = \"200 um\", centre = [\"0 mm\", \"0 mm\", \"0 mm\"] }, { diameter = \"200 um\", centre = "
     "[\"0.1 mm\", \"0 mm\", \"0 mm\"] }]\n",
     {"[mesh]", "overlap or touch"}},
};
INSTANTIATE_TEST_SUITE_P(All, BadSpheres, testing::ValuesIn(bad_inputs),
                         [](const auto& input) { return input.param.name; });

}  // namespace
}  // namespace pfdm::this_file
