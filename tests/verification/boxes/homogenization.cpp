// Effective stiffness of a box in six load cases, against what is known exactly: a homogeneous box, a laminate (Backus,
// J. Geophys. Res. 67 (1962) 4427), a dilute sphere (Eshelby, Proc. R. Soc. A 241 (1957) 376), the bounds of Hashin and
// Shtrikman (J. Mech. Phys. Solids 11 (1963) 127), and the order of the energies of the three boundary conditions.

#include "solver/homogenization/homogenization.h"
#include "mesh/generators/packed_spheres.h"
#include "physics/elasticity/effective_stiffness.h"
#include "physics/error.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr const char* all_loadings[] = {"uniform traction", "periodic", "uniform displacement"};

Homogenized homogenized(const Mesh& mesh, const std::vector<IsotropicElasticity>& by_region, const char* loading,
                        double tolerance = 1e-9) {
  LinearComposite composite{.elasticity = by_region, .zone = {}};
  for (std::size_t r = 0; r < by_region.size(); ++r) {
    const auto same = std::ranges::find(by_region, by_region[r]);
    composite.zone.push_back(static_cast<Index>(same - by_region.begin()));
  }
  return homogenize(mesh, composite, {.loading = &homogenization_loading(loading), .tolerance = tolerance});
}

Index most_iterations(const Homogenized& result) {
  Index most = 0;
  for (const LoadCase& one : result.cases) most = std::max(most, one.iterations);
  return most;
}

double apart(const MandelMatrix& a, const MandelMatrix& b) { return (a - b).norm() / b.norm(); }

BoxHexesSettings block(const std::vector<AxisBlock>& z) {
  BoxHexesSettings settings;
  settings.axes = {{{{.length = 2.0, .n = 5}}, {{.length = 1.0, .n = 4, .ratio = 2.0}}, z}};
  return settings;
}

TEST(Homogenization, HomogeneousBoxIsExact) {
  const Mesh hexes = make_box_hexes(block({{.length = 1.5, .n = 6}}));
  ParticlesInBoxSettings box;
  box.lower = Vector(-1.0, -1.0, -1.0);
  box.upper = Vector(1.0, 1.0, 2.0);
  box.size_far = 0.5;
  const Mesh tetrahedra = make_particles_in_box(box);
  for (const double nu : {0.3, 0.49}) {
    const IsotropicElasticity c = from_young_poisson(2e6, nu);
    for (const Mesh& mesh : {hexes, tetrahedra, barycentric_dual(tetrahedra)})
      for (const char* loading : all_loadings) {
        const Homogenized result = homogenized(mesh, {c}, loading, 1e-11);
        const double error = apart(result.stiffness, stiffness_matrix(c));
        report_row(fmt::format("{}, nu {}, {} cells", loading, nu, mesh.n_cells()),
                   {{"error", error},
                    {"energies", result.energy_difference()},
                    {"iterations", static_cast<double>(most_iterations(result))}});
        EXPECT_LE(error, 3e-10);
        EXPECT_LE(result.energy_difference(), 2e-11);
        EXPECT_NEAR(result.fraction[0], 1.0, 1e-10);
      }
  }
}

// Layers normal to z. Means are by thickness; M = lambda + 2 mu.
MandelMatrix backus(const std::vector<IsotropicElasticity>& materials, const std::vector<double>& fractions) {
  double soft_M = 0.0, soft_mu = 0.0, mu = 0.0, ratio = 0.0, in_plane = 0.0;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const auto [l, m] = materials[i];
    const double M = l + 2.0 * m, f = fractions[i];
    soft_M += f / M;
    soft_mu += f / m;
    mu += f * m;
    ratio += f * l / M;
    in_plane += f * 4.0 * m * (l + m) / M;
  }
  const double C33 = 1.0 / soft_M, C13 = ratio / soft_M, C11 = in_plane + ratio * ratio / soft_M, C12 = C11 - 2.0 * mu;
  MandelMatrix C = MandelMatrix::Zero();
  C.topLeftCorner<3, 3>() << C11, C12, C13, C12, C11, C13, C13, C13, C33;
  C(3, 3) = C(4, 4) = 2.0 / soft_mu;
  C(5, 5) = 2.0 * mu;
  return C;
}

