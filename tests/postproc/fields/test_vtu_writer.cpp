#include "mesh/dual.h"
#include "mesh/files/import_mesh.h"
#include "physics/error.h"
#include "postproc/fields/vtu_writer.h"
#include "tests/postproc/awkward_fields.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

TEST(VtuWriter, fields_come_back_bit_for_bit) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  const AwkwardFields f(mesh.n_cells());
  VtuWriter(mesh).write(folder / "a.vtu", {{"s", &f.scalar}, {"v", &f.vector}, {"t", &f.tensor}, {"i", &f.integer}},
                        0.1);
  const auto grid = read_back(folder / "a.vtu");
  vtkCellData& data = *grid->GetCellData();
  ASSERT_EQ(data.GetNumberOfArrays(), 4);
  for (const char* name : {"s", "v", "t"}) EXPECT_EQ(data.GetArray(name)->GetDataType(), VTK_DOUBLE) << name;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_EQ(data.GetArray("s")->GetComponent(c, 0), f.scalar[c]);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(data.GetArray("v")->GetComponent(c, k), f.vector[c][k]);
    EXPECT_EQ(static_cast<Index>(data.GetArray("i")->GetComponent(c, 0)), f.integer[c]);
  }
}

TEST(VtuWriter, tensors_have_named_components) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  const AwkwardFields f(mesh.n_cells());
  VtuWriter(mesh).write(folder / "a.vtu", {{"t", &f.tensor}}, 0.0);
  const auto grid = read_back(folder / "a.vtu");
  vtkDataArray& array = *grid->GetCellData()->GetArray("t");
  ASSERT_EQ(array.GetNumberOfComponents(), 6);
  const std::array<std::string, 6> names{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(array.GetComponentName(k), names[k]);
    const int row = names[k][0] - 'X', column = names[k][1] - 'X';
    for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_EQ(array.GetComponent(c, k), f.tensor[c](row, column));
  }
}

TEST(VtuWriter, single_precision_rounds_once) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  const AwkwardFields f(mesh.n_cells());
  using enum Precision;
  VtuWriter(mesh).write(folder / "a.vtu", {{"s", &f.scalar, single_precision}, {"v", &f.vector, single_precision}},
                        0.0);
  const auto grid = read_back(folder / "a.vtu");
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_EQ(grid->GetCellData()->GetArray("s")->GetComponent(c, 0), static_cast<float>(f.scalar[c]));
    EXPECT_EQ(grid->GetCellData()->GetArray("v")->GetComponent(c, 2), static_cast<float>(f.vector[c].z()));
  }
}

TEST(VtuWriter, points_and_cells_come_back) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  VtuWriter(mesh).write(folder / "a.vtu", {}, 0.0);
  const auto grid = read_back(folder / "a.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    EXPECT_EQ(Vector(grid->GetPoint(static_cast<vtkIdType>(p))), mesh.points[p]);
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.n_cells());
  // In the order of CellShape.
  const std::array types{VTK_TETRA, VTK_WEDGE, VTK_PYRAMID, VTK_HEXAHEDRON, VTK_POLYHEDRON};
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_EQ(grid->GetCellType(c), types[static_cast<std::size_t>(mesh.shape[c])]);
    vtkNew<vtkIdList> points;
    grid->GetCellPoints(c, points);
    EXPECT_TRUE(
        std::equal(points->begin(), points->end(), mesh.points_of_cell(c).begin(), mesh.points_of_cell(c).end()));
  }
}

