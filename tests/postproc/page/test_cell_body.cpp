// The body of frames whose cells vibrate: what its points do, and what the page has of it.

#include "mesh/fields.h"
#include "physics/error.h"
#include "postproc/browser/body_json.h"
#include "postproc/browser/cell_body.h"
#include "postproc/fields/vtu_writer.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace pfdm::test::this_file {
namespace {

using ::testing::ElementsAre;

std::vector<std::vector<Index>> corners_of(const Mesh& mesh) {
  std::vector<std::vector<Index>> cells;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto points = mesh.points_of_cell(c);
    cells.emplace_back(points.begin(), points.end());
  }
  return cells;
}

TEST(CellBody, MovesPointsAsTheLinearFieldOfItsCells) {
  Tensor gradient;
  gradient << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6, 0.7, 0.8, 0.9;
  const Vector shift(1.0, 2.0, 3.0);
  const Mesh mesh = box_mesh({2.0, 4, 3.0}, {1.0, 3, 1.0}, {0.5, 2, 2.0});
  std::vector<Vector> moved;
  for (const Vector& x : mesh.cell_centre) moved.push_back(shift + gradient * x);
  const std::vector<Vector> points = displacement_of_points(mesh.points, corners_of(mesh), moved);
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_LE((points[p] - shift - gradient * mesh.points[p]).norm(), 1e-13) << p;
}

TEST(CellBody, LeavesOutWhatOneLayerOfCellsDoesNotTell) {
  const Mesh mesh = box_mesh({2.0, 4, 1.0}, {1.0, 3, 1.0}, {0.5, 1, 1.0});
  std::vector<Vector> moved;
  for (const Vector& x : mesh.cell_centre) moved.emplace_back(0.0, 0.0, 0.2 * x.x() - 0.1 * x.y());
  const std::vector<Vector> points = displacement_of_points(mesh.points, corners_of(mesh), moved);
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_LE((points[p] - Vector(0.0, 0.0, 0.2 * mesh.points[p].x() - 0.1 * mesh.points[p].y())).norm(), 1e-13) << p;
}

/// Two frames of a block that turns about x, out of phase along z, and gets warm.
class Shaken : public ::testing::Test {
 protected:
  Shaken() : real_(mesh_.n_cells()), imaginary_(mesh_.n_cells()), rise_(mesh_.n_cells()) {
    for (Index c = 0; c < mesh_.n_cells(); ++c) {
      real_[c] = 1e-3 * Vector::UnitX().cross(mesh_.cell_centre[c]);
      imaginary_[c] = 2e-3 * Vector::UnitZ();
    }
    for (Index k = 0; k < 2; ++k) {
      std::ranges::fill(rise_, static_cast<double>(k));
      const std::filesystem::path file = folder_ / (std::to_string(k) + ".vtu");
      VtuWriter(mesh_).write(file, {{"re", &real_}, {"im", &imaginary_}, {"rise", &rise_}}, 0.0);
      settings_.frames.push_back({.step = 7 * k, .file = file});
    }
  }

  TemporaryFolder folder_;
  Mesh mesh_ = cube_mesh(1.0, 3);
  CellField<Vector> real_, imaginary_;
  CellField<double> rise_;
  CellBodySettings settings_{.frames = {},
                             .fields = {{.array = "rise", .name = "temperature rise", .si_unit = "K"}},
                             .real = "re",
                             .imaginary = "im"};
};

TEST_F(Shaken, HasBothPartsOfItsMotion) {
  const Body body = read_cell_body(settings_);
  EXPECT_TRUE(body.vibrates);
  EXPECT_THAT(body.steps, ElementsAre(0, 7));
  ASSERT_EQ(body.displacement.size(), 2u);
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    EXPECT_LE((body.displacement[0][p] - 1e-3 * Vector::UnitX().cross(body.points[p])).norm(), 1e-15);
    EXPECT_LE((body.displacement[1][p] - 2e-3 * Vector::UnitZ()).norm(), 1e-15);
  }
  ASSERT_EQ(body.fields.size(), 1u);
  EXPECT_EQ(body.fields[0].frames[1], std::vector<double>(27, 1.0));
  std::vector<PagePart> parts;
  const auto json = body_json(body, parts);
  EXPECT_EQ(json["vibrates"], true);
  EXPECT_EQ(json["cut_axis"], -1);
  EXPECT_EQ(json["frames"].size(), 2u);
}

TEST_F(Shaken, StandsStillWithoutArraysOfItsMotion) {
  settings_.real.clear();
  settings_.imaginary.clear();
  const Body body = read_cell_body(settings_);
  EXPECT_FALSE(body.vibrates);
  ASSERT_EQ(body.displacement.size(), 2u);  // of each frame
  EXPECT_EQ(body.displacement[1], std::vector<Vector>(body.points.size(), Vector::Zero()));
}

TEST_F(Shaken, RefusesFramesOfAnotherMesh) {
  const Mesh other = cube_mesh(1.0, 2);
  VtuWriter(other).write(settings_.frames[1].file, {}, 0.0);
  EXPECT_THROW(read_cell_body(settings_), InputError);
}

}  // namespace
}  // namespace pfdm::test::this_file
