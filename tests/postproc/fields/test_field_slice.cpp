#include "physics/error.h"
#include "postproc/fields/field_slice.h"
#include "postproc/fields/vtu_writer.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

double area_of(const FieldSlice::Cell& cell) {
  Vector twice = Vector::Zero();
  for (std::size_t i = 1; i + 1 < cell.corners.size(); ++i)
    twice += (cell.corners[i] - cell.corners[0]).cross(cell.corners[i + 1] - cell.corners[0]);
  return 0.5 * twice.norm();
}

/// 2 x 3 x 5 m; the field is each cell's x, cells with z above 2 m are another material.
void write_box(const std::filesystem::path& file) {
  const Mesh mesh = box_mesh({2.0, 4, 1.0}, {3.0, 6, 1.0}, {5.0, 5, 1.0});
  CellField<double> field(mesh.n_cells());
  CellField<Index> material(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    field[c] = mesh.cell_centre[c].x();
    material[c] = mesh.cell_centre[c].z() > 2.0 ? 1 : 0;
  }
  VtuWriter(mesh).write(file, {{"damage", &field}, {"material", &material}}, 0.0);
}

TEST(FieldSlice, CoversThePlaneWithTheCellsValues) {
  const TemporaryFolder folder;
  write_box(folder / "a.vtu");
  const StoredFrame frame(folder / "a.vtu");
  EXPECT_EQ(frame.n_cells(), 120);
  EXPECT_NEAR((frame.upper() - frame.lower() - Vector(2, 3, 5)).norm(), 0.0, 1e-12);
  for (const double y : {1.5, 1.7}) {  // along faces, and through cells
    const FieldSlice slice = frame.slice({1.0, y, 2.5}, Vector::UnitY(), "damage");
    EXPECT_EQ(slice.cells.size(), 20u);
    double area = 0.0, integral = 0.0;
    for (const auto& cell : slice.cells) {
      area += area_of(cell);
      integral += area_of(cell) * cell.value;
      Vector centre = Vector::Zero();
      for (const Vector& corner : cell.corners) centre += corner / static_cast<double>(cell.corners.size());
      EXPECT_NEAR(centre.x(), cell.value, 1e-6);
      EXPECT_NEAR(centre.y(), y, 1e-4);
    }
    EXPECT_NEAR(area, 10.0, 1e-6);
    EXPECT_NEAR(integral, 10.0, 1e-6);
    double border = 0.0;
    for (const auto& line : slice.borders) {
      border += (line[1] - line[0]).norm();
      EXPECT_NEAR(line[0].z(), 2.0, 1e-6);
    }
    EXPECT_NEAR(border, 2.0, 1e-6);
  }
}

TEST(FieldSlice, SaysWhatIsWrongWithAFrame) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { StoredFrame(folder / "none.vtu"); }), HasSubstr("none.vtu"));
  put(folder / "bad.vtu", "<VTKFile type=\"UnstructuredGrid\"");
  EXPECT_THAT(message_of<InputError>([&] { StoredFrame(folder / "bad.vtu"); }), HasSubstr("bad.vtu"));
  write_box(folder / "a.vtu");
  const StoredFrame frame(folder / "a.vtu");
  EXPECT_THAT(message_of<InputError>([&] { frame.slice(Vector::Zero(), Vector::UnitX(), "heat"); }),
              HasSubstr("no field \"heat\""));
}

}  // namespace
}  // namespace pfdm::test::this_file
