// That other programs open frames as they are written by default; skipped where these are not installed.

#include "mesh/dual.h"
#include "mesh/generators/particles_in_box.h"
#include "postproc/fields/frame.h"
#include "postproc/fields/point_displacement.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/vtkhdf.h"
#include "tests/postproc/opened_fields.h"
#include "tests/postproc/pixels.h"
#include "tests/postproc/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

struct Said {
  int status = 0;
  std::string text;
};

Said run(const std::string& command) {
  Said said;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 256> buffer{};
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe)) said.text += buffer.data();
  said.status = pipe ? WEXITSTATUS(pclose(pipe)) : -1;
  return said;
}

Mesh layered_bead() {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-2.0);
  settings.upper = Vector::Constant(2.0);
  settings.size_far = 0.8;
  settings.particles.resize(1);
  settings.particles[0].radius = 1.0;
  settings.particles[0].subdivision = 2;
  settings.particles[0].n_layers = 1;
  settings.particles[0].layer_thickness = 0.2;
  return make_particles_in_box(settings);
}

/// A frame of the mesh as a tool prints it: the sound one or, at time 0.5, the opened one.
void add_frame(PvdSeries& series, const Mesh& mesh, const std::filesystem::path& folder, double time) {
  const bool is_open = time == 0.5;
  const OutputFields output = is_open ? opened_fields(mesh, Vector::UnitZ(), 0.3, Vector::UnitZ()) : sound_fields(mesh);
  const SplitPoints points = point_displacement(mesh, {}, output, 1.0);
  const std::string file = is_open ? "open.vtu" : "sound.vtu";
  VtuWriter(mesh).write(folder / file, frame_fields(mesh, output), time, &points);
  series.add(time, file);
}

/// Opens the file in the tool, where its last frame is the opened one.
void expect_opens(const std::string& interpreter, const std::string& tool, const Mesh& mesh,
                  const std::filesystem::path& file) {
  const Said said = run(fmt::format("{} {}/read_frames.py {} {}", interpreter, PFDM_TEST_SCRIPTS, tool, file.string()));
  if (said.status == 77 || said.status == 127) GTEST_SKIP() << tool << " is not installed";
  if (said.status == 78) GTEST_SKIP() << said.text;
  ASSERT_EQ(said.status, 0) << said.text;
  double damage = 0.0;
  for (const double d : opened_fields(mesh, Vector::UnitZ(), 0.3, Vector::UnitZ()).damage) damage += d;
  EXPECT_THAT(said.text, HasSubstr(fmt::format("{} cells, damage {:g}, time 0.5, region_bead region_interface "
                                               "region_matrix, warped from -2 to 3",
                                               mesh.n_cells(), damage)));
}

void expect_opens(const std::string& interpreter, const std::string& tool, const Mesh& mesh) {
  const TemporaryFolder folder;
  PvdSeries series(folder / "fields.pvd");
  add_frame(series, mesh, folder.path(), 0.5);
  expect_opens(interpreter, tool, mesh, folder / "fields.pvd");
}

TEST(FramesInTools, meshio_reads_tetrahedra_and_prisms) { expect_opens("/usr/bin/python3", "meshio", layered_bead()); }

TEST(FramesInTools, paraview_warps_tetrahedra_and_prisms) { expect_opens("pvpython", "paraview", layered_bead()); }

TEST(FramesInTools, paraview_warps_polyhedra) {
  expect_opens("pvpython", "paraview", barycentric_dual(layered_bead()));
}

TEST(FramesInTools, paraview_reads_frames_in_one_file) {
  const TemporaryFolder folder;
  const Mesh mesh = layered_bead();
  PvdSeries series(folder / "fields.pvd");
  for (const double time : {0.25, 0.5}) add_frame(series, mesh, folder.path(), time);
  write_vtkhdf(folder / "fields.pvd", folder / "fields.vtkhdf");
  expect_opens("pvpython", "paraview", mesh, folder / "fields.vtkhdf");
}

// The state of the shipped bead, with another bead.
TEST(FramesInTools, paraview_draws_the_state_of_the_bead) {
  const TemporaryFolder folder;
  PvdSeries series(folder / "fields.pvd");
  add_frame(series, layered_bead(), folder.path(), 0.5);
  const std::filesystem::path picture = folder / "bead.png";
  const Said said =
      run(fmt::format("pvpython --force-offscreen-rendering {}/../../cases/glass_bead_quick/paraview_state.py {} {}",
                      PFDM_TEST_SCRIPTS, folder.path().string(), picture.string()));
  if (said.status == 127) GTEST_SKIP() << "ParaView is not installed";
  ASSERT_EQ(said.status, 0) << said.text;
  const Pixels drawn = read_png(content_of(picture));
  ASSERT_EQ(drawn.width, 900);
  ASSERT_EQ(drawn.height, 900);
  for (const int y : {2, 430}) EXPECT_EQ(*drawn.at(450, y), 255);  // above the body, and where the crack has opened
  int n_drawn = 0;
  for (int y = 0; y < 900; ++y)
    for (int x = 0; x < 800; ++x) {  // beside the bar of colours
      const unsigned char* p = drawn.at(x, y);
      n_drawn += p[0] < 250 || p[1] < 250 || p[2] < 250 ? 1 : 0;
    }
  EXPECT_GT(n_drawn, 100000);
}

}  // namespace
}  // namespace pfdm::test::this_file
