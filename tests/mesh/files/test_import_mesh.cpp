#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "mesh/files/import_mesh.h"
#include "mesh/generators/box_hexes.h"
#include "mesh/generators/particles_in_box.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/vtu_text.h"
#include "tests/temporary_folder.h"

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ImportVtk : public ::testing::Test {
 protected:
  ImportSettings write(const VtuText& text, const std::string& name = "mesh.vtu") const {
    ImportSettings settings;
    settings.file = folder_ / name;
    if (settings.file.extension() == ".vtk")
      text.write_legacy(settings.file);
    else
      text.write_vtu(settings.file);
    return settings;
  }

  test::TemporaryFolder folder_;
};

VtuText tetrahedron() {
  VtuText text;
  text.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  text.cells = {{10, {0, 1, 2, 3}, {}}};
  return text;
}

// Two unit cubes side by side, with quadrilaterals on both ends and between them, and a stray point and line.
VtuText two_cubes() {
  BoxHexesSettings settings;
  settings.axes = {{{{2.0, 2, 1.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}};
  VtuText text = vtu_text(make_box_hexes(settings));
  text.cell_arrays.clear();
  const auto end = [](Index i) { return std::vector<Index>{i, i + 3, i + 9, i + 6}; };
  for (const Index i : {0, 1, 2}) text.cells.push_back({9, end(i), {}});
  text.points.emplace_back(99, 99, 99);
  text.cells.push_back({3, {0, 12}, {}});
  return text;
}

void expect_same_cells(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.n_cells(), b.n_cells());
  EXPECT_EQ(a.n_faces(), b.n_faces());
  EXPECT_EQ(a.n_interior_faces(), b.n_interior_faces());
  EXPECT_EQ(a.points, b.points);
  std::vector<double> volumes_a = a.cell_volume.values();
  std::vector<double> volumes_b = b.cell_volume.values();
  std::ranges::sort(volumes_a);
  std::ranges::sort(volumes_b);
  for (std::size_t c = 0; c < volumes_a.size(); ++c) EXPECT_NEAR(volumes_a[c] / volumes_b[c], 1.0, 1e-12);
}

TEST_F(ImportVtk, WedgesAndTetrahedraComeBack) {
  const Mesh original = wedges_and_tetrahedra();
  for (const char* name : {"mesh.vtu", "mesh.vtk"}) {
    ImportSettings settings = write(vtu_text(original), name);
    settings.region_names = {{original.region_index("bead"), "glass"}};
    const Mesh mesh = import_vtk(settings);
    expect_sound(mesh);
    expect_same_cells(mesh, original);
    EXPECT_NEAR(region_volume(mesh, "glass") / region_volume(original, "bead"), 1.0, 1e-12);
    const std::string layers = "region_" + std::to_string(original.region_index("interface"));
    EXPECT_NEAR(region_volume(mesh, layers) / region_volume(original, "interface"), 1.0, 1e-12);
    ASSERT_EQ(mesh.patches.size(), 6U);
    for (const Patch& patch : original.patches) EXPECT_EQ(mesh.patch(patch.name).n_faces, patch.n_faces);
  }
}

TEST_F(ImportVtk, PolyhedraComeBack) {
  const Mesh original = wedges_and_tetrahedra();
  const Mesh mesh = import_vtk(write(vtu_text_of_polyhedra(original)));
  expect_sound(mesh);
  expect_same_cells(mesh, original);
  EXPECT_EQ(count_cells(mesh, CellShape::polyhedron), mesh.n_cells());
}

TEST_F(ImportVtk, PolyhedraAndOtherCellsMix) {
  VtuText text = two_cubes();
  VtuText polyhedra = vtu_text_of_polyhedra([] {
    BoxHexesSettings settings;
    settings.axes = {{{{2.0, 2, 1.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}};
    return make_box_hexes(settings);
  }());
  text.cells[1] = polyhedra.cells[1];
  const Mesh mesh = import_vtk(write(text));
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_interior_faces(), 1);
  EXPECT_EQ(mesh.points.size(), 12U);
}

TEST_F(ImportVtk, MirroredCellsAreTurned) {
  VtuText text;
  text.points = {{0, 0, 0}, {1, 0, 0},     {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
                 {0, 1, 1}, {0.5, 0.5, 2}, {2, 0, 0}, {2, 1, 0}, {2, 0, 1}, {2, 1, 1}, {0.5, 0.5, -1}};
  text.cells = {{13, {0, 1, 3, 4, 5, 7}, {}},
                {13, {1, 2, 3, 5, 6, 7}, {}},           // triangle 0 1 2 looking inwards
                {14, {4, 7, 6, 5, 8}, {}},              // base seen clockwise from the tip
                {12, {1, 2, 10, 9, 5, 6, 12, 11}, {}},  // bottom clockwise
                {10, {0, 1, 3, 13}, {}}};
  const Mesh mesh = import_vtk(write(text));
  expect_sound(mesh);
  EXPECT_NEAR(total_volume(mesh), 1.0 + 1.0 / 3.0 + 1.0 + 1.0 / 6.0, 1e-14);
}

TEST_F(ImportVtk, VoxelsAreHexahedra) {
  VtuText text;
  text.points = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 0, 1}, {2, 0, 1}, {0, 1, 1}, {2, 1, 1}};
  text.cells = {{11, {0, 1, 2, 3, 4, 5, 6, 7}, {}}};
  const Mesh mesh = import_vtk(write(text));
  expect_sound(mesh);
  EXPECT_NEAR(mesh.cell_volume[0], 2.0, 1e-15);
}

TEST_F(ImportVtk, PrismsOfFiveAndSixSidesArePolyhedra) {
  for (const int n : {5, 6})
    for (const bool mirrored : {false, true}) {
      VtuText text;
      std::vector<Index> ids;
      for (const double z : {0.0, 0.5})
        for (int i = 0; i < n; ++i) {
          const double angle = (mirrored ? -2.0 : 2.0) * std::numbers::pi * i / n;
          ids.push_back(count_of(text.points));
          text.points.emplace_back(std::cos(angle), std::sin(angle), z);
        }
      text.cells = {{n + 10, ids, {}}};
      const Mesh mesh = import_vtk(write(text));
      expect_sound(mesh);
      EXPECT_EQ(count_cells(mesh, CellShape::polyhedron), 1);
      EXPECT_NEAR(total_volume(mesh), 0.25 * n * std::sin(2.0 * std::numbers::pi / n), 1e-6);
    }
}

TEST_F(ImportVtk, AFlatMeshBecomesALayerOfCells) {
  VtuText text;
  text.points = {{2, 0, 0}, {2, 1, 0}, {2, 1, 1}, {2, 0, 1}, {2, 1, 2}, {2, 0, 3}};
  text.cells = {{9, {0, 1, 2, 3}, {}}, {7, {3, 2, 4, 5}, {}}};
  ImportSettings settings = write(text);
  settings.thickness = 0.5;
  const Mesh mesh = import_vtk(settings);
  expect_sound(mesh);
  EXPECT_EQ(count_cells(mesh, CellShape::polyhedron), 1);
  EXPECT_NEAR(total_volume(mesh), 0.5 * 2.5, 1e-6);
  EXPECT_NEAR((patch_area(mesh, "xmax") - Vector(2.5, 0, 0)).norm(), 0.0, 1e-6);
}

TEST_F(ImportVtk, ScaleIsTheFilesUnit) {
  ImportSettings settings = write(tetrahedron());
  settings.scale = 1e-3;
  EXPECT_NEAR(total_volume(import_vtk(settings)) * 6e9, 1.0, 1e-12);
  settings.scale = 0.0;
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(settings); }), HasSubstr("unit of length"));
}