Mesh laminate() {
  Mesh mesh = make_box_hexes(block({{.length = 0.3, .n = 2}, {.length = 0.5, .n = 4}, {.length = 0.2, .n = 3}}));
  mesh.region_names = {"a", "b", "c"};
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double z = mesh.cell_centre[c][2];
    mesh.region[c] = z < 0.3 ? 0 : z < 0.8 ? 1 : 2;
  }
  return mesh;
}

TEST(Homogenization, PeriodicLaminateIsExact) {
  const Mesh mesh = laminate();
  for (const double ratio : {10.0, 1e4}) {
    const std::vector<IsotropicElasticity> materials{from_young_poisson(1e6, 0.4), from_young_poisson(ratio * 1e6, 0.2),
                                                     from_young_poisson(1e6, 0.45)};
    const MandelMatrix exact = backus(materials, {0.3, 0.5, 0.2});
    const Homogenized result = homogenized(mesh, materials, "periodic", 1e-12);
    const double error = apart(result.stiffness, exact);
    // Across the layers the stiffness is that of the soft ones.
    const double across = std::abs(result.stiffness(2, 2) / exact(2, 2) - 1.0);
    const double shear = std::abs(result.stiffness(3, 3) / exact(3, 3) - 1.0);
    report_row(fmt::format("ratio {}", ratio),
               {{"error", error}, {"across", across}, {"shear", shear}, {"asymmetry", result.asymmetry}});
    EXPECT_LE(error, 1e-11);
    EXPECT_LE(across, 4e-11);
    EXPECT_LE(shear, ratio > 100.0 ? 4e-9 : 1e-11);
    EXPECT_LE(result.energy_difference(), 1e-8);
    for (const char* loading : {"uniform traction", "uniform displacement"}) {
      const MandelMatrix C = homogenized(mesh, materials, loading).stiffness;
      const double sign = loading[8] == 't' ? 1.0 : -1.0;
      const Eigen::SelfAdjointEigenSolver<MandelMatrix> eigen(sign * (exact - C));
      EXPECT_GE(eigen.eigenvalues()[0], -1e-5 * C.norm()) << loading;
    }
  }
}

// Residuals are relative to the forces of the stiff layer, at the tolerance by default.
TEST(Homogenization, LaminateOfAnyContrastIsExact) {
  const Mesh mesh = laminate();
  for (const double ratio : {1e3, 1e6, 1e9}) {
    const std::vector<IsotropicElasticity> materials{from_young_poisson(1e6, 0.4), from_young_poisson(ratio * 1e6, 0.2),
                                                     from_young_poisson(1e6, 0.45)};
    const MandelMatrix exact = backus(materials, {0.3, 0.5, 0.2});
    const Homogenized result = homogenized(mesh, materials, "periodic", 1e-8);
    const double across = result.stiffness(2, 2) / exact(2, 2) - 1.0;
    const double shear = result.stiffness(3, 3) / exact(3, 3) - 1.0;
    report_row(fmt::format("ratio {}", ratio), {{"across", across}, {"shear", shear}});
    EXPECT_LE(std::abs(across), 1e-4);
    EXPECT_LE(std::abs(shear), 1e-4);
  }
}

// Of the volume fraction, at zero.
struct DiluteSlopes {
  double bulk, shear;
};

DiluteSlopes eshelby(const IsotropicElasticity& sphere, const IsotropicElasticity& matrix) {
  const double K = matrix.bulk_modulus(), G = matrix.mu, nu = matrix.poisson_ratio(), r = sphere.mu / G;
  return {(sphere.bulk_modulus() - K) * (3.0 * K + 4.0 * G) / (3.0 * sphere.bulk_modulus() + 4.0 * G),
          15.0 * (1.0 - nu) * (r - 1.0) / (7.0 - 5.0 * nu + 2.0 * (4.0 - 5.0 * nu) * r) * G};
}

