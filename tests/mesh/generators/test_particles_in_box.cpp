#include <cmath>
#include <numbers>

#include "mesh/generators/expected_cells.h"
#include "mesh/generators/particles_in_box.h"
#include "mesh/quality.h"
#include "mesh/surfaces/size_field.h"
#include "mesh/surfaces/triangle_surface.h"
#include "physics/error.h"
#include "physics/system/machine_limits.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double micro = 1e-6;

Particle bead(const Vector& centre, Index subdivision, Index n_layers) {
  Particle particle;
  particle.centre = centre * micro;
  particle.radius = 100.0 * micro;
  particle.subdivision = subdivision;
  particle.n_layers = n_layers;
  particle.layer_thickness = 40.0 * micro;
  return particle;
}

ParticlesInBoxSettings one_bead(Index subdivision, Index n_layers) {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-400.0 * micro);
  settings.upper = Vector::Constant(400.0 * micro);
  settings.particles = {bead(Vector::Zero(), subdivision, n_layers)};
  return settings;
}

double box_volume(const ParticlesInBoxSettings& s) { return (s.upper - s.lower).prod(); }

TEST(ParticlesInBox, LayersAreWedgesBetweenTetrahedra) {
  const ParticlesInBoxSettings settings = one_bead(4, 20);
  const Mesh mesh = make_particles_in_box(settings);
  expect_sound(mesh);
  EXPECT_EQ(count_cells(mesh, CellShape::wedge), 20 * 4 * 4 * 20);
  EXPECT_EQ(count_cells(mesh, CellShape::wedge) + count_cells(mesh, CellShape::tetrahedron), mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c)
    EXPECT_EQ(mesh.shape[c] == CellShape::wedge, mesh.region[c] == mesh.region_index("interface"));
  EXPECT_NEAR(total_volume(mesh) / box_volume(settings), 1.0, 1e-12);
  // All three parts are bounded by the same polyhedral sphere at two radii.
  const double ball = region_volume(mesh, "bead");
  EXPECT_NEAR(region_volume(mesh, "interface") / ball, 1.4 * 1.4 * 1.4 - 1.0, 1e-12);
}

TEST(ParticlesInBox, BeadAndMatrixMeetOnlyThroughTheLayers) {
  const Mesh mesh = make_particles_in_box(one_bead(5, 3));
  Index bead_faces = 0;
  Index matrix_faces = 0;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const std::string& a = mesh.region_names[mesh.region[mesh.owner[f]]];
    const std::string& b = mesh.region_names[mesh.region[mesh.neighbour[f]]];
    if (a == b) continue;
    EXPECT_TRUE(a == "interface" || b == "interface");
    const bool is_bead = a == "bead" || b == "bead";
    (is_bead ? bead_faces : matrix_faces) += 1;
    const double radius = (is_bead ? 100.0 : 140.0) * micro;
    for (const Index p : mesh.points_of_face(f)) EXPECT_NEAR(mesh.points[p].norm() / radius, 1.0, 1e-13);
  }
  EXPECT_EQ(bead_faces, 500);
  EXPECT_EQ(matrix_faces, 500);
}

TEST(ParticlesInBox, SidesOfTheBoxArePatches) {
  ParticlesInBoxSettings settings = one_bead(4, 2);
  settings.upper = Vector(300, 500, 250) * micro;
  const Mesh mesh = make_particles_in_box(settings);
  expect_sound(mesh);
  const Vector extent = settings.upper - settings.lower;
  ASSERT_EQ(mesh.patches.size(), 6U);
  for (int axis = 0; axis < 3; ++axis) {
    const double area = extent.prod() / extent[axis];
    const std::string letter(1, static_cast<char>('x' + axis));
    EXPECT_NEAR((patch_area(mesh, letter + "min") + area * Vector::Unit(axis)).norm() / area, 0.0, 1e-12);
    EXPECT_NEAR((patch_area(mesh, letter + "max") - area * Vector::Unit(axis)).norm() / area, 0.0, 1e-12);
  }
}

TEST(ParticlesInBox, WithoutLayersTheSurfaceIsTheInterface) {
  const auto volume_error = [](Index n) {
    const Mesh mesh = make_particles_in_box(one_bead(n, 0));
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"bead", "matrix"}));
    const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(100.0 * micro, 3);
    return 1.0 - region_volume(mesh, "bead") / exact;
  };
  EXPECT_NEAR(volume_error(4) / volume_error(8), 4.0, 0.2);
}

TEST(ParticlesInBox, SameInputSameMesh) {
  ParticlesInBoxSettings settings = one_bead(4, 2);
  const Mesh a = make_particles_in_box(settings);
  make_particles_in_box(one_bead(3, 0));  // leaves nothing behind
  const Mesh b = make_particles_in_box(settings);
  expect_same(a, b);
}

