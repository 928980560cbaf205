#include "mesh/generators/packed_spheres.h"

#include "mesh/packing/sphere_packing.h"
#include "mesh/surfaces/sphere_refinement.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double milli = 1e-3;

double volume_of(const std::vector<double>& diameters) {
  double volume = 0.0;
  for (const double d : diameters) volume += std::numbers::pi / 6.0 * d * d * d;
  return volume;
}

SpherePacking equal_spheres(std::size_t n, double fraction, double gap) {
  const double radius = std::cbrt(fraction / double(n) * 3.0 / (4.0 * std::numbers::pi));
  return {.lower = Vector::Zero(),
          .upper = Vector::Ones(),
          .radii = std::vector<double>(n, radius),
          .gap = gap * radius,
          .wall_gap = gap * radius};
}

void expect_apart(const SpherePacking& packing, const std::vector<Vector>& centres) {
  ASSERT_EQ(centres.size(), packing.radii.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double reach = packing.radii[i] + packing.wall_gap;
    EXPECT_GE((centres[i] - packing.lower).minCoeff(), reach * (1.0 - 1e-12));
    EXPECT_GE((packing.upper - centres[i]).minCoeff(), reach * (1.0 - 1e-12));
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((centres[i] - centres[j]).norm(), (packing.radii[i] + packing.radii[j] + packing.gap) * (1.0 - 1e-12));
  }
}

TEST(SpherePacking, KeepsGapsAtFortyPerCent) {
  const SpherePacking packing = equal_spheres(60, 0.4, 0.04);
  EXPECT_NEAR(volume_fraction(packing), 0.4, 1e-12);
  RandomNumbers random(3);
  expect_apart(packing, pack_spheres(packing, random));
}

TEST(SpherePacking, IsDecidedByTheSeed) {
  const SpherePacking packing = equal_spheres(20, 0.3, 0.1);
  RandomNumbers one(1), again(1), other(2);
  const std::vector<Vector> places = pack_spheres(packing, one);
  EXPECT_EQ(places, pack_spheres(packing, again));
  EXPECT_NE(places, pack_spheres(packing, other));
}

// Of centres that are spread evenly: the mean is the middle of the box, to its standard error.
TEST(SpherePacking, FillsTheBoxEvenly) {
  Vector sum = Vector::Zero();
  constexpr int n_seeds = 20;
  for (int seed = 1; seed <= n_seeds; ++seed) {
    RandomNumbers random(static_cast<std::uint64_t>(seed));
    for (const Vector& x : pack_spheres(equal_spheres(20, 0.25, 0.05), random)) sum += x / 20.0;
  }
  EXPECT_LT((sum / n_seeds - Vector::Constant(0.5)).cwiseAbs().maxCoeff(), 4.0 * 0.25 / std::sqrt(20.0 * n_seeds));
}

TEST(SpherePacking, SaysWhatWasReachedWhereThereIsNoRoom) {
  RandomNumbers random(1);
  EXPECT_THAT(message_of<InputError>([&] { pack_spheres(equal_spheres(60, 0.68, 0.1), random); }),
              HasSubstr("no more than about 0.55 can be packed at random"));
  EXPECT_THAT(message_of<InputError>([&] { pack_spheres(equal_spheres(1, 0.55, 0.1), random); }),
              HasSubstr("has no room in a box"));
}

TEST(RandomNumbers, RotationsAreRotations) {
  RandomNumbers random(5);
  Tensor mean = Tensor::Zero();
  for (int i = 0; i < 4000; ++i) {
    const Tensor R = random.rotation();
    ASSERT_LT((R * R.transpose() - Tensor::Identity()).norm(), 1e-13);
    ASSERT_NEAR(R.determinant(), 1.0, 1e-13);
    mean += R / 4000.0;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5.0 / std::sqrt(3.0 * 4000.0));  // each entry has mean 0, variance 1/3
}

TEST(SphereRefinement, RefinesWhereWantedAndStaysClosed) {
  const auto wanted = [](const Vector& x) { return x[2] > 0.9 ? 0.05 : 10.0; };
  const TriangleSurface sphere = refined_sphere(unit_icosphere(4), wanted);
  std::set<std::pair<Index, Index>> edges;
  double least_angle = 180.0;
  for (const Triangle& t : sphere.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector &a = sphere.points[t[k]], &b = sphere.points[t[(k + 1) % 3]], &c = sphere.points[t[(k + 2) % 3]];
      EXPECT_TRUE(edges.emplace(t[k], t[(k + 1) % 3]).second);
      EXPECT_NEAR(a.norm(), 1.0, 1e-14);
      if (((a + b + c) / 3.0).normalized()[2] > 0.9) {
        EXPECT_LE((a - b).norm(), 0.05);
      }
      least_angle =
          std::min(least_angle, std::acos((b - a).normalized().dot((c - a).normalized())) * 180.0 / std::numbers::pi);
    }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
  EXPECT_EQ(Index(sphere.points.size()) - Index(edges.size() / 2) + Index(sphere.triangles.size()), 2);  // Euler
  EXPECT_GT(least_angle, 20.0);
  EXPECT_LT(sphere.triangles.size(), 2500U);
  EXPECT_GT(enclosed_volume(sphere), enclosed_volume(unit_icosphere(4)));
}