TEST_F(ImportVtk, RegionsByTheUsualOrTheGivenArray) {
  VtuText text = two_cubes();
  text.cell_arrays = {
      {"gmsh:physical", {4, 9, 1, 1, 1, 0}}, {"colour", {2, 2, 0, 0, 0, 0}}, {"load", {0.5, 1, 1, 1, 1, 1}}};
  ImportSettings settings = write(text);
  EXPECT_EQ(import_vtk(settings).region_names, (std::vector<std::string>{"region_4", "region_9"}));
  settings.region_array = "colour";
  settings.region_names = {{2, "all"}};
  EXPECT_EQ(import_vtk(settings).region_names, std::vector<std::string>{"all"});
  settings.region_names = {{7, "nowhere"}};
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(settings); }),
              AllOf(HasSubstr("number 7"), HasSubstr("available: 2")));
  settings.region_array = "load";
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(settings); }),
              AllOf(HasSubstr("\"load\""), HasSubstr("colour, gmsh:physical")));
}

TEST_F(ImportVtk, NoArrayMakesOneRegion) {
  EXPECT_EQ(import_vtk(write(tetrahedron())).region_names, std::vector<std::string>{"body"});
}

TEST_F(ImportVtk, FaceSetsNamePatches) {
  VtuText text = two_cubes();
  text.cell_arrays = {{"tags", {1, 1, 5, 6, 7, 0}}};
  ImportSettings settings = write(text);
  settings.face_array = "tags";
  settings.face_sets = {{5, "left"}, {7, "right"}};
  settings.patches = {plane_patch("top", 2, 1.0, 1e-9), plane_patch("left_too", 0, 0.0, 1e-9)};
  settings.patches[1].required = false;
  const Mesh mesh = import_vtk(settings);
  expect_sound(mesh);
  EXPECT_NEAR((patch_area(mesh, "left") - Vector(-1, 0, 0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((patch_area(mesh, "right") - Vector(1, 0, 0)).norm(), 0.0, 1e-14);
  EXPECT_EQ(mesh.patch("top").n_faces, 2);
  EXPECT_EQ(mesh.patch("walls").n_faces, 6);
  EXPECT_EQ(mesh.patches.size(), 4U);

  settings.face_sets = {{6, "middle"}};  // an interior face
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(settings); }), HasSubstr("\"middle\""));
  settings.face_sets = {{8, "nowhere"}};
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(settings); }),
              AllOf(HasSubstr("number 8"), HasSubstr("5, 6, 7")));
}