// How far the mesh's points on the bead are from those with x and y exchanged, at most [radius].
double unlikeness_of_x_and_y(double angle) {
  ParticlesInBoxSettings settings = one_bead(4, 2);
  settings.particles[0].angle = angle;
  const Mesh mesh = make_particles_in_box(settings);
  const double radius = settings.particles[0].radius;
  std::vector<Vector> on_bead;
  for (const Vector& x : mesh.points)
    if (std::abs(x.norm() - radius) < 1e-9 * radius) on_bead.emplace_back(x / radius);
  EXPECT_EQ(on_bead.size(), 10u * 4u * 4u + 2u);
  double worst = 0.0;
  for (const Vector& x : on_bead) {
    double nearest = 1.0;
    for (const Vector& y : on_bead) nearest = std::min(nearest, (y - Vector(x[1], x[0], x[2])).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(ParticlesInBox, ABeadTurnedBy45DegreesIsAlikeAlongXAndY) {
  EXPECT_GT(unlikeness_of_x_and_y(0.0), 0.05);
  EXPECT_LT(unlikeness_of_x_and_y(0.25 * std::numbers::pi), 1e-9);
}

TEST(ParticlesInBox, UnitOfLengthDoesNotMatter) {
  const Mesh small = make_particles_in_box(one_bead(4, 2));
  ParticlesInBoxSettings settings = one_bead(4, 2);
  const double scale = 1048576.0;  // a power of two keeps every digit
  settings.lower *= scale;
  settings.upper *= scale;
  settings.particles[0].radius *= scale;
  settings.particles[0].layer_thickness *= scale;
  const Mesh large = make_particles_in_box(settings);
  EXPECT_EQ(small.owner, large.owner);
  EXPECT_EQ(small.face_points, large.face_points);
}

TEST(ParticlesInBox, CellsFollowTheWantedSize) {
  ParticlesInBoxSettings settings = one_bead(6, 2);
  settings.size_far = 120.0 * micro;
  settings.particle_size_factor = 1.5;
  const Mesh mesh = make_particles_in_box(settings);
  const double core = icosphere_size(6, 100.0 * micro);
  const SizeField size({{Vector::Zero(), 140.0 * micro, 1.4 * core, 100.0 * micro, core, 1.5 * core}}, settings.grading,
                       settings.size_far);
  Index too_large = 0;
  double filled = 0.0;  // volumes over those of regular tetrahedra of the wanted size
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (mesh.shape[c] != CellShape::tetrahedron) continue;
    const double relative = mesh.cell_volume[c] / (0.1178 * std::pow(size(mesh.cell_centre[c]), 3));
    if (relative > 1.31) ++too_large;
    filled += relative;
  }
  const Index n = count_cells(mesh, CellShape::tetrahedron);
  EXPECT_LE(too_large, n / 100);
  EXPECT_GT(filled / n, 0.3);  // not needlessly fine either
}

TEST(ParticlesInBox, SeveralParticlesWithTheirOwnRegions) {
  ParticlesInBoxSettings settings = one_bead(4, 3);
  settings.particles[0].centre = Vector(-200, -150, 0) * micro;
  settings.particles.push_back(bead(Vector(150, 150, 100), 3, 0));
  settings.particles.push_back(bead(Vector(150, -180, -150), 3, 1));
  settings.particles[1].region = "void";
  settings.particles[2].layer_region = "coating";
  settings.particles[2].surface_size = 50.0 * micro;
  settings.particles[2].subdivision = 0;
  const Mesh mesh = make_particles_in_box(settings);
  expect_sound(mesh);
  EXPECT_THAT(mesh.region_names, ::testing::UnorderedElementsAre("bead", "interface", "matrix", "void", "coating"));
  EXPECT_EQ(count_cells(mesh, CellShape::wedge), 20 * 16 * 3 + 20 * 4);
  const double sphere = 4.0 / 3.0 * std::numbers::pi * std::pow(100.0 * micro, 3);
  EXPECT_NEAR(region_volume(mesh, "void") / sphere, 0.92, 0.04);
  EXPECT_LT(region_volume(mesh, "matrix"), box_volume(settings) - 2.0 * sphere);
}

TEST(ParticlesInBox, NoParticlesMakeABoxOfTetrahedra) {
  ParticlesInBoxSettings settings;
  settings.upper = Vector(2, 1, 1);
  settings.size_far = 0.25;
  const Mesh mesh = make_particles_in_box(settings);
  expect_sound(mesh);
  EXPECT_EQ(count_cells(mesh, CellShape::tetrahedron), mesh.n_cells());
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"matrix"});
  EXPECT_NEAR(total_volume(mesh), 2.0, 1e-12);
  EXPECT_EQ(mesh.patch("xmax").n_faces, 2 * 4 * 4);
  settings.boundary_size = 0.125;
  EXPECT_EQ(make_particles_in_box(settings).patch("xmax").n_faces, 2 * 8 * 8);
}

TEST(ParticlesInBox, BenchmarkMeshIsOrthogonalEnoughAndBanded) {
  const Mesh mesh = make_particles_in_box(one_bead(8, 20));
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_LT(quality.non_orthogonality.mean, 9.5);
  EXPECT_LT(quality.non_orthogonality.max, 80.0);
  EXPECT_LT(bandwidth(mesh), mesh.n_cells() / 12);
}