TEST(Diameters, FillTheVolume) {
  const DiameterDistribution spread{.kind = DiameterDistribution::Kind::lognormal, .mean = 0.1, .coefficient = 0.3};
  const std::vector<double> diameters = draw_diameters(spread, 0, 0.3, false, 7);
  EXPECT_NEAR(volume_of(diameters), 0.3, 1e-14);
  const std::vector<double> counted = draw_diameters(spread, 25, 0.3, true, 7);
  EXPECT_EQ(counted.size(), 25U);
  EXPECT_NEAR(volume_of(counted), 0.3, 1e-14);
  EXPECT_THAT(message_of<InputError>([&] {
                draw_diameters({.kind = DiameterDistribution::Kind::constant, .mean = 1.0}, 0, 0.1, false, 7);
              }),
              HasSubstr("no whole number of such spheres"));
}

// 20,000 numbers: mean and coefficient of variation to four standard errors.
TEST(Diameters, HaveMeanAndSpreadOfTheirDistribution) {
  const auto moments = [](const DiameterDistribution& distribution) {
    std::vector<double> all;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const std::vector<double> some = draw_diameters(distribution, 1000, 0.0, false, seed);
      all.insert(all.end(), some.begin(), some.end());
    }
    double mean = 0.0, square = 0.0;
    for (const double d : all) mean += d / double(all.size());
    for (const double d : all) square += (d - mean) * (d - mean) / double(all.size());
    return std::pair{mean, std::sqrt(square) / mean};
  };
  const auto [mean, spread] =
      moments({.kind = DiameterDistribution::Kind::lognormal, .mean = 2.0, .coefficient = 0.25});
  EXPECT_NEAR(mean, 2.0, 4.0 * 0.5 / std::sqrt(20000.0));
  EXPECT_NEAR(spread, 0.25, 0.01);
  const auto [middle, width] = moments({.kind = DiameterDistribution::Kind::uniform, .least = 1.0, .most = 3.0});
  EXPECT_NEAR(middle, 2.0, 4.0 * 0.58 / std::sqrt(20000.0));
  EXPECT_NEAR(width, 1.0 / std::sqrt(12.0), 0.01);
}

PackedSpheresSettings composite(std::size_t n, double fraction) {
  PackedSpheresSettings settings;
  settings.box.upper = Vector::Constant(milli);
  settings.like.subdivision = 3;
  settings.like.region = "particle";
  settings.diameters = draw_diameters({.mean = 1.0}, static_cast<Index>(n), fraction * 1e-9, true, 1);
  settings.gap = settings.wall_gap = 0.02 * settings.diameters.front();
  return settings;
}

TEST(PackedSpheres, HaveTheirVolumeFractionInTheMesh) {
  const Mesh mesh = make_packed_spheres(composite(8, 0.3));
  expect_sound(mesh);
  EXPECT_NEAR(total_volume(mesh), 1e-9, 1e-21);
  EXPECT_NEAR(region_volume(mesh, "particle"), 0.3e-9, 1e-20);
  ASSERT_EQ(mesh.patches.size(), 6U);
}

TEST(PackedSpheres, AreOneRegionEachOnRequest) {
  PackedSpheresSettings settings = composite(4, 0.2);
  settings.numbered = true;
  const Mesh mesh = make_packed_spheres(settings);
  for (const char* region : {"particle_1", "particle_2", "particle_3", "particle_4"})
    EXPECT_NEAR(region_volume(mesh, region), 0.05e-9, 1e-21);
}

// Polyhedra keep the gap: measured from corner to corner of the mesh.
TEST(PackedSpheres, KeepTheirGapInTheMesh) {
  const PackedSpheresSettings settings = composite(8, 0.4);
  const ParticlesInBoxSettings box = packed_particles(settings);
  for (std::size_t i = 0; i < box.particles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Particle &a = box.particles[i], &b = box.particles[j];
      EXPECT_GE((a.centre - b.centre).norm() - a.radius - b.radius, settings.gap * (1.0 - 1e-9));
    }
}

TEST(PackedSpheres, AreFinerWhereTheyAreClose) {
  PackedSpheresSettings settings = composite(2, 0.05);
  const double d = settings.diameters.front();
  settings.centres = {Vector(0.5 * milli - 0.55 * d, 0.5 * milli, 0.5 * milli),
                      Vector(0.5 * milli + 0.55 * d, 0.5 * milli, 0.5 * milli)};
  const ParticlesInBoxSettings graded = packed_particles(settings);
  settings.edges_over_gap = 0.0;
  const ParticlesInBoxSettings plain = packed_particles(settings);
  EXPECT_EQ(plain.particles[0].directions.triangles.size(), 180U);
  const auto n_towards = [](const Particle& p, double sign) {
    return std::ranges::count_if(p.directions.points, [&](const Vector& x) { return sign * x[0] > 0.8; });
  };
  EXPECT_GT(n_towards(graded.particles[0], 1.0), 2 * n_towards(plain.particles[0], 1.0));
  EXPECT_LE(n_towards(graded.particles[0], -1.0), n_towards(plain.particles[0], -1.0) + 4);
}

TEST(PackedSpheres, WithLayersAreWholeToo) {
  PackedSpheresSettings settings = composite(5, 0.15);
  settings.like.n_layers = 2;
  settings.like.layer_thickness = 0.05 * settings.diameters.front();
  const Mesh mesh = make_packed_spheres(settings);
  expect_sound(mesh);
  EXPECT_NEAR(region_volume(mesh, "particle"), 0.15e-9, 1e-20);
  EXPECT_GT(region_volume(mesh, "interface"), 0.0);
}

}  // namespace
}  // namespace pfdm::this_file