// The slope of the chord from no sphere at all depends on the fraction, to first order by the neighbours' images: it is
// followed to zero through two fractions, and through three.
void expect_dilute_limit(const IsotropicElasticity& sphere, const IsotropicElasticity& matrix) {
  const DiluteSlopes exact = eshelby(sphere, matrix);
  std::vector<double> f, K, G;
  for (const double half_width : {2.4, 3.0, 3.8}) {
    const Mesh mesh = barycentric_dual(sphere_in_cube(8, 6, half_width, 0.35));
    std::vector<IsotropicElasticity> materials;
    for (const std::string& name : mesh.region_names) materials.push_back(name == "bead" ? sphere : matrix);
    const Homogenized result = homogenized(mesh, materials, "periodic", 1e-8);
    const IsotropicElasticity closest = closest_isotropic(result.stiffness);
    f.push_back(result.fraction[mesh.region_index("bead")]);
    K.push_back((closest.bulk_modulus() - matrix.bulk_modulus()) / f.back() / exact.bulk);
    G.push_back((closest.mu - matrix.mu) / f.back() / exact.shear);
    report_row(fmt::format("fraction {:.4f}, {} cells", f.back(), mesh.n_cells()),
               {{"chord K", K.back()},
                {"chord G", G.back()},
                {"asymmetry", result.asymmetry},
                {"energies", result.energy_difference()},
                {"iterations", static_cast<double>(most_iterations(result))}});
  }
  const auto at_zero = [&](const std::vector<double>& y) { return y[2] - f[2] * (y[1] - y[2]) / (f[1] - f[2]); };
  report_row("at no fraction, over Eshelby's", {{"K", at_zero(K)}, {"G", at_zero(G)}});
  EXPECT_NEAR(at_zero(K), 1.0, 0.02);
  EXPECT_NEAR(at_zero(G), 1.0, 0.02);
}

TEST(Homogenization, DiluteGlassSpheresFollowEshelby) {
  expect_dilute_limit(from_young_poisson(70e9, 0.22), from_young_poisson(2e9, 0.35));
}

TEST(Homogenization, DiluteSoftSpheresFollowEshelby) {
  expect_dilute_limit(from_young_poisson(0.1e9, 0.3), from_young_poisson(2e9, 0.35));
}

PackedSpheresSettings beads(double fraction, Index count, Index subdivision) {
  PackedSpheresSettings settings;
  settings.box.lower = Vector::Zero();
  settings.box.upper = Vector::Ones();
  settings.like.subdivision = subdivision;
  settings.like.region = "particle";
  settings.diameters = draw_diameters({.mean = 1.0}, count, fraction, true, 1);
  settings.gap = settings.wall_gap = fraction < 0.3 ? 0.02 : 0.005;
  settings.edges_over_gap = 0.0;
  return settings;
}

// The same beads, whose surfaces are finer.
PackedSpheresSettings finer(PackedSpheresSettings settings, Index subdivision) {
  for (const Particle& particle : packed_particles(settings).particles) settings.centres.push_back(particle.centre);
  settings.like.subdivision = subdivision;
  return settings;
}

// The least eigenvalue of what the second stiffness is above the first, in the metric of the second.
double margin(const MandelMatrix& lower, const MandelMatrix& upper) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MandelMatrix> eigen(upper - lower, upper, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0];
}

struct Glued {
  IsotropicElasticity glass = from_young_poisson(70e9, 0.22), binder = from_young_poisson(0.7e9, 0.4);
  double fraction;

