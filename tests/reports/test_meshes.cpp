// Meshes as other programs write them.

#include "tests/reports/reported_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The right forces are those of finite elements: linear ones on the same mesh; ten-node tetrahedra, refined.
TEST(ReportedMeshes, HaveLineCellsAndNoSurfaces) {
  const ReportedCase bridge("02_vtk_line_cells");
  const Outcome run = bridge.run("run");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(bridge.json("summary.json")["peak_force_N"].get<double>(), 50298.0, 0.005 * 50298.0);
}

TEST(ReportedMeshes, HaveNoCellsOfTheirVolumes) {
  const Outcome check = ReportedCase("03_msh_only_surfaces").run("check");
  EXPECT_EQ(check.status, 2);
  EXPECT_THAT(check.err, AllOf(HasSubstr("it has no volume cells: none of its volumes is in a physical group"),
                               HasSubstr("Define a Physical Volume"), HasSubstr("Mesh.SaveAll = 1")));
}

// Prisms of height 1 mm over regular polygons of radius 1 mm.
TEST(ReportedMeshes, HavePrismsOfFiveAndSixSides) {
  for (const auto& [file, volume] :
       {std::pair{"case5.toml", "volume: 2.37764e-09 m^3"}, {"case6.toml", "volume: 2.59808e-09 m^3"}}) {
    const ReportedCase prism("05_vtk_prisms_5_6");
    const Outcome mesh = prism.run("mesh", file);
    EXPECT_EQ(mesh.status, 0) << mesh.err;
    EXPECT_THAT(mesh.out, AllOf(HasSubstr("1 cells: 1 polyhedra"), HasSubstr(volume)));
  }
}

// The cube of 2 mm whose sides share no points is that of STL: the same mesh about it.
TEST(ReportedMeshes, RepeatThePointsOfEachFace) {
  const ReportedCase cube("09_obj_points_of_each_face");
  const Outcome obj = cube.run("check"), stl = cube.run("check", "stl.toml");
  EXPECT_EQ(obj.status, 0) << obj.err;
  EXPECT_THAT(obj.out, HasSubstr("surface: 16 of its points coincide with others and are merged"));
  const auto cells = [](const std::string& out) { return out.substr(out.find("\ncells "), 15); };
  EXPECT_EQ(cells(obj.out), cells(stl.out));
}

}  // namespace
}  // namespace pfdm::this_file
