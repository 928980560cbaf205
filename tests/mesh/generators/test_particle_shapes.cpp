// Particles from surface files: reading, remeshing, placing, meshing.

#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "mesh/generators/particles_in_box.h"
#include "mesh/surfaces/particle_shape.h"
#include "mesh/surfaces/sphere_refinement.h"
#include "mesh/surfaces/surface_file.h"
#include "mesh/surfaces/surface_remeshing.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/temporary_folder.h"

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A cube of side 2 about (10, 0, 0), each square as one polygon.
constexpr const char* cube_obj =
    "# synthetic: a cube\n"
    "o cube\n"
    "v 9 -1 -1\nv 11 -1 -1\nv 11 1 -1\nv 9 1 -1\nv 9 -1 1\nv 11 -1 1\nv 11 1 1\nv 9 1 1\nv 0 0 0\n"
    "vn 0 0 1\n"
    "f 1//1 4//1 3//1 2//1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf -9 -5 -2 -6\n";

TriangleSurface surface_in(const std::string& name, const std::string& content, std::size_t* n_merged = nullptr) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << content;
  return read_surface_file(folder / name, n_merged);
}

std::string text_stl(const TriangleSurface& surface) {
  std::string text = "solid synthetic\n";
  for (const Triangle& t : surface.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const Index p : t) {
      const Vector& x = surface.points[p];
      text += "  vertex " + std::to_string(x[0]) + ' ' + std::to_string(x[1]) + ' ' + std::to_string(x[2]) + '\n';
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid synthetic\n";
}

std::string binary_stl(const TriangleSurface& surface) {
  std::string bytes = "solid, though binary: synthetic";
  bytes.resize(84, ' ');
  const auto count = static_cast<std::uint32_t>(surface.triangles.size());
  std::memcpy(bytes.data() + 80, &count, 4);
  for (const Triangle& t : surface.triangles) {
    std::array<float, 12> numbers{};
    for (std::size_t i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) numbers[3 * (i + 1) + as_size(k)] = static_cast<float>(surface.points[t[i]][k]);
    std::string record(50, '\0');
    std::memcpy(record.data(), numbers.data(), sizeof numbers);
    bytes += record;
  }
  return bytes;
}

TriangleSurface cube() { return surface_in("cube.obj", cube_obj); }

TriangleSurface ellipsoid(Index n) {
  TriangleSurface surface = unit_icosphere(n);
  for (Vector& x : surface.points) x = Vector(3.0 * x[0], 2.0 * x[1], 1.0 * x[2]);
  return surface;
}

double longest_edge(const TriangleSurface& surface) {
  double longest = 0.0;
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest, (surface.points[t[i]] - surface.points[t[(i + 1) % 3]]).norm());
  return longest;
}

TEST(SurfaceFile, ReadsPolygonsOfObjAndLeavesOutWhatIsNoTriangle) {
  const TriangleSurface surface = cube();
  EXPECT_EQ(surface.points.size(), 8U);
  EXPECT_EQ(surface.triangles.size(), 12U);
  EXPECT_NEAR(enclosed_volume(surface), 8.0, 1e-12);
  EXPECT_NEAR((centroid(surface) - Vector(10, 0, 0)).norm(), 0.0, 1e-12);
}

TEST(SurfaceFile, MergesPointsOfObjThatCoincide) {
  std::string obj;
  for (const char* side : {"0 0 0/0 1 0/1 1 0/1 0 0", "0 0 1/1 0 1/1 1 1/0 1 1", "0 0 0/1 0 0/1 0 1/0 0 1",
                           "0 1 0/0 1 1/1 1 1/1 1 0", "-0 0 0/0 0 1/0 1 1/0 1 0", "1 0 0/1 1 0/1 1 1/1 0 1"}) {
    std::istringstream points(side);
    for (std::string point; std::getline(points, point, '/');) obj += "v " + point + '\n';
    obj += "f -4 -3 -2 -1\n";
  }
  std::size_t n_merged = 0;
  const TriangleSurface surface = surface_in("sides.obj", obj, &n_merged);
  EXPECT_EQ(n_merged, 16U);
  EXPECT_EQ(surface.points.size(), 8U);
  EXPECT_NEAR(enclosed_volume(surface), 1.0, 1e-12);
  EXPECT_NO_THROW(check_surfaces({{"it", surface}}));
  surface_in("cube.obj", cube_obj, &n_merged);
  EXPECT_EQ(n_merged, 0U);
}

