// The body of a page: its cells are those of the mesh, its points have moved as the frames say.

#include "mesh/dual.h"
#include "mesh/generators/particles_in_box.h"
#include "physics/error.h"
#include "postproc/browser/body.h"
#include "postproc/browser/body_json.h"
#include "postproc/browser/body_part.h"
#include "postproc/fields/frame.h"
#include "postproc/fields/point_displacement.h"
#include "postproc/fields/stored_cells.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/opened_fields.h"
#include "tests/postproc/temporary_folder.h"
#include "tests/postproc/unpacked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

Mesh layered_bead() {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-2.0);
  settings.upper = Vector::Constant(2.0);
  settings.size_far = 1.5;
  settings.particles.resize(1);
  settings.particles[0].radius = 1.0;
  settings.particles[0].subdivision = 1;
  settings.particles[0].n_layers = 2;
  settings.particles[0].layer_thickness = 0.1;
  return make_particles_in_box(settings);
}

void write_mesh(const std::filesystem::path& file, const Mesh& mesh) {
  VtuWriter(mesh).write(file, {{"material", &mesh.region}}, 0.0);
}

void write_frame(const std::filesystem::path& file, const Mesh& mesh, const OutputFields& output) {
  const SplitPoints points = point_displacement(mesh, {}, output, 1.0);
  VtuWriter(mesh).write(file, frame_fields(mesh, output), 1.0, &points);
}

/// By the divergence theorem; the sum over cells' faces as the body has them.
double volume_of(const Body& body) {
  double volume = 0.0;
  for_each_face(body.shape, body.corners, body.faces, [&](std::size_t, std::span<const Index> face) {
    const auto at = [&](std::size_t i) { return body.points[face[i]]; };
    for (std::size_t i = 1; i + 1 < face.size(); ++i) volume += at(0).dot(at(i).cross(at(i + 1))) / 6.0;
  });
  return volume;
}

double volume_of(const Mesh& mesh) { return std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0); }

Body body_of(const Mesh& mesh, const std::vector<OutputFields>& outputs, BodySettings settings = {}) {
  const TemporaryFolder folder;
  write_mesh(folder / "mesh.vtu", mesh);
  settings.mesh = folder / "mesh.vtu";
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    write_frame(folder / std::to_string(i), mesh, outputs[i]);
    settings.frames.push_back({.step = static_cast<Index>(10 + i), .file = folder / std::to_string(i)});
    settings.progress.push_back(static_cast<double>(i));
  }
  return read_body(settings);
}

TEST(Body, HasTheCellsOfTheMeshWhateverTheirShape) {
  const Mesh bead = layered_bead();
  for (const Mesh& mesh : {cube_mesh(2.0, 3), bead, barycentric_dual(bead)}) {
    const Body body = body_of(mesh, {sound_fields(mesh)});
    EXPECT_EQ(count_of(body.shape), mesh.n_cells());
    EXPECT_NEAR(volume_of(body), volume_of(mesh), 1e-9 * volume_of(mesh));
    EXPECT_EQ(body.regions, mesh.region_names);
    for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_EQ(body.region[c], mesh.region[c]);
    EXPECT_TRUE(body.is_surface.empty());
    EXPECT_EQ(body.flat_axis, -1);
  }
}

