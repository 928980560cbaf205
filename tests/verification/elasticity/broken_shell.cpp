// A glass sphere in Sylgard under remote swelling, the matrix weakened to g in a shell of prism layers: a curved band
// within one elastic zone, nothing but g tells it from its surroundings. In every concentric layer
//
//   u_r = A r + B / r^2,   sigma_rr = 3 K A - 4 mu B / r^3,
//
// with u_r and sigma_rr continuous (Timoshenko, Goodier, Theory of Elasticity, art. 142). Where the crack is closed and
// the split keeps the bulk modulus, the shell is a liquid.

#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

// Concentric layers from the centre outwards; the last one is infinite.
class ConcentricLayers {
 public:
  ConcentricLayers(std::vector<double> radii, std::vector<IsotropicElasticity> moduli, double remote_swell)
      : radii_(std::move(radii)), moduli_(std::move(moduli)) {
    const auto n = count_of(radii_);
    // Unknowns: A and B of each layer in turn; B = 0 in the innermost, A given in the outermost.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(2 * n + 2);
    for (Index i = 0; i < n; ++i) {
      const double r = radii_[i], stiffness = moduli_[0].bulk_modulus();
      for (const Index side : {0, 1}) {
        const IsotropicElasticity& c = moduli_[i + side];
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

constexpr Index subdivision = 8, n_layers = 10, first_broken = 4;  // layers are counted from the sphere
constexpr double half_width = 4.0, layer_thickness = 0.04;         // [R]

enum class Cells { tetrahedra_and_prisms, polyhedra };

struct Shell {
  Index n_broken;  // layers
  double g;
  bool closed;
  Cells cells = Cells::tetrahedra_and_prisms;
  double poisson_ratio = 0.44;  // of the matrix

  // Polyhedra reach from the middle of one layer to that of the next.
  double lower() const { return 1.0 + (first_broken - (cells == Cells::polyhedra ? 0.5 : 0.0)) * layer_thickness; }
  double upper() const { return lower() + n_broken * layer_thickness; }
  bool holds(double r) const { return r > lower() && r < upper(); }
};

Mesh mesh_of(Cells cells) {
  const Mesh mesh = sphere_in_cube(subdivision, n_layers, half_width, 0.3);
  return cells == Cells::polyhedra ? barycentric_dual(mesh) : mesh;
}

// Layers are told apart by the mean radius of their points, which lie on spheres; their centres do not.
double mean_radius(const Mesh& mesh, Index cell) {
  double sum = 0.0;
  for (const Index p : mesh.points_of_cell(cell)) sum += mesh.points[p].norm();
  return sum / static_cast<double>(mesh.points_of_cell(cell).size());
}

CellField<double> stiffness_factors(const Mesh& mesh, const Shell& shell) {
  CellField<double> g(mesh.n_cells(), 1.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.region[c] == mesh.region_index("interface") && shell.holds(mean_radius(mesh, c))) g[c] = shell.g;
  return g;
}

// Root mean square over the sphere's faces, relative.
double core_traction_error(const Mesh& mesh, const ElasticSolution& solution, double exact) {
  const auto tractions = solution.solver->balance().interface_tractions(solution.u);
  double sum = 0.0;
  for (const auto& [face, traction] : tractions)
    sum += std::pow(traction.dot(mesh.face_area[face].normalized()) / exact - 1.0, 2);
  return std::sqrt(sum / static_cast<double>(tractions.size()));
}

struct ShellErrors {
  double core_traction = 0.0, displacement = 0.0, shell_strain = 0.0, stress_within = 0.0, stress_beyond = 0.0;
  Index iterations = 0;
};

ShellErrors errors_of(const Shell& shell) {
  const IsotropicElasticity glass = from_young_poisson(70e9, 0.3),
                            sylgard = from_young_poisson(75e6, shell.poisson_ratio);
  const EnergySplit split = energy_split("volumetric_deviatoric");
  const double closure = shell.closed ? 1.0 : 0.0;
  const IsotropicElasticity broken = split.secant(sylgard, shell.g, closure);
  const ConcentricLayers exact({1.0, shell.lower(), shell.upper()}, {glass, sylgard, broken, sylgard}, 1e-3);
  const auto u = [&](const Vector& x) { return exact.displacement(x); };
  const auto strain = [&](const Vector& x) { return exact.strain(x); };
  const auto sound_stress = [&](const Vector& x) { return stress(sylgard, exact.strain(x)); };

  const Mesh mesh = mesh_of(shell.cells);
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : mesh.region_names) by_region.push_back(name == "bead" ? glass : sylgard);
  const CellField<double> g = stiffness_factors(mesh, shell);
  FractureModel model = elastic_model(by_region, displacement_on_all(mesh, u));
  model.split = split;
  const auto solution = solve_elastic(mesh, model, g, shell.closed ? 1e-8 : 1e-10, {}, closure);
  EXPECT_TRUE(solution->equilibrium.converged);
  const Index n_in_layer =
      shell.cells == Cells::polyhedra ? 10 * subdivision * subdivision + 2 : 20 * subdivision * subdivision;
  EXPECT_EQ(std::count(g.begin(), g.end(), shell.g), n_in_layer * shell.n_broken);

  const auto radius = [&](Index c) { return mesh.cell_centre[c].norm(); };
  const Index bead = mesh.region_index("bead");
  const CellMechanics& cells = solution->cells;
  const ShellErrors e{
      .core_traction = core_traction_error(mesh, *solution, exact.core_traction()),
      .displacement = displacement_error(mesh, *solution, u),
      .shell_strain = relative_stress_error(mesh, cells.strain, strain, [&](Index c) { return g[c] < 1.0; }),
      .stress_within = relative_stress_error(
          mesh, cells.stress, sound_stress,
          [&](Index c) { return g[c] == 1.0 && mesh.region[c] != bead && radius(c) < shell.lower(); }),
      .stress_beyond = relative_stress_error(mesh, cells.stress, sound_stress,
                                             [&](Index c) { return g[c] == 1.0 && radius(c) > shell.upper(); }),
      .iterations = solution->equilibrium.iterations};
  report_row(fmt::format("g {:g} in {} layers{}, {} cells", shell.g, shell.n_broken, shell.closed ? ", closed" : "",
                         mesh.n_cells()),
             {{"traction on the sphere", e.core_traction},
              {"u", e.displacement},
              {"strain in the shell", e.shell_strain},
              {"stress within it", e.stress_within},
              {"beyond it", e.stress_beyond},
              {"iterations", e.iterations},
              {"CPU s", solution->cpu_seconds}});
  return e;
}

class BrokenShell : public testing::TestWithParam<std::tuple<Index, double, bool, Cells>> {};

// A third more than the most that meshes which differ by rounding take (log_elasticity.md).
Index most_iterations(double g, bool closed, bool of_polyhedra) {
  if (of_polyhedra) return closed ? 210 : 117;
  if (closed) return 112;
  return g < 1e-3 ? 80 : 170;
}

// A twenty-faced sphere of 1280 triangles is 1 % smaller than round; the stress within the shell, a small one, suffers
// from the gradients along the layers next to the jump of g (log_elasticity.md). In a liquid shell of one layer of
// polyhedra the pressure varies from cell to cell by a few per cent.
TEST_P(BrokenShell, LoadsTheSphereAsInTheClosedForm) {
  const auto [n_broken, g, closed, cells] = GetParam();
  const ShellErrors e = errors_of({n_broken, g, closed, cells});
  const bool of_polyhedra = cells == Cells::polyhedra;
  if (closed)
    EXPECT_LE(e.core_traction, !of_polyhedra ? 5e-3 : (n_broken == 1 && g < 1e-3 ? 5e-2 : 2e-2));
  else
    EXPECT_LE(e.core_traction, 2.5e-2);
  EXPECT_LE(e.displacement, closed ? 1.5e-3 : 1e-2);
  EXPECT_LE(e.shell_strain, of_polyhedra ? 3.5e-2 : 2.5e-2);
  EXPECT_LE(e.stress_beyond, closed ? 2e-3 : (of_polyhedra ? 1.2e-2 : 1.5e-2));
  EXPECT_LE(e.stress_within, closed ? 0.06 : 0.25);
  EXPECT_LE(e.iterations, most_iterations(g, closed, of_polyhedra));
}

std::string name_of(const testing::TestParamInfo<BrokenShell::ParamType>& test) {
  const auto [n_broken, g, closed, cells] = test.param;
  return fmt::format("{}LayersTo1em{}{}{}", n_broken, std::lround(-std::log10(g)), closed ? "Closed" : "",
                     cells == Cells::polyhedra ? "Polyhedra" : "");
}

INSTANTIATE_TEST_SUITE_P(LayersAndStiffness, BrokenShell,
                         testing::Combine(testing::Values(1, 4), testing::Values(0.1, 1e-2, 1e-6),
                                          testing::Values(false),
                                          testing::Values(Cells::tetrahedra_and_prisms, Cells::polyhedra)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(LayersOfPolyhedra, BrokenShell,
                         testing::Combine(testing::Values(1, 4), testing::Values(0.1, 1e-2, 1e-6),
                                          testing::Values(true), testing::Values(Cells::polyhedra)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(LayersOfPrisms, BrokenShell,
                         testing::Combine(testing::Values(1, 4), testing::Values(0.1, 1e-2), testing::Values(true),
                                          testing::Values(Cells::tetrahedra_and_prisms)),
                         name_of);

// Prisms of 1e-6 slip past each other: the stress is right to 1 %, but strains within the shell are not held.
TEST(BrokenShellOfPrisms, SlipsWithinAndLoadsTheSphereAsInTheClosedForm) {
  for (const Index n_broken : {1, 4}) {
    const ShellErrors e = errors_of({n_broken, 1e-6, true, Cells::tetrahedra_and_prisms});
    EXPECT_LE(e.core_traction, 5e-3);
    EXPECT_LE(e.displacement, 1.5e-3);
    EXPECT_LE(e.shell_strain, 0.3);
    EXPECT_LE(e.stress_beyond, 2e-3);
    EXPECT_LE(e.iterations, 147);
  }
}

// With a pressure prisms do not slip.
TEST(BrokenShellNearlyIncompressible, ClosedLoadsTheSphereAsInTheClosedForm) {
  for (const double poisson_ratio : {0.49, 0.4995})
    for (const Cells cells : {Cells::tetrahedra_and_prisms, Cells::polyhedra})
      for (const double g : {1e-2, 1e-6}) {
        SCOPED_TRACE(fmt::format("nu = {}, g = {}", poisson_ratio, g));
        const ShellErrors e = errors_of({1, g, true, cells, poisson_ratio});
        EXPECT_LE(e.core_traction, 2.5e-3);
        EXPECT_LE(e.displacement, 5e-4);
        EXPECT_LE(e.shell_strain, cells == Cells::polyhedra ? 0.13 : 0.03);
        EXPECT_LE(e.stress_beyond, 2e-4);
        EXPECT_LE(e.stress_within, 2.8e-3);
        EXPECT_LE(e.iterations, g < 1e-3 ? 820 : 170);
      }
}

}  // namespace
}  // namespace pfdm::verification::this_file