TEST(ParticlesInBox, ParticleOutsideTheBoxIsRefused) {
  ParticlesInBoxSettings settings = one_bead(4, 20);
  settings.particles[0].centre = Vector(0, 0, 270) * micro;
  EXPECT_THAT(message_of<InputError>([&] { make_particles_in_box(settings); }),
              AllOf(HasSubstr("particle 1"), HasSubstr("leaves the box"), HasSubstr("more than 140 um"),
                    HasSubstr("has 130 um")));
  settings.particles[0].n_layers = 0;  // fits without them
  EXPECT_NO_THROW(make_particles_in_box(settings));
}

TEST(ParticlesInBox, TouchingParticlesAreRefused) {
  ParticlesInBoxSettings settings = one_bead(4, 2);
  settings.particles[0].centre = Vector(-140, 0, 0) * micro;
  settings.particles.push_back(bead(Vector(100, 0, 0), 4, 2));
  EXPECT_THAT(message_of<InputError>([&] { make_particles_in_box(settings); }),
              AllOf(HasSubstr("particle 1"), HasSubstr("particle 2"), HasSubstr("240 um apart"),
                    HasSubstr("more than 280 um")));
}

TEST(ParticlesInBox, SizesThatAreNotPositiveAreRefused) {
  const auto message = [](auto&& change) {
    ParticlesInBoxSettings settings = one_bead(4, 2);
    change(settings);
    return message_of<InputError>([&] { make_particles_in_box(settings); });
  };
  EXPECT_THAT(message([](auto& s) { s.particles[0].radius = -1e-4; }),
              AllOf(HasSubstr("radius"), HasSubstr("-0.0001")));
  EXPECT_THAT(message([](auto& s) { s.particles[0].subdivision = 0; }), HasSubstr("surface size"));
  EXPECT_THAT(message([](auto& s) { s.particles[0].subdivision = -3; }), HasSubstr("-3"));
  EXPECT_THAT(message([](auto& s) { s.particles[0].surface_size = 1e-5; }), HasSubstr("give one"));
  EXPECT_THAT(message([](auto& s) { s.particles[0].layer_thickness = 0.0; }), HasSubstr("thickness"));
  EXPECT_THAT(message([](auto& s) { s.particles[0].n_layers = -1; }), HasSubstr("-1 layers"));
  EXPECT_THAT(message([](auto& s) { s.upper[1] = s.lower[1]; }), HasSubstr("sides"));
  EXPECT_THAT(message([](auto& s) { s.size_far = 0.0; }), HasSubstr("size_far"));
  EXPECT_THAT(message([](auto& s) { s.grading = -0.1; }), HasSubstr("grading"));
  EXPECT_THAT(message([](auto& s) { s.boundary_size = -1.0; }), HasSubstr("box's surface"));
  EXPECT_THAT(message([](auto& s) { s.particles.clear(); }), HasSubstr("size_far"));
  EXPECT_THAT(message([](auto& s) { s.particles[0].centre[0] = NAN; }), HasSubstr("particle 1"));
}

// One of the points at which the size is asked for lies in it: it was taken for 8 million cells.
TEST(ParticlesInBox, ASmallFineSphereIsNoReasonToRefuse) {
  const double edge = 1000.0 * micro, radius = 10.0 * micro, fine = 0.5 * micro;
  const Vector lower = Vector::Zero(), upper = Vector::Constant(edge);
  for (const double at : {0.5, 0.525}) {
    const SizeField size({{.centre = Vector::Constant(at * edge),
                           .radius = radius,
                           .outer_size = fine,
                           .core = radius,
                           .core_size = fine,
                           .core_limit = fine}},
                         0.5, 150.0 * micro);
    EXPECT_LT(expected_tetrahedra(size, lower, upper), 1e6);
  }
}

// TetGen would take minutes before it ran out of memory.
TEST(ParticlesInBox, WithMoreCellsThanMemoryAreRefusedAtOnce) {
  ParticlesInBoxSettings settings = one_bead(2, 0);
  settings.size_far = 60.0 * micro;
  const double cells = static_cast<double>(make_particles_in_box(settings).n_cells());
  const SizeField even({}, 1.0, settings.size_far);
  EXPECT_NEAR(cells / expected_tetrahedra(even, settings.lower, settings.upper), 1.15, 0.35);
  if (machine_limits().memory > 4e11) GTEST_SKIP() << "this machine has the memory";
  settings.size_far = 3.8 * micro;  // 8e7 cells
  settings.boundary_size = 50.0 * micro;
  EXPECT_THAT([&] { make_particles_in_box(settings); },
              ::testing::ThrowsMessage<InputError>(AllOf(HasSubstr("the box"), HasSubstr("GB of memory"))));
}

}  // namespace
}  // namespace pfdm::this_file
