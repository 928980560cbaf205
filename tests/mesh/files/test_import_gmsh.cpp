#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "mesh/files/import_mesh.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/temporary_folder.h"

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// data/shapes.geo: hexahedra, prisms, pyramids and tetrahedra, as Gmsh 4.8 has written it in its formats.
constexpr const char* formats[] = {"41_text", "41_binary", "22_text", "22_binary"};

std::filesystem::path shapes(const std::string& format) {
  return std::filesystem::path(PFDM_TEST_DATA) / ("shapes_" + format + ".msh");
}

ImportSettings settings_of(const std::filesystem::path& file) {
  ImportSettings settings;
  settings.file = file;
  return settings;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ImportGmsh : public ::testing::Test {
 protected:
  ImportSettings write(const std::string& content) const {
    std::ofstream(folder_ / "mesh.msh", std::ios::binary) << content;
    return settings_of(folder_ / "mesh.msh");
  }

  // What is said of a file of that content.
  std::string refusal(const std::string& content) const {
    std::string message = message_of<InputError>([&] { import_gmsh(write(content)); });
    EXPECT_THAT(message, HasSubstr((folder_ / "mesh.msh").string()));
    return message;
  }

  test::TemporaryFolder folder_;
};

// Of the format 2.2: points, then elements as "type group points".
std::string msh22(const std::vector<Vector>& points, const std::vector<std::string>& elements,
                  const std::string& names = "") {
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n" + std::to_string(points.size()) + "\n";
  for (std::size_t p = 0; p < points.size(); ++p)
    text += std::to_string(p + 1) + " " + std::to_string(points[p].x()) + " " + std::to_string(points[p].y()) + " " +
            std::to_string(points[p].z()) + "\n";
  text += "$EndNodes\n$Elements\n" + std::to_string(elements.size()) + "\n";
  for (std::size_t e = 0; e < elements.size(); ++e) text += std::to_string(100 + e) + " " + elements[e] + "\n";
  return text + "$EndElements\n";
}

const std::vector<Vector> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST_F(ImportGmsh, AllFormatsGiveOneMesh) {
  for (const char* format : formats) {
    SCOPED_TRACE(format);
    const Mesh mesh = import_gmsh(settings_of(shapes(format)));
    expect_sound(mesh);
    EXPECT_EQ(count_cells(mesh, CellShape::hexahedron), 4);
    EXPECT_EQ(count_cells(mesh, CellShape::wedge), 6);
    EXPECT_EQ(count_cells(mesh, CellShape::pyramid), 4);
    EXPECT_EQ(count_cells(mesh, CellShape::tetrahedron), 30);
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"block", "roof of tetrahedra"}));
    EXPECT_NEAR(region_volume(mesh, "block"), 1.5, 1e-12);
    EXPECT_NEAR(region_volume(mesh, "roof of tetrahedra"), 1.0 / 3.0, 1e-12);
  }
}

