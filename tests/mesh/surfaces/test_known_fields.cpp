// Fields out of files and at scattered points: linear ones come out as they are, whatever the cells.

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/files/field_file.h"
#include "mesh/generators/box_hexes.h"
#include "mesh/search/scattered_field.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/vtu_text.h"
#include "tests/temporary_folder.h"

namespace pfdm::this_file {
namespace {

double linear(const Vector& x) { return 3.0 - 2.0 * x[0] + 0.5 * x[1] + 7.0 * x[2]; }

double value_at(const FieldFile& file, const Vector& x, bool nearest = false) {
  const Interpolation there = file.field.at(x, nearest);
  double sum = 0.0;
  for (std::size_t i = 0; i < there.known.size(); ++i) sum += there.weight[i] * file.values[there.known[i]];
  return sum;
}

/// 200 places in a cube about the origin, of this half edge.
std::vector<Vector> places(double half) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-half, half);
  std::vector<Vector> all;
  for (int i = 0; i < 200; ++i) all.emplace_back(within(random), within(random), within(random));
  return all;
}

class KnownFields : public ::testing::Test {
 protected:
  FieldFile read(const VtuText& text, double scale = 1.0, int component = 0) const {
    text.write_vtu(folder_ / "field.vtu");
    return read_field_file(folder_ / "field.vtu", "T", component, scale);
  }

  test::TemporaryFolder folder_;
};

TEST_F(KnownFields, NearestIsTheNearestPoint) {
  const Mesh mesh = wedges_and_tetrahedra();
  VtuText text = vtu_text(mesh);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) text.point_arrays["T"].push_back(static_cast<double>(p));
  const FieldFile file = read(text);
  for (const Vector& x : places(3.0)) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector& point : mesh.points) least = std::min(least, (point - x).norm());
    EXPECT_LT((mesh.points[static_cast<std::size_t>(value_at(file, x, true))] - x).norm(), least + 1e-12);
  }
}

TEST_F(KnownFields, AtPointsOfAnyCellsAreLinear) {
  const Mesh mesh = wedges_and_tetrahedra();
  for (VtuText text : {vtu_text(mesh), vtu_text_of_polyhedra(mesh)}) {
    for (const Vector& x : mesh.points) text.point_arrays["T"].push_back(linear(x));
    const FieldFile file = read(text);
    for (const Vector& x : places(3.0)) {
      EXPECT_NEAR(value_at(file, x), linear(x), 1e-12 * 30.0);
      EXPECT_LT(file.field.at(x, false).outside, 1e-12);
    }
  }
}

TEST_F(KnownFields, InCellsAreLinearBetweenCentroids) {
  const Mesh mesh = wedges_and_tetrahedra();
  for (VtuText text : {vtu_text(mesh), vtu_text_of_polyhedra(mesh)}) {
    for (Index c = 0; c < mesh.n_cells(); ++c) text.cell_arrays["T"].push_back(linear(mesh.cell_centre[c]));
    const FieldFile file = read(text);
    for (const Vector& x : places(3.0)) EXPECT_NEAR(value_at(file, x), linear(x), 1e-12 * 60.0);
    for (Index c = 0; c < mesh.n_cells(); c += 97)
      EXPECT_NEAR(value_at(file, mesh.cell_centre[c], true), linear(mesh.cell_centre[c]), 1e-12 * 30.0);
  }
}

