// Faces of a cohesive interface as places of a record.

#include "postproc/cohesive/column_record.h"
#include "postproc/cohesive/face_columns.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>

namespace pfdm::test::this_file {
namespace {

constexpr double toughness = 50.0;

// A cube of 3 x 3 x 3 cells with its middle one, or its lower third, as a region of its own.
Mesh block_with(const Vector& lower, const Vector& upper) {
  BoxHexesSettings box;
  box.axes = {{{{3.0, 3, 1.0}}, {{3.0, 3, 1.0}}, {{3.0, 3, 1.0}}}};
  box.base_region = "matrix";
  box.regions = {{.name = "core", .lower = lower, .upper = upper}};
  return make_box_hexes(box);
}

/// The faces between both regions, told from the matrix where `from_matrix`.
FractureModel with_interface(const Mesh& mesh, bool from_matrix) {
  FractureModel model;
  model.regions.resize(mesh.region_names.size());
  CohesiveSurface surface{.name = "bond", .law = {.mixed_mode = &mixed_modes().front()}, .faces = {}};
  const Index first = mesh.region_index(from_matrix ? "matrix" : "core");
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const Index a = mesh.region[mesh.owner[f]], b = mesh.region[mesh.neighbour[f]];
    if (a == b) continue;
    surface.faces.push_back(f);
    surface.sign.push_back(a == first ? 1.0 : -1.0);
    surface.at.push_back({.strength = 1e6, .toughness = toughness});
  }
  model.interfaces.push_back(surface);
  return model;
}

/// The matrix is moved by `shift` against the core, and pulls with `stress` on it.
OutputFields parted(const Mesh& mesh, const FractureModel& model, bool from_matrix, const Vector& shift,
                    const Tensor& stress) {
  const CohesiveSurface& surface = model.interfaces.front();
  const std::size_t n = surface.faces.size();
  OutputInterface out{.name = surface.name,
                      .faces = surface.faces,
                      .separation = CellField<Vector>(n, from_matrix ? Vector(-shift) : shift),
                      .traction = CellField<Vector>(n),
                      .opening = CellField<double>(n),
                      .damage = CellField<double>(n, 0.4),
                      .dissipated = CellField<double>(n, 0.3 * toughness)};
  for (std::size_t k = 0; k < n; ++k)
    out.traction[k] = stress * surface.sign[k] * mesh.face_area[surface.faces[k]].normalized();
  OutputFields output;
  output.interfaces.push_back(std::move(out));
  return output;
}

// Seen from either side: u outside less u inside, and the traction of the stress on the outward normal.
TEST(FaceColumns, AreSeenFromInsideWhicheverSideComesFirst) {
  const Mesh mesh = block_with({1, 1, 1}, {2, 2, 2});
  const Vector shift(0.01, 0.02, -0.03);
  const Tensor stress = (Tensor() << 5.0, 1.0, 0.0, 1.0, -2.0, 0.5, 0.0, 0.5, 3.0).finished();
  for (const bool from_matrix : {false, true}) {
    const FractureModel model = with_interface(mesh, from_matrix);
    const ColumnSet set = face_columns(mesh, model.interfaces.front(), Vector::UnitZ());
    EXPECT_EQ(set.kind, SurfaceKind::interface);
    EXPECT_TRUE(set.is_cohesive);
    ASSERT_EQ(set.columns.size(), 6U);
    const auto samples = sample_columns(mesh, model, parted(mesh, model, from_matrix, shift, stress), set);
    for (std::size_t k = 0; k < 6; ++k) {
      const Column& c = set.columns[k];
      EXPECT_NEAR((c.point - c.normal * 0.5 - Vector(1.5, 1.5, 1.5)).norm(), 0.0, 1e-12);
      EXPECT_DOUBLE_EQ(c.area, 1.0);
      EXPECT_NEAR(samples[k].separation[0], shift.dot(c.normal), 1e-14);
      EXPECT_NEAR(samples[k].separation[1], shift.dot(c.tangents[0]), 1e-14);
      EXPECT_NEAR(samples[k].traction[0], c.normal.dot(stress * c.normal), 1e-12);
      EXPECT_NEAR(samples[k].traction[1], c.tangents[0].dot(stress * c.normal), 1e-12);
      EXPECT_NEAR(samples[k].traction[2], c.tangents[1].dot(stress * c.normal), 1e-12);
      EXPECT_DOUBLE_EQ(samples[k].surface_energy, 0.3 * toughness);  // what it dissipated, in whatever mode
      EXPECT_DOUBLE_EQ(samples[k].largest_damage, 0.4);
      EXPECT_EQ(samples[k].bulk, Vector::Zero());
    }
  }
}

// The normals of a plane leave the side that its case names first.
TEST(FaceColumns, OfAPlaneLeaveTheFirstSide) {
  const Mesh mesh = block_with({0, 0, 0}, {3, 3, 1});
  for (const bool from_matrix : {false, true}) {
    const FractureModel model = with_interface(mesh, from_matrix);
    const ColumnSet set = face_columns(mesh, model.interfaces.front(), Vector::UnitZ());
    EXPECT_EQ(set.kind, SurfaceKind::plane);
    ASSERT_EQ(set.columns.size(), 9U);
    const Vector shift(0.0, 0.0, 0.02);
    const auto samples = sample_columns(mesh, model, parted(mesh, model, from_matrix, shift, Tensor::Identity()), set);
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_NEAR(set.columns[k].normal.z(), from_matrix ? -1.0 : 1.0, 1e-12);
      EXPECT_NEAR(samples[k].separation[0], 0.02, 1e-14);
      EXPECT_NEAR(samples[k].traction[0], 1.0, 1e-12);
    }
  }
}

TEST(FaceColumns, AreMarkedInTheRecord) {
  const TemporaryFolder folder;
  const Mesh mesh = block_with({1, 1, 1}, {2, 2, 2});
  const FractureModel model = with_interface(mesh, false);
  const std::vector<ColumnSet> sets{face_columns(mesh, model.interfaces.front(), Vector::UnitZ())};
  const ColumnFiles files(folder.path(), sets, Vector::UnitZ(), std::nullopt);
  files.append(0, mesh, model, parted(mesh, model, false, Vector::UnitX(), Tensor::Identity()));
  const std::vector<ColumnRecord> records = read_columns(folder.path());
  ASSERT_EQ(records.size(), 1U);
  EXPECT_TRUE(records.front().is_cohesive);
  EXPECT_EQ(records.front().kind, SurfaceKind::interface);
  EXPECT_DOUBLE_EQ(records.front().area(), 6.0);
}

}  // namespace
}  // namespace pfdm::test::this_file