TEST_F(ImportGmsh, PhysicalSurfacesArePatches) {
  for (const char* format : formats) {
    SCOPED_TRACE(format);
    const Mesh mesh = import_gmsh(settings_of(shapes(format)));
    std::set<std::string> names;
    for (const Patch& patch : mesh.patches) names.insert(patch.name);
    // "between" lies within the body.
    EXPECT_EQ(names, (std::set<std::string>{"bottom", "slope", "patch_12", "walls"}));
    EXPECT_NEAR((patch_area(mesh, "bottom") - Vector(0, 0, -1.5)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((patch_area(mesh, "slope") - Vector(0, 0, 1)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((patch_area(mesh, "patch_12") - Vector(0, -1, 0)).norm(), 0.0, 1e-12);
  }
}

TEST_F(ImportGmsh, TheCaseMayNameGroups) {
  ImportSettings settings = settings_of(shapes("41_binary"));
  settings.scale = 1e-3;
  settings.region_names = {{1, "glass"}};
  settings.face_sets = {{12, "front"}};
  const Mesh mesh = import_gmsh(settings);
  EXPECT_NEAR(region_volume(mesh, "glass"), 1.5e-9, 1e-20);
  EXPECT_EQ(mesh.patch("front").n_faces, 2);
  settings.face_sets = {{77, "front"}};
  EXPECT_THAT(message_of<InputError>([&] { import_gmsh(settings); }), HasSubstr("77"));
}

TEST_F(ImportGmsh, WithoutGroupsThereIsOneBodyWithItsSides) {
  const Mesh mesh = import_gmsh(write(msh22(corners, {"4 2 0 1 1 2 3 4"})));
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"body"});
  EXPECT_EQ(mesh.patch("zmin").n_faces, 1);
}

TEST_F(ImportGmsh, OtherSectionsAreSkipped) {
  const std::string mesh = msh22(corners, {"4 2 0 1 1 2 3 4"});
  const Mesh read = import_gmsh(write(mesh + "$NodeData\n1\n\"a view\"\n0\n$EndNodeData\n"));
  EXPECT_EQ(read.n_cells(), 1);
}

TEST_F(ImportGmsh, ElementsOfSecondOrderAreRefused) {
  std::vector<Vector> points = corners;
  for (const Index a : {0, 1, 2})
    for (const Index b : {1, 2, 3})
      if (a < b) points.emplace_back(0.5 * (corners[a] + corners[b]));
  EXPECT_THAT(refusal(msh22(points, {"11 2 0 1 1 2 3 4 5 8 6 7 10 9"})),
              AllOf(HasSubstr("element 100"), HasSubstr("type 11"), HasSubstr("Mesh.ElementOrder = 1")));
}

TEST_F(ImportGmsh, GroupsThatOverlapAreRefused) {
  const std::string names = "$PhysicalNames\n2\n3 1 \"bead\"\n3 2 \"all\"\n$EndPhysicalNames\n";
  EXPECT_THAT(refusal(msh22(corners, {"4 2 1 1 1 2 3 4", "4 2 2 1 1 2 3 4"}, names)),
              AllOf(HasSubstr("volume element 100"), HasSubstr("\"bead\""), HasSubstr("\"all\"")));
  std::string shapes_41 = content_of(shapes("41_text"));
  const std::size_t at = shapes_41.find(" 1 1 6 ");
  ASSERT_NE(at, std::string::npos);
  shapes_41.replace(at, 7, " 2 1 2 6 ");
  EXPECT_THAT(refusal(shapes_41), AllOf(HasSubstr("volume 1"), HasSubstr("\"block\""), HasSubstr("\"roof of")));
}

TEST_F(ImportGmsh, PartitionsAreRefused) {
  EXPECT_THAT(refusal(msh22(corners, {"4 4 0 1 1 1 1 2 3 4"})), HasSubstr("partitioned"));
  std::string shapes_41 = content_of(shapes("41_text"));
  shapes_41.replace(shapes_41.find("$Nodes"), 0, "$PartitionedEntities\n1\n$EndPartitionedEntities\n");
  EXPECT_THAT(refusal(shapes_41), HasSubstr("partitioned"));
}

TEST_F(ImportGmsh, BrokenFilesAreRefusedWithThePlace) {
  const std::string good = msh22(corners, {"4 2 0 1 1 2 3 4"});
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("solid"), HasSubstr("$Nodes"));
  EXPECT_THAT(refusal("$Nodes\n"), HasSubstr("$MeshFormat"));
  EXPECT_THAT(refusal("$MeshFormat\n4 0 8\n$EndMeshFormat\n"), AllOf(HasSubstr("format 4;"), HasSubstr("msh41")));
  EXPECT_THAT(refusal(good.substr(0, good.size() - 30)), HasSubstr("ends within $Elements"));
  EXPECT_THAT(refusal(msh22(corners, {"4 2 0 1 1 2 3 9"})), AllOf(HasSubstr("element 100"), HasSubstr("node 9")));
  EXPECT_THAT(refusal(msh22(corners, {"4 2 0 1 1 2 3 x"})), AllOf(HasSubstr("line 13"), HasSubstr("\"x\"")));
  EXPECT_THAT(refusal(msh22(corners, {"2 2 0 1 1 2 3"})), HasSubstr("no volume cells"));
  EXPECT_THAT(refusal(msh22(corners, {"4 2 -2147483648 1 1 2 3 4"})),
              HasSubstr("expected the number of a physical group, found -2147483648"));
  for (const char* format : {"41_binary", "22_binary"})
    EXPECT_THAT(refusal(content_of(shapes(format)).substr(0, 3000)), HasSubstr("ends within $")) << format;
  EXPECT_THAT(message_of<InputError>([&] { import_gmsh(settings_of(folder_ / "none.msh")); }),
              HasSubstr("No such file"));
}

// A square in the plane z = 0.5 of a quadrilateral, and a triangle beside it whose points run the other way.
std::string flat_msh(const std::string& names = "") {
  return msh22({{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}, {2, 0, 0.5}},
               {"3 2 5 1 1 2 3 4", "2 2 6 1 2 3 5", "1 2 7 1 4 1", "1 2 8 1 2 5", "15 2 9 1 1"}, names);
}

TEST_F(ImportGmsh, AFlatMeshBecomesALayerOfCells) {
  const std::string names = "$PhysicalNames\n2\n1 7 \"left\"\n2 5 \"plate\"\n$EndPhysicalNames\n";
  ImportSettings settings = write(flat_msh(names));
  settings.scale = 1e-3;
  settings.thickness = 2e-4;
  const Mesh mesh = import_gmsh(settings);
  expect_sound(mesh);
  EXPECT_EQ(count_cells(mesh, CellShape::hexahedron), 1);
  EXPECT_EQ(count_cells(mesh, CellShape::wedge), 1);
  EXPECT_NEAR(region_volume(mesh, "plate"), 2e-10, 1e-20);
  EXPECT_NEAR(region_volume(mesh, "region_6"), 1e-10, 1e-20);
  EXPECT_NEAR((patch_area(mesh, "left") - Vector(-2e-7, 0, 0)).norm(), 0.0, 1e-18);
  EXPECT_NEAR((patch_area(mesh, "patch_8") - Vector(0, -2e-7, 0)).norm(), 0.0, 1e-18);
  EXPECT_NEAR((patch_area(mesh, "zmin") - Vector(0, 0, -1.5e-6)).norm(), 0.0, 1e-18);
  EXPECT_NEAR((patch_area(mesh, "zmax") - Vector(0, 0, 1.5e-6)).norm(), 0.0, 1e-18);
  for (const Vector& x : mesh.points) EXPECT_TRUE(std::abs(x.z() - 5e-4) < 1e-12 || std::abs(x.z() - 7e-4) < 1e-12);
}

TEST_F(ImportGmsh, WithoutVolumesItSaysWhy) {
  EXPECT_THAT(refusal(flat_msh()), AllOf(HasSubstr("it has no volume cells: it is flat"), HasSubstr("thickness = ")));
  EXPECT_THAT(refusal(msh22(corners, {"2 2 1 1 1 2 3", "2 2 1 1 1 2 4"})),
              AllOf(HasSubstr("it has no volume cells"), HasSubstr("no Physical Volume")));
  ImportSettings settings = write(msh22(corners, {"4 2 0 1 1 2 3 4"}));
  settings.thickness = 1.0;
  EXPECT_THAT(message_of<InputError>([&] { import_gmsh(settings); }),
              HasSubstr("a thickness is given, and it is not flat"));
}

TEST_F(ImportGmsh, HangingPointsAreRefused) {
  // A cube beside two half ones.
  std::vector<Vector> points{{0, 0, 0},   {1, 0, 0},   {1, 1, 0},   {0, 1, 0},  {0, 0, 1}, {1, 0, 1},
                             {1, 1, 1},   {0, 1, 1},   {2, 0, 0},   {2, 1, 0},  {2, 0, 1}, {2, 1, 1},
                             {1, 0, 0.5}, {1, 1, 0.5}, {2, 0, 0.5}, {2, 1, 0.5}};
  EXPECT_THAT(refusal(msh22(points, {"5 2 0 1 1 2 3 4 5 6 7 8", "5 2 0 1 2 9 10 3 13 15 16 14",
                                     "5 2 0 1 13 15 16 14 6 11 12 7"})),
              AllOf(HasSubstr("do not match"), HasSubstr("(1, 0, 0.5)"), HasSubstr("hanging node")));
}

TEST_F(ImportGmsh, TrianglesOnAQuadrilateralAreRefused) {
  std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                             {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {1, 0, 2}, {0, 1, 2}};
  EXPECT_THAT(refusal(msh22(points, {"5 2 0 1 1 2 3 4 5 6 7 8", "4 2 0 1 5 6 7 9", "4 2 0 1 5 7 8 10"})),
              AllOf(HasSubstr("do not match"), HasSubstr("(0.5, 0.5, 1)"), HasSubstr("pyramids")));
}

}  // namespace
}  // namespace pfdm::this_file