// In millimetres; the second of two components.
TEST_F(KnownFields, TakeUnitAndComponent) {
  BoxHexesSettings settings;
  settings.axes = {{{{2.0, 3, 2.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  VtuText text = vtu_text(mesh);
  for (const Vector& x : mesh.points)
    text.point_arrays["T\" NumberOfComponents=\"2"].insert(text.point_arrays["T\" NumberOfComponents=\"2"].end(),
                                                           {-1.0, linear(x)});
  const FieldFile file = read(text, 1e-3, 1);
  const Vector x(1.3, 0.2, 0.9);
  EXPECT_NEAR(value_at(file, 1e-3 * x), linear(x), 1e-12);
  EXPECT_THROW(read(text, 1e-3, 2), InputError);
}

// Quadratic tetrahedra: their corners count.
TEST_F(KnownFields, TakeCellsOfSecondOrder) {
  VtuText text;
  text.points = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                 {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  text.cells = {{24, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {}}};
  for (const Vector& x : text.points) text.point_arrays["T"].push_back(linear(x));
  const Vector x(0.2, 0.3, 0.1);
  EXPECT_NEAR(value_at(read(text), x), linear(x), 1e-12);
  // A flat mesh and the lines of its boundary, as meshio writes Gmsh's.
  VtuText flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
  flat.cells = {{22, {0, 1, 2, 3, 4, 5}, {}}, {21, {0, 1, 3}, {}}};
  for (const Vector& at : flat.points) flat.point_arrays["T"].push_back(linear(at));
  EXPECT_NEAR(value_at(read(flat), Vector(0.2, 0.3, 0.0)), linear(Vector(0.2, 0.3, 0.0)), 1e-12);
}

// A disc of triangles in the plane z = 5; of a second-order function the error falls with the square of its size.
TEST_F(KnownFields, OfAFlatMeshDoNotDependOnTheThirdCoordinate) {
  const auto square = [](const Vector& x) { return x.head<2>().squaredNorm(); };
  double before = 0.0;
  for (const Index n : {8, 16}) {
    VtuText text;
    for (Index i = 0; i <= n; ++i)
      for (Index j = 0; j <= n; ++j) text.points.emplace_back(2.0 * i / n - 1.0, 2.0 * j / n - 1.0, 5.0);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const Index p = i * (n + 1) + j;
        text.cells.push_back({5, {p, p + n + 1, p + n + 2}, {}});
        text.cells.push_back({5, {p, p + n + 2, p + 1}, {}});
      }
    for (const Vector& x : text.points) text.point_arrays["T"].push_back(square(x));
    const FieldFile file = read(text);
    double error = 0.0;
    for (const Vector& x : places(1.0)) error = std::max(error, std::abs(value_at(file, x) - square(x)));
    if (before > 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.6);
    }
    before = error;
    const Interpolation beside = file.field.at({1.5, 0.25, -9.0}, false);
    EXPECT_NEAR(beside.outside, 0.5, 1e-12);
  }
}

// Outside it is the value of the nearest place, wherever that lies on a cell's surface.
TEST_F(KnownFields, OutsideTakeTheNearestPlace) {
  BoxHexesSettings settings;
  settings.axes = {{{{2.0, 3, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  VtuText text = vtu_text(mesh);
  for (const Vector& x : mesh.points) text.point_arrays["T"].push_back(linear(x));
  const FieldFile file = read(text);
  for (const Vector& x : places(4.0)) {
    const Vector nearest = x.cwiseMax(Vector::Zero()).cwiseMin(Vector(2.0, 1.0, 1.0));
    EXPECT_NEAR(value_at(file, x), linear(nearest), 1e-12 * 30.0);
    EXPECT_NEAR(file.field.at(x, false).outside, (x - nearest).norm(), 1e-12);
  }
}

TEST_F(KnownFields, AtScatteredPointsAreLinear) {
  const std::vector<Vector> points = places(1.0);
  for (const std::array<bool, 3> varies : {std::array{true, true, true}, {true, false, true}, {false, true, false}}) {
    const auto part = [&](const Vector& x) {
      return linear(Vector(varies[0] ? x[0] : 0.0, varies[1] ? x[1] : 0.0, varies[2] ? x[2] : 0.0));
    };
    FieldFile file{scattered_field(points, varies), {}};
    for (const Vector& x : points) file.values.push_back(part(x));
    for (const Vector& x : places(0.4)) EXPECT_NEAR(value_at(file, x), part(x), 1e-12 * 10.0);
    for (const Vector& x : points) EXPECT_NEAR(value_at(file, x, true), part(x), 1e-12 * 10.0);
  }
}

TEST_F(KnownFields, RefuseWhatSpansNothing) {
  const std::vector<Vector> plane{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const auto message = [](const std::vector<Vector>& points, std::array<bool, 3> varies) {
    try {
      scattered_field(points, varies);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(plane, {true, true, true}), ::testing::HasSubstr("lie in a plane"));
  EXPECT_THAT(message({plane[0], plane[1], plane[1]}, {true, false, false}), ::testing::HasSubstr("place of another"));
  EXPECT_THAT(message({plane[0], plane[1], {2, 0, 1}}, {true, true, false}), ::testing::HasSubstr("lie on a line"));
  EXPECT_THAT(message({plane[0]}, {true, true, true}), ::testing::HasSubstr("two points or more"));
}

}  // namespace
}  // namespace pfdm::this_file