TEST_F(ImportVtk, DefaultPatchesAreThePlanesThereAre) {
  const Mesh mesh = import_vtk(write(tetrahedron()));
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) names.push_back(patch.name);
  EXPECT_EQ(names, (std::vector<std::string>{"xmin", "ymin", "zmin", "walls"}));
}

TEST_F(ImportVtk, PointsAreMergedOnlyWhenAsked) {
  VtuText text = tetrahedron();
  for (const Vector& x : {Vector(0, 0, 1e-9), Vector(1, 1e-9, 0), Vector(0, 1, 0), Vector(0, 0, -1)})
    text.points.push_back(x);
  text.cells.push_back({10, {4, 6, 5, 7}, {}});
  ImportSettings settings = write(text);
  EXPECT_EQ(import_vtk(settings).n_interior_faces(), 0);
  settings.merge_tolerance = 1e-6;
  const Mesh mesh = import_vtk(settings);
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_interior_faces(), 1);
  EXPECT_EQ(mesh.points.size(), 5U);
}

TEST_F(ImportVtk, BadCellsAreRefusedByTheirNumberInTheFile) {
  VtuText flat = two_cubes();
  flat.cells.push_back({10, {0, 1, 3, 4}, {}});
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(write(flat)); }),
              AllOf(HasSubstr("cell 6"), HasSubstr("volume")));
  VtuText twice = tetrahedron();
  twice.cells[0].points[3] = 2;
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(write(twice)); }), HasSubstr("point twice"));
  VtuText quadratic = tetrahedron();
  quadratic.cells[0] = {24, {0, 1, 2, 3, 0, 1, 2, 3, 0, 1}, {}};
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(write(quadratic)); }),
              AllOf(HasSubstr("type 24"), HasSubstr("cell 0")));
  VtuText surface = tetrahedron();
  surface.cells = {{5, {0, 1, 2}, {}}};
  EXPECT_THAT(message_of<InputError>([&] { import_vtk(write(surface)); }), HasSubstr("no volume cells"));
}

// VTK does not look at how many points lines and pixels have.
TEST_F(ImportVtk, FlatCellsHaveTheirNumberOfPoints) {
  for (const auto& [type, points] : {std::pair{3, std::vector<Index>{1}}, {8, {0, 1, 2}}, {9, {0, 1, 3}}}) {
    VtuText flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    flat.cells = {{5, {0, 1, 2}, {}}, {type, points, {}}};
    ImportSettings settings = write(flat);
    settings.thickness = 1.0;
    EXPECT_THAT(message_of<InputError>([&] { import_vtk(settings); }),
                AllOf(HasSubstr(settings.file.string()),
                      HasSubstr(fmt::format("its cell 1 has {} points; its type requires", points.size()))));
  }
}

TEST_F(ImportVtk, UnreadableFilesAreNamedInOneMessageAndVtkStaysSilent) {
  const auto message = [&](const std::string& name, const std::string& content) {
    ImportSettings settings;
    settings.file = folder_ / name;
    if (!content.empty()) std::ofstream(settings.file) << content;
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    std::string text = message_of<InputError>([&] { import_vtk(settings); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr() + ::testing::internal::GetCapturedStdout(), "");
    EXPECT_THAT(text, HasSubstr(settings.file.string()));
    EXPECT_THAT(text, ::testing::Not(HasSubstr("\n")));
    return text;
  };
  EXPECT_THAT(message("none.vtu", ""), HasSubstr("No such file"));
  EXPECT_THAT(message("mesh.stl", "solid"), HasSubstr(".vtu or .vtk"));
  message("text.vtu", "not xml at all");
  message("text.vtk", "not vtk at all");
  message("cut.vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\"");
  message("cut.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0");
  message("image.vtu", "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData></ImageData></VTKFile>");
  std::filesystem::create_directories(folder_ / "folder.vtu");
  EXPECT_THAT(message("folder.vtu", ""), HasSubstr("directory"));
}

}  // namespace
}  // namespace pfdm::this_file
