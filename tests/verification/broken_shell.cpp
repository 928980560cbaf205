// A glass sphere in Sylgard under remote swelling, the matrix broken to g = 1e-6 in a shell of prism layers: a curved
// band of one elastic zone, nothing but g tells it from its surroundings. In every concentric layer
//
//   u_r = A r + B / r^2,   sigma_rr = 3 K A - 4 mu B / r^3,
//
// with u_r and sigma_rr continuous (Timoshenko, Goodier, Theory of Elasticity, art. 142).

#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification {
namespace {

// Concentric layers from the centre outwards; the last one is infinite.
class ConcentricLayers {
 public:
  ConcentricLayers(std::vector<double> radii, std::vector<IsotropicElasticity> moduli, double remote_swell)
      : radii_(std::move(radii)), moduli_(std::move(moduli)) {
    const auto n = static_cast<Index>(radii_.size());
    // Unknowns: A and B of each layer in turn; B = 0 in the innermost, A given in the outermost.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(2 * n + 2);
    for (Index i = 0; i < n; ++i) {
      const double r = radii_[as_size(i)], stiffness = moduli_[0].bulk_modulus();
      for (const Index side : {0, 1}) {
        const IsotropicElasticity& c = moduli_[as_size(i + side)];
        const double sign = side == 0 ? 1.0 : -1.0;
        system.block<2, 2>(2 * i, 2 * (i + side)) << sign * r, sign / (r * r),  //
            sign * 3.0 * c.bulk_modulus() / stiffness, -sign * 4.0 * c.mu / (r * r * r * stiffness);
      }
    }
    system(2 * n, 1) = 1.0;
    system(2 * n + 1, 2 * n) = 1.0;
    rhs[2 * n + 1] = remote_swell;
    coefficients_ = system.fullPivLu().solve(rhs);
  }

  Vector displacement(const Vector& x) const {
    const double r = x.norm();
    const Index k = layer_at(r);
    return (A(k) + B(k) / (r * r * r)) * x;
  }

  Tensor strain(const Vector& x) const {
    const double r = x.norm();
    const Index k = layer_at(r);
    const Vector n = x / r;
    const double decaying = B(k) / (r * r * r);
    return (A(k) + decaying) * Tensor::Identity() - 3.0 * decaying * n * n.transpose();
  }

  /// sigma_rr on the innermost sphere.
  double core_traction() const { return 3.0 * moduli_[0].bulk_modulus() * A(0); }

 private:
  double A(Index layer) const { return coefficients_[2 * layer]; }
  double B(Index layer) const { return coefficients_[2 * layer + 1]; }
  Index layer_at(double r) const {
    return static_cast<Index>(std::lower_bound(radii_.begin(), radii_.end(), r) - radii_.begin());
  }

  std::vector<double> radii_;
  std::vector<IsotropicElasticity> moduli_;
  Eigen::VectorXd coefficients_;
};

constexpr double half_width = 4.0;
constexpr Index n_layers = 10;
constexpr double layer_thickness = 0.04;
constexpr Index first_broken = 4;  // counted from the sphere

IsotropicElasticity degraded(const IsotropicElasticity& c, double g) { return {g * c.lambda, g * c.mu}; }

// Prisms of the broken layers: their points lie on the layers' spheres.
CellField<double> broken_shell(const Mesh& mesh, Index n_broken, double g) {
  CellField<double> factors(as_size(mesh.n_cells()), 1.0);
  const double lower = 1.0 + first_broken * layer_thickness, upper = lower + n_broken * layer_thickness;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (mesh.shape[c] != CellShape::wedge) continue;
    double mean = 0.0;
    for (const Index p : mesh.points_of_cell(c)) mean += mesh.points[as_size(p)].norm() / 6.0;
    if (mean > lower && mean < upper) factors[c] = g;
  }
  return factors;
}

class BrokenShell : public testing::TestWithParam<std::tuple<Index, double>> {};

TEST_P(BrokenShell, HoldsTheSphereNoMoreThanItShould) {
  const auto [n_broken, g] = GetParam();
  const IsotropicElasticity glass = from_young_poisson(70e9, 0.3), matrix = from_young_poisson(75e6, 0.44);
  const double lower = 1.0 + first_broken * layer_thickness, upper = lower + n_broken * layer_thickness;
  const ConcentricLayers exact({1.0, lower, upper}, {glass, matrix, degraded(matrix, g), matrix}, 1e-3);
  const Mesh mesh = sphere_in_cube(8, n_layers, half_width, 0.3);
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : mesh.region_names) by_region.push_back(name == "bead" ? glass : matrix);
  const auto u_exact = [&](const Vector& x) { return exact.displacement(x); };
  const CellField<double> factors = broken_shell(mesh, n_broken, g);
  const auto solution = solve_elastic(mesh, elastic_model(by_region, displacement_on_all(mesh, u_exact)), factors, 1e-10);
  EXPECT_TRUE(solution->equilibrium.converged);
  EXPECT_EQ(std::count(factors.begin(), factors.end(), g), 20 * 8 * 8 * n_broken);
  double error = 0.0, n_faces = 0.0, mean = 0.0;
  for (const auto& [face, traction] : solution->solver->balance().interface_tractions(solution->u)) {
    const double relative = traction.dot(mesh.face_area[face].normalized()) / exact.core_traction() - 1.0;
    error += relative * relative;
    mean += relative;
    n_faces += 1.0;
  }
  const double u = displacement_error(mesh, *solution, u_exact);
  const double strain = relative_stress_error(
      mesh, solution->cells.strain, [&](const Vector& x) { return exact.strain(x); },
      [&](Index c) { return factors[c] < 1.0; });
  const double stress_outside = relative_stress_error(
      mesh, solution->cells.stress, [&](const Vector& x) { return stress(matrix, exact.strain(x)); },
      [&](Index c) { return factors[c] == 1.0 && mesh.cell_centre[c].norm() > upper; });
  const double stress_inside = relative_stress_error(
      mesh, solution->cells.stress, [&](const Vector& x) { return stress(matrix, exact.strain(x)); },
      [&](Index c) { return factors[c] == 1.0 && mesh.cell_centre[c].norm() < lower && mesh.cell_centre[c].norm() > 1.0; });
  report_row(fmt::format("g {}, {} layers, {} cells", g, n_broken, mesh.n_cells()),
             {{"traction on the sphere", std::sqrt(error / n_faces)}, {"mean", mean / n_faces},
              {"u", u},
              {"strain in the shell", strain},
              {"stress outside", stress_outside}, {"inside", stress_inside}, {"exact core traction", exact.core_traction()},
              {"iterations", solution->equilibrium.iterations}});
}

INSTANTIATE_TEST_SUITE_P(Layers, BrokenShell, testing::Combine(testing::Values(1, 2, 4), testing::Values(1.0, 0.1, 1e-2, 1e-4, 1e-6)));

}  // namespace
}  // namespace pfdm::verification