  Homogenized in(const Mesh& mesh, const char* loading) const {
    std::vector<IsotropicElasticity> materials;
    for (const std::string& name : mesh.region_names) materials.push_back(name == "particle" ? glass : binder);
    Homogenized result = homogenized(mesh, materials, loading, 1e-6);
    const IsotropicElasticity closest = closest_isotropic(result.stiffness);
    report_row(fmt::format("{}, fraction {}, {} cells", loading, fraction, mesh.n_cells()),
               {{"K over lower bound", closest.bulk_modulus() / bounds().bulk_lower},
                {"G over lower bound", closest.mu / bounds().shear_lower},
                {"anisotropy", anisotropy(result.stiffness)},
                {"asymmetry", result.asymmetry},
                {"energies", result.energy_difference()},
                {"constitutive", result.constitutive_difference()},
                {"iterations", static_cast<double>(most_iterations(result))}});
    EXPECT_NEAR(result.fraction[mesh.region_index("particle")], fraction, 1e-9);
    EXPECT_LE(result.energy_difference(), 2e-4);
    EXPECT_LE(most_iterations(result), most_of(loading));
    return result;
  }

  static Index most_of(const std::string& loading) {
    return loading == "uniform traction" ? 85 : loading == "periodic" ? 46 : 34;
  }

  ModulusBounds bounds() const {
    const Phase phases[] = {{1.0 - fraction, binder}, {fraction, glass}};
    return hashin_shtrikman(phases);
  }
};

class Beads : public testing::TestWithParam<double> {};

TEST_P(Beads, KeepToTheOrderOfTheEnergies) {
  const Glued glued{.fraction = GetParam()};
  const Mesh mesh = make_packed_spheres(beads(glued.fraction, glued.fraction < 0.3 ? 6 : 20, 3));
  std::vector<Homogenized> results;
  for (const char* loading : all_loadings) results.push_back(glued.in(mesh, loading));
  report_row("margins", {{"periodic over traction", margin(results[0].stiffness, results[1].stiffness)},
                         {"displacement over periodic", margin(results[1].stiffness, results[2].stiffness)}});
  EXPECT_GE(margin(results[0].stiffness, results[1].stiffness), 0.0);
  EXPECT_GE(margin(results[1].stiffness, results[2].stiffness), 0.0);
}

// The lower bounds are almost reached at low fractions: the mesh's error, from two meshes of the same beads, decides.
TEST_P(Beads, KeepToHashinShtrikman) {
  const Glued glued{.fraction = GetParam()};
  const bool dense = glued.fraction > 0.3;
  const PackedSpheresSettings packing = beads(glued.fraction, dense ? 20 : 6, dense ? 3 : 2);
  const IsotropicElasticity coarse = closest_isotropic(glued.in(make_packed_spheres(packing), "periodic").stiffness);
  const ModulusBounds bounds = glued.bounds();
  EXPECT_LE(coarse.bulk_modulus(), bounds.bulk_upper);
  EXPECT_LE(coarse.mu, bounds.shear_upper);
  if (dense) {
    EXPECT_GE(coarse.bulk_modulus(), bounds.bulk_lower);
    EXPECT_GE(coarse.mu, bounds.shear_lower);
    return;
  }
  const IsotropicElasticity fine =
      closest_isotropic(glued.in(make_packed_spheres(finer(packing, 4)), "periodic").stiffness);
  const double bulk_error = fine.bulk_modulus() - coarse.bulk_modulus(), shear_error = fine.mu - coarse.mu;
  // Of second order, a third of the difference is due.
  EXPECT_GE(fine.bulk_modulus() + 0.5 * std::abs(bulk_error), bounds.bulk_lower);
  EXPECT_GE(fine.mu + 0.5 * std::abs(shear_error), bounds.shear_lower);
  EXPECT_LE(std::abs(bulk_error), 0.02 * bounds.bulk_lower);
  EXPECT_LE(std::abs(shear_error), 0.05 * bounds.shear_lower);
}

INSTANTIATE_TEST_SUITE_P(Homogenization, Beads, testing::Values(0.1, 0.25, 0.4));

TEST(Homogenization, RefusesWhatIsNoBox) {
  BoxHexesSettings settings = block({{.length = 1.0, .n = 4}});
  settings.holes = {{.name = "bite", .lower = Vector(-1.0, -1.0, -1.0), .upper = Vector(0.5, 2.0, 0.5)}};
  EXPECT_THROW(homogenized(make_box_hexes(settings), {from_young_poisson(1e6, 0.3)}, "uniform traction"), InputError);
}

}  // namespace
}  // namespace pfdm::verification::this_file