TEST(SurfaceFile, StlAsTextInCapitalsAndBinaryIsTheSameSurface) {
  const TriangleSurface body = ellipsoid(3);
  std::string capitals = text_stl(body);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const std::string& content : {text_stl(body), capitals, binary_stl(body)}) {
    const TriangleSurface read = surface_in("ellipsoid.STL", content);
    EXPECT_EQ(read.points.size(), body.points.size());
    EXPECT_EQ(read.triangles.size(), body.triangles.size());
    EXPECT_NEAR(enclosed_volume(read) / enclosed_volume(body), 1.0, 2e-6);
    EXPECT_NO_THROW(check_surfaces({{"it", read}}));
  }
}

TEST(SurfaceFile, SaysWhatIsWrongAndWhere) {
  const auto message = [](const std::string& name, const std::string& content) {
    return message_of<InputError>([&] { surface_in(name, content); });
  };
  EXPECT_THAT(message("a.ply", "ply"), HasSubstr("must be a file .stl or .obj"));
  EXPECT_THAT(message("a.stl", "nothing of the kind"), HasSubstr("is no STL"));
  EXPECT_THAT(message("a.stl", binary_stl(cube()).substr(1)), HasSubstr("is no STL"));
  EXPECT_THAT(message("a.stl", "solid\nvertex 0 0 x\n"), AllOf(HasSubstr("line 2"), HasSubstr("three coordinates")));
  EXPECT_THAT(message("a.stl", "solid\nvertex 0 0 0\nendfacet\n"), AllOf(HasSubstr("line 3"), HasSubstr("1 vertices")));
  EXPECT_THAT(message("a.stl", "solid\nfacet\nvertex 0 0 0\n"), HasSubstr("ends within a facet"));
  EXPECT_THAT(message("a.stl", "solid\nvertexes\n"), AllOf(HasSubstr("line 2"), HasSubstr("\"vertexes\"")));
  EXPECT_THAT(message("a.stl", "solid\nendsolid\n"), HasSubstr("has no triangles"));
  EXPECT_THAT(message("a.obj", "v 0 0 0\nf 1 2 3\n"), AllOf(HasSubstr("line 2"), HasSubstr("there is no point 2")));
  EXPECT_THAT(message("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), HasSubstr("a face has 2 points"));
  EXPECT_THAT(message("a.obj", "v 0 0 0\nf 1.5 1 1\n"), HasSubstr("found \"1.5\""));
  EXPECT_THAT(message("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), HasSubstr("triangle 1 has no area"));
}

TEST(Remeshing, KeepsTheSidesOfACubeAndReachesTheSize) {
  const TriangleSurface fine = remeshed({"the cube", cube()}, 0.3);
  EXPECT_NEAR(enclosed_volume(fine), 8.0, 1e-9);
  EXPECT_LT(longest_edge(fine), 1.5 * 0.3);
  // 24 of area in equilateral triangles of that edge.
  EXPECT_NEAR(static_cast<double>(fine.triangles.size()), 24.0 / (0.25 * std::sqrt(3.0) * 0.09), 200.0);
}

TEST(Remeshing, FollowsASmoothBodyAndRepeatsItself) {
  const TriangleSurface given = ellipsoid(12);
  const TriangleSurface coarse = remeshed({"it", given}, 0.5);
  EXPECT_LT(coarse.triangles.size(), given.triangles.size() / 2);
  EXPECT_NEAR(enclosed_volume(coarse) / (8.0 * std::numbers::pi), 1.0, 0.06);
  EXPECT_EQ(remeshed({"it", given}, 0.5).points, coarse.points);
}

TEST(Remeshing, RejectsWhatIsNoBody) {
  const auto message = [](const TriangleSurface& surface) {
    return message_of<InputError>([&] { remeshed({"grain.stl", surface}, 0.5); });
  };
  TriangleSurface surface = cube();
  surface.triangles.pop_back();
  EXPECT_THAT(message(surface), AllOf(HasSubstr("grain.stl"), HasSubstr("not closed")));
  surface = cube();
  for (Triangle& t : surface.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(message(surface), HasSubstr("inside out"));
  surface = cube();
  std::swap(surface.triangles[0][0], surface.triangles[0][1]);
  EXPECT_THAT(message(surface), HasSubstr("not an orientable manifold"));
  surface = ellipsoid(4);
  surface.points[0] *= -1.1;
  EXPECT_THAT(message(surface), HasSubstr("intersect"));
  surface = cube();
  const TriangleSurface other = cube();
  for (const Vector& x : other.points) surface.points.emplace_back(x + Vector(5, 0, 0));
  for (const Triangle& t : other.triangles) surface.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_THAT(message(surface), HasSubstr("2 separate pieces"));
}

TEST(ParticleShape, OffsetsMovePlanesByTheirDistance) {
  const TriangleSurface body = remeshed({"the cube", cube()}, 0.5);
  const std::vector<Vector> offsets = offset_directions(body);
  TriangleSurface grown = body;
  for (std::size_t i = 0; i < offsets.size(); ++i) grown.points[i] += 0.25 * offsets[i];
  EXPECT_NEAR(enclosed_volume(grown), 2.5 * 2.5 * 2.5, 1e-9);
  const TriangleSurface sphere = unit_icosphere(12);
  const std::vector<Vector> radial = offset_directions(sphere);
  for (std::size_t i = 0; i < radial.size(); ++i) EXPECT_NEAR((radial[i] - sphere.points[i]).norm(), 0.0, 0.05);
}

TEST(ParticleShape, KnowsInsideFromOutside) {
  // A torus, whose centroid is outside: 24 by 12 points, radii 3 and 1.
  TriangleSurface torus;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 12; ++j) {
      const double a = 2.0 * std::numbers::pi * i / 24, b = 2.0 * std::numbers::pi * j / 12;
      torus.points.emplace_back((3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b));
      const auto at = [](int k, int l) { return static_cast<Index>(12 * (k % 24) + l % 12); };
      torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  ASSERT_NO_THROW(check_surfaces({{"the torus", torus}}));
  EXPECT_FALSE(encloses(torus, centroid(torus)));
  EXPECT_TRUE(encloses(torus, Vector(3, 0, 0)));
  EXPECT_TRUE(encloses(torus, point_inside(torus)));
  EXPECT_FALSE(encloses(torus, Vector(3, 0, 1.2)));
}

ParticlesInBoxSettings shaped(const TriangleSurface& body, Index n_layers) {
  Particle particle;
  particle.surface_size = 0.5;
  particle.shape = remeshed({"the body", about_centroid(body, 1.0, Tensor::Identity())}, 0.5);
  particle.centre = Vector(1, 0, 0);
  particle.n_layers = n_layers;
  particle.layer_thickness = 0.3;
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-5.0);
  settings.upper = Vector::Constant(5.0);
  settings.particles = {particle};
  return settings;
}

TEST(ParticlesInBox, TakesACubeWithLayers) {
  const Mesh mesh = make_particles_in_box(shaped(cube(), 4));
  expect_sound(mesh);
  EXPECT_NEAR(region_volume(mesh, "bead"), 8.0, 1e-9);
  EXPECT_NEAR(region_volume(mesh, "interface"), 2.6 * 2.6 * 2.6 - 8.0, 1e-9);
  EXPECT_NEAR(total_volume(mesh), 1000.0, 1e-9);
}

TEST(ParticlesInBox, TakesAnEllipsoidBesideASphere) {
  ParticlesInBoxSettings settings = shaped(ellipsoid(12), 0);
  const double volume = enclosed_volume(settings.particles[0].shape);
  Particle sphere;
  sphere.centre = Vector(1, 0, 3);
  sphere.radius = 1.0;
  sphere.subdivision = 4;
  sphere.region = "sphere";
  settings.particles.push_back(sphere);
  const Mesh mesh = make_particles_in_box(settings);
  expect_sound(mesh);
  EXPECT_NEAR(region_volume(mesh, "bead") / volume, 1.0, 1e-9);
  EXPECT_EQ(mesh.region_names.size(), 3U);
  expect_same(mesh, make_particles_in_box(settings));
}

TEST(ParticlesInBox, RejectsAShapeThatLeavesTheBoxOrHoldsAnother) {
  const auto message = [](const ParticlesInBoxSettings& settings) {
    return message_of<InputError>([&] { make_particles_in_box(settings); });
  };
  ParticlesInBoxSettings settings = shaped(cube(), 0);
  settings.particles[0].centre = Vector(4.5, 0, 0);
  EXPECT_THAT(message(settings), AllOf(HasSubstr("particle 1"), HasSubstr("intersect")));
  settings.particles[0].centre = Vector(9, 0, 0);
  EXPECT_THAT(message(settings), AllOf(HasSubstr("particle 1"), HasSubstr("leaves the box")));
  settings.particles[0].centre = Vector(1, 0, 0);
  Particle sphere;
  sphere.centre = Vector(1, 0, 0);
  sphere.radius = 0.3;
  sphere.subdivision = 2;
  settings.particles.push_back(sphere);
  EXPECT_THAT(message(settings), HasSubstr("particle 2 (centre (1, 0, 0) m, radius 300 mm) lies within particle 1"));
  settings.particles.pop_back();
  settings.particle_size_factor = 1.0;
  EXPECT_THAT(message(settings), HasSubstr("particle_size_factor"));
}

}  // namespace
}  // namespace pfdm::this_file