TEST(Body, MovesEachCornerAsTheFramesSayAlsoWhereACrackPartsThem) {
  const Mesh mesh = layered_bead();
  std::vector<OutputFields> outputs{sound_fields(mesh), opened_fields(mesh, Vector::UnitZ(), 0.3, Vector::UnitZ())};
  for (Index c = 0; c < mesh.n_cells(); ++c) outputs[0].displacement[c] = 0.01 * mesh.cell_centre[c];
  const Body body = body_of(mesh, outputs);
  ASSERT_EQ(body.steps, (std::vector<Index>{10, 11}));
  const TemporaryFolder folder;
  std::size_t n_sound = 0;
  for (std::size_t f = 0; f < outputs.size(); ++f) {
    ASSERT_EQ(body.displacement[f].size(), body.points.size());
    write_frame(folder / "frame.vtu", mesh, outputs[f]);
    const StoredCells frame(folder / "frame.vtu");
    const std::vector<Vector> moved = frame.displacement(), points = frame.points();
    if (f == 0) n_sound = points.size();
    std::vector<Index> corners, faces;
    for (Index c = 0; c < mesh.n_cells(); ++c) frame.append_corners(c, corners, faces);
    ASSERT_EQ(corners.size(), body.corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      EXPECT_EQ(body.displacement[f][body.corners[i]], moved[corners[i]]);
      EXPECT_EQ(body.points[body.corners[i]], points[corners[i]]);
    }
  }
  EXPECT_GT(body.points.size(), n_sound);  // the crack has opened
  for (std::size_t p = 0; p < body.points.size(); ++p) EXPECT_EQ(body.points[p], body.points[body.place[p]]);
  EXPECT_EQ(body.fields[0].name, "damage");
  EXPECT_EQ(body.fields[0].frames[1], outputs[1].damage.values());
}

TEST(Body, KnowsThatAPlateIsFlat) {
  const Mesh mesh = box_mesh({5.0, 5, 1.0}, {2.0, 2, 1.0}, {1.0, 1, 1.0});
  EXPECT_EQ(body_of(mesh, {sound_fields(mesh)}).flat_axis, 2);
}

TEST(Body, TellsVonMisesStressAndThatAlongTheLoad) {
  const Mesh mesh = cube_mesh(1.0, 1);
  OutputFields output = sound_fields(mesh);
  output.stress[0] << 5.0, 1.0, 2.0, 1.0, -3.0, 0.5, 2.0, 0.5, 7.0;
  const Body body = body_of(mesh, {output});
  const Tensor s = output.stress[0] - output.stress[0].trace() / 3.0 * Tensor::Identity();
  EXPECT_NEAR(body.fields[1].frames[0][0], std::sqrt(1.5 * s.cwiseProduct(s).sum()), 1e-5);
  EXPECT_EQ(body.fields[2].name, "stress zz");
  EXPECT_NEAR(body.fields[2].frames[0][0], 7.0, 1e-6);
}

TEST(Body, TakesOfALargeBodyWhatIsSeen) {
  const Mesh mesh = cube_mesh(1.0, 10);
  BodySettings settings;
  settings.cut_at = Vector(0.55, 0.55, 0.55);
  settings.most_cells = 500;
  const Body body = body_of(mesh, {sound_fields(mesh)}, settings);
  EXPECT_EQ(body.shape.size(), 1000u - 7u * 7u * 7u);  // all but those in no plane and not at the surface
  EXPECT_EQ(std::accumulate(body.is_surface.begin(), body.is_surface.end(), 0), 600);
  EXPECT_GT(body.is_surface.size(), 600u);
  std::vector<PagePart> parts;
  EXPECT_EQ(body_json(body, parts)["cuts"], "fixed");
}

TEST(Body, IsPackedToHalfAStepOfItsSize) {
  const Mesh mesh = layered_bead();
  OutputFields output = sound_fields(mesh);
  for (Index c = 0; c < mesh.n_cells(); ++c) output.displacement[c] = 1e-3 * mesh.cell_centre[c];
  const Body body = body_of(mesh, {output});
  std::vector<PagePart> parts;
  const auto json = body_json(body, parts);
  const auto part = [&](const nlohmann::ordered_json& of) {
    return std::ranges::find(parts, of["id"].get<std::string>(), &PagePart::id)->base64;
  };
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto& points = json["points"][axis];
    const double from = points["from"], to = points["to"];
    const auto back = unpacked_blocks(part(points), 1, body.points.size(), from, to);
    for (std::size_t p = 0; p < body.points.size(); ++p)
      EXPECT_NEAR(back[0][p], body.points[p][axis], 0.500001 * (to - from) / 65535.0);
  }
  EXPECT_EQ(json["regions"], nlohmann::ordered_json(mesh.region_names));
  EXPECT_EQ(json["cut_axis"], 1);
}

