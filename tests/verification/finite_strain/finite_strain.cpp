// Finite strain against closed forms: affine maps, the limit of small strain, uniform extension, a thick
// sphere under pressure, rotations.

#include "mesh/generators/sphere_sector.h"
#include "physics/materials/hyperelastic.h"
#include "tests/verification/finite_solutions.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

// The affine map of a stretch of 2 with shear and rotation, on the whole surface.
const Tensor great_gradient = (Tensor() << 1.0, 0.3, -0.2, 0.1, -0.3, 0.3, 0.25, -0.15, -0.2).finished();

void expect_affine(const Mesh& mesh, const std::shared_ptr<const Material>& material) {
  const std::vector<std::shared_ptr<const Material>> materials(mesh.region_names.size(), material);
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, true},
                             [](const Vector& x, double t) -> Vector { return t * great_gradient * x; }));
  const Finished done = solve(mesh, finite_model(materials, boundary), 4, 1e-12);
  const Tensor P = material->stress(great_gradient, {});
  const Tensor F = Tensor::Identity() + great_gradient;
  const Tensor sigma = P * F.transpose() / F.determinant();
  double u_error = 0.0, u_largest = 0.0, F_error = 0.0, stress_error = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector u = great_gradient * mesh.cell_centre[c];
    u_error = std::max(u_error, (done.fields.displacement[c] - u).norm());
    u_largest = std::max(u_largest, u.norm());
    F_error = std::max(F_error, (done.fields.deformation_gradient[c] - F).norm());
    stress_error = std::max(stress_error, (done.fields.stress[c] - sigma).norm() / sigma.norm());
  }
  double volume = 0.0;
  for (const double v : mesh.cell_volume) volume += v;
  const double W = dynamic_cast<const HyperelasticMaterial&>(*material).potential(great_gradient).energy;
  const double energy_error = std::abs(done.report.energy.elastic / (W * volume) - 1.0);
  report_row(fmt::format("{} cells, {}", mesh.n_cells(), material->name()),
             {{"u", u_error / u_largest}, {"F", F_error}, {"stress", stress_error}, {"energy", energy_error}});
  EXPECT_LE(u_error, 1e-9 * u_largest);
  EXPECT_LE(F_error, 1e-9);
  EXPECT_LE(stress_error, 1e-9);
  EXPECT_LE(energy_error, 1e-9);
}

TEST(FiniteStrain, AffineMapsAreExactOnEveryKindOfCell) {
  const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.45);
  const Mesh layered = sphere_in_cube(2, 3, 2.0, 0.8);
  for (const Mesh& mesh : {hexahedra(3), layered, barycentric_dual(layered)}) {
    expect_affine(mesh, neo_hookean(rubber));
    expect_affine(mesh,
                  make_hyperelastic("ogden", {.elasticity = rubber, .shares = {1.2, -0.2}, .exponents = {1.3, -2.0}}));
  }
}

// A sphere 50 times as stiff in a cube that is pulled and sheared by 1e-7, against the linear program.
TEST(FiniteStrain, SmallStrainsAreThoseOfTheLinearProgram) {
  const IsotropicElasticity soft = from_young_poisson(1.5e6, 0.45), stiff = from_young_poisson(75e6, 0.3);
  const Mesh layered = sphere_in_cube(3, 3, 2.0, 0.8);
  for (const Mesh& mesh : {layered, barycentric_dual(layered)}) {
    const auto is_bead = [&](std::size_t r) { return mesh.region_names[r] == "bead"; };
    std::vector<IsotropicElasticity> linear;
    std::vector<std::shared_ptr<const Material>> finite;
    const auto in_bead = make_hyperelastic("saint_venant_kirchhoff", {.elasticity = stiff}), around = neo_hookean(soft);
    for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
      linear.push_back(is_bead(r) ? stiff : soft);
      finite.push_back(is_bead(r) ? in_bead : around);
    }
    const std::vector<BoundaryCondition> boundary{
        moved("zmax", {true, true, true},
              [](const Vector& x, double t) -> Vector { return 1e-7 * t * x.z() * Vector(0.5, 0.0, 1.0); }),
        moved("zmin", {true, true, true},
              [](const Vector& x, double t) -> Vector { return 1e-7 * t * x.z() * Vector(0.5, 0.0, 1.0); })};
    const Finished small = solve(mesh, elastic_model(linear, boundary), 1);
    const Finished large = solve(mesh, finite_model(finite, boundary), 1);
    double difference = 0.0, largest = 0.0, stress = 0.0, largest_stress = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      difference = std::max(difference, (small.fields.displacement[c] - large.fields.displacement[c]).norm());
      largest = std::max(largest, small.fields.displacement[c].norm());
      stress = std::max(stress, (small.fields.stress[c] - large.fields.stress[c]).norm());
      largest_stress = std::max(largest_stress, small.fields.stress[c].norm());
    }
    const double energy = std::abs(large.report.energy.elastic / small.report.energy.elastic - 1.0);
    report_row(fmt::format("{} cells", mesh.n_cells()),
               {{"u", difference / largest}, {"stress", stress / largest_stress}, {"energy", energy}});
    EXPECT_LE(difference, 1e-6 * largest);
    EXPECT_LE(stress, 1e-5 * largest_stress);
    EXPECT_LE(energy, 0.03);  // the meshes are coarse
  }
}