TEST(VtuWriter, faces_of_polyhedra_are_closed_and_point_outwards) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  VtuWriter(mesh).write(folder / "a.vtu", {}, 0.0);
  const auto grid = read_back(folder / "a.vtu");
  Index polyhedron = 0;
  while (mesh.shape[polyhedron] != CellShape::polyhedron) ++polyhedron;
  vtkNew<vtkIdList> stream;
  grid->GetFaceStream(polyhedron, stream);
  ASSERT_EQ(stream->GetId(0), 6);
  double volume = 0.0;
  for (vtkIdType at = 1; at < stream->GetNumberOfIds(); at += stream->GetId(at) + 1) {
    ASSERT_EQ(stream->GetId(at), 4);
    const auto point = [&](vtkIdType k) { return Vector(grid->GetPoint(stream->GetId(at + 1 + k))); };
    const Vector area = 0.5 * (point(2) - point(0)).cross(point(3) - point(1));
    volume += area.dot(point(0)) / 3.0;  // divergence theorem
  }
  EXPECT_NEAR(volume, mesh.cell_volume[polyhedron], 1e-14);
}

TEST(VtuWriter, a_dual_mesh_comes_back) {
  const TemporaryFolder folder;
  CellSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1.2, 1.1, 0.7}};
  soup.region_names = {"a"};
  soup.add_cell(CellShape::tetrahedron, std::vector<Index>{0, 1, 2, 3}, 0);
  soup.add_cell(CellShape::tetrahedron, std::vector<Index>{1, 4, 2, 3}, 0);
  const Mesh dual = barycentric_dual(assemble_mesh(std::move(soup), {}));
  VtuWriter(dual).write(folder / "a.vtu", {{"material", &dual.region}}, 0.0);
  const Mesh back = import_vtk({.file = folder / "a.vtu",
                                .region_array = "",
                                .region_names = {},
                                .face_array = "",
                                .face_sets = {},
                                .patches = {}});
  ASSERT_EQ(back.n_cells(), dual.n_cells());
  EXPECT_LE(read_back(folder / "a.vtu")->GetNumberOfPoints(), count_of(dual.points));
  // Faces that are not plane have become triangles, about the point that they were fans about.
  EXPECT_GT(back.n_faces(), dual.n_faces());
  std::vector<double> volumes = back.cell_volume.values(), exact = dual.cell_volume.values();
  std::ranges::sort(volumes);
  std::ranges::sort(exact);
  for (std::size_t c = 0; c < exact.size(); ++c) EXPECT_NEAR(volumes[c], exact[c], 1e-14);
}

TEST(VtuWriter, time_and_region_names_are_field_data) {
  const TemporaryFolder folder;
  VtuWriter(mesh_of_all_shapes()).write(folder / "a.vtu", {}, awkward(3));
  const auto grid = read_back(folder / "a.vtu");
  vtkFieldData& data = *grid->GetFieldData();
  ASSERT_NE(data.GetArray("TimeValue"), nullptr);
  EXPECT_EQ(data.GetArray("TimeValue")->GetComponent(0, 0), awkward(3));
  ASSERT_NE(data.GetArray("region_glass"), nullptr);
  ASSERT_NE(data.GetArray("region_epoxy"), nullptr);
  EXPECT_EQ(data.GetArray("region_glass")->GetComponent(0, 0), 0);
  EXPECT_EQ(data.GetArray("region_epoxy")->GetComponent(0, 0), 1);
  EXPECT_EQ(data.GetNumberOfArrays(), 3);
}

TEST(VtuWriter, region_names_with_marks_of_xml_come_back) {
  const TemporaryFolder folder;
  Mesh mesh = mesh_of_all_shapes();
  mesh.region_names.front() = "a<b> & \"c\" 'd' &lt;\n";
  VtuWriter(mesh).write(folder / "a.vtu", {}, 0.0);
  const auto grid = read_back(folder / "a.vtu");
  EXPECT_EQ(grid->GetNumberOfCells(), mesh.n_cells());
  EXPECT_NE(grid->GetFieldData()->GetArray("region_a<b> & \"c\" 'd' &lt;_"), nullptr);
}

