// The same mesh on every processor: compilers' contraction to fused operations, the width of vectors and the C
// library's code for one kind of processor change no bit of it. TetGen, as Debian compiles it, runs the same code on
// all x86-64.

#include <cstdint>
#include <numbers>

#include "mesh/dual.h"
#include "mesh/generators/cylinder_sector.h"
#include "mesh/generators/packed_spheres.h"
#include "mesh/generators/sphere_sector.h"
#include "tests/mesh/checksum.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

std::uint64_t checksum(const Mesh& mesh) {
  Checksum sum;
  for (const Vector& x : mesh.points) sum.add(x);
  for (const Index p : mesh.cell_points) sum.add(static_cast<std::uint64_t>(p));
  for (const Index r : mesh.region) sum.add(static_cast<std::uint64_t>(r));
  for (const Vector& x : mesh.cell_centre) sum.add(x);
  for (const double v : mesh.cell_volume) sum.add(v);
  for (const Vector& a : mesh.face_area) sum.add(a);
  return sum.sum();
}

// As in cases/glass_bead_quick, coarser.
ParticlesInBoxSettings turned_bead() {
  Particle bead;
  bead.radius = 200e-6;
  bead.surface_size = 60e-6;
  bead.angle = 0.25 * std::numbers::pi;
  bead.n_layers = 3;
  bead.layer_thickness = 30e-6;
  ParticlesInBoxSettings settings;
  settings.lower = {-500e-6, -400e-6, -500e-6};
  settings.upper = {500e-6, 400e-6, 500e-6};
  settings.particles = {bead};
  settings.size_far = 200e-6;
  return settings;
}

PackedSpheresSettings scattered_spheres() {
  PackedSpheresSettings settings;
  settings.box.upper = Vector::Ones();
  settings.like.surface_size = 0.15;
  settings.gap = settings.wall_gap = 0.02;
  settings.diameters = draw_diameters({.kind = DiameterDistribution::Kind::lognormal, .mean = 0.2, .coefficient = 0.3},
                                      12, 0.15, true, 7);
  return settings;
}

CylinderSectorSettings lens() {
  return {
      .azimuth = std::numbers::pi / 36.0, .radius = {{1.0, 7, 0.3}}, .height = {{0.7, 5, 2.0}}, .upper_sphere = 3.0};
}

SphereSectorSettings ball() {
  return {.azimuth = std::numbers::pi / 30.0,
          .shells = {{{1.0, 6, 0.5}, "core"}, {{0.5, 2, 1.0}, "skin"}},
          .polar = {{0.3 * std::numbers::pi, 9, 0.5}, {0.7 * std::numbers::pi, 17, 1.0}}};
}

TEST(MeshBits, AreTheSameOnEveryProcessor) {
#if !defined(__x86_64__)
  GTEST_SKIP() << "TetGen and long double are others there";
#endif
  const Mesh bead = make_particles_in_box(turned_bead());
  EXPECT_EQ(checksum(bead), 11524354773327207671U);
  EXPECT_EQ(checksum(barycentric_dual(bead)), 3213987376398348742U);
  EXPECT_EQ(checksum(make_packed_spheres(scattered_spheres())), 275152949772637887U);
  EXPECT_EQ(checksum(make_cylinder_sector(lens())), 9149810343255423700U);
  EXPECT_EQ(checksum(make_sphere_sector(ball())), 14515998119551382180U);
}

}  // namespace
}  // namespace pfdm::this_file