// Principal stresses of the compressible neo-Hookean law with the quadratic volumetric energy, by hand.
double nominal(const IsotropicElasticity& c, double along, double other, double third) {
  const double J = along * other * third;
  return c.mu * (along - 1.0 / along) + c.lambda * (J - 1.0) * other * third;
}

// A bar on rollers to three times its length, free sides: the stretch across by bisection.
TEST(FiniteStrain, UniaxialTensionTo200Percent) {
  const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.45);
  constexpr double stretch = 3.0;
  double low = 0.3, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (nominal(rubber, middle, middle, stretch) > 0.0 ? high : low) = middle;
  }
  const double force = nominal(rubber, stretch, low, low);
  for (const Mesh& mesh : {hexahedra(2), extruded_triangles(3, {0.0, 0.5, 1.0})}) {
    std::vector<BoundaryCondition> boundary{moved("zmax", {false, false, true}, [](const Vector&, double t) -> Vector {
      return (stretch - 1.0) * t * Vector::UnitZ();
    })};
    for (const char* patch : {"xmin", "ymin", "zmin"}) boundary.push_back(symmetry_on(patch));
    const Finished done = solve(mesh, finite_model({neo_hookean(rubber)}, boundary), 5, 1e-11);
    double across = 0.0, pull = 0.0;
    for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
      if (mesh.patches[p].name == "xmax") across = 1.0 + done.report.patch_displacement[p].x();
      if (mesh.patches[p].name == "zmax") pull = done.report.reaction[p].z();
    }
    report_row(fmt::format("{} cells", mesh.n_cells()),
               {{"stretch across", across / low - 1.0}, {"force", pull / force - 1.0}});
    EXPECT_NEAR(across, low, 1e-8);
    EXPECT_NEAR(pull, force, 1e-8 * force);
  }
}

// Spherical symmetry: d(R^2 P_R)/dR = 2 R P_T with stretches r' and r/R, integrated from the inside with the stress
// there as the unknown, which makes the outside free of stress.
struct ShellSolution {
  double pressure = 0.0;  // -P_R inside, per reference area [Pa]
  double outer = 0.0;     // stretch of the outer surface
};

class Shell {
 public:
  Shell(const IsotropicElasticity& c, double inside, double outside) : c_(c), A_(inside), B_(outside) {}

  ShellSolution inflated(double stretch) const {
    double low = -50.0 * c_.mu, high = 0.0;  // P_R inside
    ShellSolution solution;
    for (int i = 0; i < 80; ++i) {
      const double P = 0.5 * (low + high);
      const auto [at_B, r_B] = integrate(P, stretch);
      (at_B > 0.0 ? high : low) = P;
      solution = {-P, r_B / B_};
    }
    return solution;
  }

 private:
  // The radial stretch that belongs to P_R and the hoop stretch.
  double radial(double P, double hoop) const {
    double low = 1e-3, high = 10.0;
    for (int i = 0; i < 70; ++i) {
      const double middle = 0.5 * (low + high);
      (nominal(c_, middle, hoop, hoop) > P ? high : low) = middle;
    }
    return low;
  }
  std::pair<double, double> slope(double R, double P, double r) const {
    const double hoop = r / R, along = radial(P, hoop);
    return {2.0 * (nominal(c_, hoop, hoop, along) - P) / R, along};
  }
  std::pair<double, double> integrate(double P, double stretch) const {
    constexpr int n = 400;
    const double h = (B_ - A_) / n;
    double R = A_, r = stretch * A_;
    for (int i = 0; i < n; ++i, R += h) {
      const auto [p1, r1] = slope(R, P, r);
      const auto [p2, r2] = slope(R + 0.5 * h, P + 0.5 * h * p1, r + 0.5 * h * r1);
      const auto [p3, r3] = slope(R + 0.5 * h, P + 0.5 * h * p2, r + 0.5 * h * r2);
      const auto [p4, r4] = slope(R + h, P + h * p3, r + h * r3);
      P += h / 6.0 * (p1 + 2.0 * p2 + 2.0 * p3 + p4);
      r += h / 6.0 * (r1 + 2.0 * r2 + 2.0 * r3 + r4);
    }
    return {P, r};
  }