TEST(VtuWriter, units_come_back) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  const AwkwardFields f(mesh.n_cells());
  const SplitPoints points{.copies = {}, .displacement = std::vector<Vector>(mesh.points.size(), Vector::UnitZ())};
  VtuWriter(mesh, {.compression = Compression::zlib, .time_unit = "s"})
      .write(folder / "a.vtu", {{"s", &f.scalar, Precision::single_precision, "Pa"}, {"i", &f.integer}}, 1.0, &points);
  const auto grid = read_back(folder / "a.vtu");
  const auto unit = [](vtkDataArray* array) -> std::string {
    const char* text = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return text ? text : "none";
  };
  EXPECT_EQ(unit(grid->GetCellData()->GetArray("s")), "Pa");
  EXPECT_EQ(unit(grid->GetCellData()->GetArray("i")), "none");
  EXPECT_EQ(unit(grid->GetPointData()->GetArray("displacement")), "m");
  EXPECT_EQ(unit(grid->GetFieldData()->GetArray("TimeValue")), "s");
}

TEST(VtuWriter, compresses_as_it_is_told) {
  const TemporaryFolder folder;
  const Mesh mesh = cube_mesh(1.0, 8);
  const CellField<double> damage(mesh.n_cells(), 0.25);
  const auto head = [&](Compression compression) {
    VtuWriter(mesh, {.compression = compression}).write(folder / "a.vtu", {{"damage", &damage}}, 0.0);
    EXPECT_EQ(read_back(folder / "a.vtu")->GetCellData()->GetArray("damage")->GetComponent(7, 0), 0.25);
    return content_of(folder / "a.vtu").substr(0, 300);
  };
  EXPECT_THAT(head(Compression::zlib), HasSubstr("vtkZLibDataCompressor"));
  EXPECT_THAT(head(Compression::lz4), HasSubstr("vtkLZ4DataCompressor"));
  EXPECT_THAT(head(Compression::none), ::testing::Not(HasSubstr("compressor")));
}

TEST(VtuWriter, one_writer_makes_frames_that_do_not_mix) {
  const TemporaryFolder folder;
  const Mesh mesh = cube_mesh(1.0, 2);
  const VtuWriter writer(mesh);
  CellField<double> damage(mesh.n_cells(), 0.25);
  writer.write(folder / "first.vtu", {{"damage", &damage}}, 0.0);
  damage[0] = 0.75;
  writer.write(folder / "second.vtu", {{"only_here", &damage}}, 1.0);
  EXPECT_EQ(read_back(folder / "first.vtu")->GetCellData()->GetArray("damage")->GetComponent(0, 0), 0.25);
  const auto second = read_back(folder / "second.vtu");
  EXPECT_EQ(second->GetCellData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(second->GetCellData()->GetArray("only_here")->GetComponent(0, 0), 0.75);
  EXPECT_EQ(folder.n_entries(), 2u);
}

TEST(VtuWriter, refuses_a_field_of_another_mesh) {
  const TemporaryFolder folder;
  const CellField<double> field(4);
  const VtuWriter writer(mesh_of_all_shapes());
  EXPECT_EQ(message_of<InputError>([&] {
              writer.write(folder / "a.vtu", {{"d", &field}}, 0.0);
            }),
            "the field \"d\" has 4 values for 5 cells");
  EXPECT_EQ(folder.n_entries(), 0u);
}

TEST(VtuWriter, says_where_it_cannot_write) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  const VtuWriter writer(mesh_of_all_shapes());
  EXPECT_THAT(message_of<ComputationError>([&] { writer.write(folder / "file" / "a.vtu", {}, 0.0); }),
              HasSubstr("file/a.vtu: Not a directory"));
}

TEST(VtuWriter, leaves_nothing_when_the_disk_fills_up_half_way) {
  const TemporaryFolder folder;
  const VtuWriter writer(mesh_of_all_shapes());
  const FileSizeLimit limit(500);
  EXPECT_THAT(message_of<ComputationError>([&] { writer.write(folder / "a.vtu", {}, 0.0); }),
              HasSubstr("a.vtu: File too large"));
  EXPECT_EQ(folder.n_entries(), 0u);
}

}  // namespace
}  // namespace pfdm::test::this_file