TEST(Body, LeavesFramesOutWhereThereIsNoRoomForAll) {
  const Mesh mesh = cube_mesh(1.0, 10);
  std::vector<OutputFields> outputs(9, sound_fields(mesh));
  for (std::size_t f = 0; f < outputs.size(); ++f)
    for (Index c = 0; c < mesh.n_cells(); ++c)
      outputs[f].damage[c] = 0.5 + 0.5 * std::sin(static_cast<double>(1000 * f) + 77.0 * c);
  const Body body = body_of(mesh, outputs);
  ASSERT_EQ(body.steps.size(), 9u);
  std::vector<PagePart> all, few, least;
  EXPECT_EQ(body_json(body, all)["frames"].size(), 9u);
  const auto size = [](const std::vector<PagePart>& parts) {
    return std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                           [](std::size_t sum, const PagePart& part) { return sum + part.base64.size(); });
  };
  const auto json = body_json(body, few, 3 * size(all) / 4);
  EXPECT_LE(size(few), 3 * size(all) / 4);
  EXPECT_LT(json["frames"].size(), 9u);
  EXPECT_GT(json["frames"].size(), 2u);
  EXPECT_EQ(json["frames"].front(), 10);
  EXPECT_EQ(json["frames"].back(), 18);
  EXPECT_EQ(body_json(body, least, 1)["frames"], (nlohmann::ordered_json{10, 18}));
}

TEST(Body, RefusesFramesOfAnotherMesh) {
  const TemporaryFolder folder;
  const Mesh mesh = cube_mesh(1.0, 2), other = cube_mesh(1.0, 3);
  write_mesh(folder / "mesh.vtu", mesh);
  write_frame(folder / "frame.vtu", other, sound_fields(other));
  const BodySettings settings{
      .frames = {{.step = 0, .file = folder / "frame.vtu"}}, .progress = {0.0}, .mesh = folder / "mesh.vtu"};
  EXPECT_THAT(message_of<InputError>([&] { read_body(settings); }), HasSubstr("it has 27 cells"));
}

TEST(ChosenSteps, AreDenseWhereMuchHappens) {
  std::vector<double> progress;
  for (int i = 0; i <= 50; ++i)
    progress.push_back(i < 25 ? 0.1 * i : i < 30 ? 2.4 + 2.0 * (i - 24) : 12.4 + 0.1 * (i - 29));
  const std::vector<std::size_t> chosen = chosen_steps(progress, 12);
  ASSERT_EQ(chosen.size(), 12u);
  EXPECT_EQ(chosen.front(), 0u);
  EXPECT_EQ(chosen.back(), 50u);
  EXPECT_TRUE(std::ranges::is_sorted(chosen, std::less_equal()));
  EXPECT_GE(std::ranges::count_if(chosen, [](std::size_t i) { return i >= 24 && i < 30; }), 5);
  std::vector<double> jump(40, 0.0);
  for (std::size_t i = 0; i < jump.size(); ++i) jump[i] = 0.01 * static_cast<double>(i) + (i >= 17 ? 5.0 : 0.0);
  const std::vector<std::size_t> about = chosen_steps(jump, 10);
  EXPECT_TRUE(std::ranges::includes(about, std::vector<std::size_t>{0, 16, 17, 39}));
  EXPECT_EQ(chosen_steps(std::vector<double>(40, 1.0), 2), (std::vector<std::size_t>{0, 39}));
  EXPECT_EQ(chosen_steps({0.0, 1.0, 2.0}, 12), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(chosen_steps({}, 12).empty());
}

}  // namespace
}  // namespace pfdm::test::this_file