  IsotropicElasticity c_;
  double A_, B_;
};

// Half a sphere of twice the inner radius outside, inflated to twice its inner radius.
TEST(FiniteStrain, ThickSphereInflatedToTwiceItsRadius) {
  constexpr double stretch = 2.0, azimuth = 0.1;
  for (const double nu : {0.3, 0.45}) {
    const IsotropicElasticity rubber = from_young_poisson(1.5e6, nu);
    const ShellSolution exact = Shell(rubber, 1.0, 2.0).inflated(stretch);
    std::vector<std::array<double, 2>> errors;
    std::vector<Index> cells;
    for (const Index n : {12, 24}) {
      const Mesh mesh = make_sphere_sector({.azimuth = azimuth,
                                            .inner_radius = 1.0,
                                            .shells = {{.radial = {.length = 1.0, .n = n}, .region = "body"}},
                                            .polar = {{.length = 0.5 * std::numbers::pi, .n = 2 * n}}});
      const std::vector<BoundaryCondition> boundary{
          axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("equator"),
          moved("inner", {true, true, true},
                [](const Vector& x, double t) -> Vector { return t * (stretch - 1.0) * x; })};
      const Finished done = solve(mesh, finite_model({neo_hookean(rubber)}, boundary), 10, 1e-8);
      Vector area = Vector::Zero(), outside = Vector::Zero();
      double outer_area = 0.0;
      for (Index f = 0; f < mesh.patch("inner").n_faces; ++f)
        area += mesh.face_area[mesh.patch("inner").first_face + f];
      for (Index f = mesh.patch("outer").first_face; f < mesh.patch("outer").first_face + mesh.patch("outer").n_faces;
           ++f) {
        outside += mesh.face_area[f].norm() * mesh.face_centre[f];
        outer_area += mesh.face_area[f].norm();
      }
      // Force and displacement along the axis z.
      const double pressure = -done.report.reaction[mesh.patch_index("inner")].z() / area.z();
      const double outer =
          1.0 + done.report.patch_displacement[mesh.patch_index("outer")].z() / (outside.z() / outer_area);
      const double balance = done.report.energy.external_work / done.report.energy.elastic - 1.0;
      errors.push_back(
          {std::abs(pressure / exact.pressure - 1.0), std::abs((outer - exact.outer) / (exact.outer - 1.0))});
      cells.push_back(mesh.n_cells());
      report_row(fmt::format("nu {}, {} cells", nu, mesh.n_cells()), {{"pressure / mu", pressure / rubber.mu},
                                                                      {"pressure error", errors.back()[0]},
                                                                      {"outer error", errors.back()[1]},
                                                                      {"work over energy - 1", balance},
                                                                      {"Krylov", double(done.krylov_iterations)},
                                                                      {"CPU s", done.cpu_seconds}});
    }
    EXPECT_LE(errors[1][0], 0.01) << nu;
    EXPECT_LE(errors[1][1], 0.01) << nu;
    EXPECT_LE(errors[1][0], 0.7 * errors[0][0]) << nu;
  }
}

// A heterogeneous body stretched by a half, and the same turned by 90 degrees on the way.
TEST(FiniteStrain, RotationsChangeNoEnergy) {
  const Mesh mesh = sphere_in_cube(2, 3, 2.0, 0.8);
  std::vector<std::shared_ptr<const Material>> materials;
  const auto soft = neo_hookean(from_young_poisson(1.5e6, 0.45)), stiff = neo_hookean(from_young_poisson(75e6, 0.3));
  for (const std::string& name : mesh.region_names) materials.push_back(name == "bead" ? stiff : soft);
  const auto run = [&](double angle) {
    std::vector<BoundaryCondition> boundary;
    for (const char* patch : {"zmin", "zmax"})
      boundary.push_back(moved(patch, {true, true, true}, [angle](const Vector& x, double t) -> Vector {
        const Tensor R = Eigen::AngleAxisd(t * angle, Vector(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
        return R * (x + 0.5 * t * x.z() * Vector::UnitZ()) - x;
      }));
    return solve(mesh, finite_model(materials, boundary), 8, 1e-11);
  };
  const Finished straight = run(0.0), turned = run(0.5 * std::numbers::pi);
  const double energy = turned.report.energy.elastic / straight.report.energy.elastic - 1.0;
  report_row("turned by 90 degrees", {{"energy", energy}});
  EXPECT_LE(std::abs(energy), 1e-10);
}

}  // namespace
}  // namespace pfdm::verification::this_file
