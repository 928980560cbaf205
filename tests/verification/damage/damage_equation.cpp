// A smooth damage field made the solution by a source, on tetrahedra and on the prism layers of a sphere: second order,
// and never outside [0, 1] on the way.

#include "solver/fracture/damage/damage_equation.h"

#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double Gc = 1.0, ell = 0.3, psi = 0.5;

struct Manufactured {
  std::function<double(const Vector&)> d;
  std::function<double(const Vector&)> laplacian;
};

FractureModel model_of(const Mesh& mesh, const std::string& law) {
  FractureModel model;
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
    model.regions.push_back({.elasticity = {}, .Gc = Gc, .ell = ell});
  model.crack = &crack_geometry(law);
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  return model;
}

// What the equation lacks at the manufactured field, in the middle of each cell.
CellField<double> source_of(const Mesh& mesh, const FractureModel& model, const Manufactured& exact) {
  CellField<double> source(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double d = exact.d(mesh.cell_centre[c]);
    source[c] = Gc / (model.crack->c0 * ell) * model.crack->alpha_prime(d) +
                (1.0 - model.residual_stiffness) * model.degradation.g_prime(d) * psi -
                2.0 * Gc * ell / model.crack->c0 * exact.laplacian(mesh.cell_centre[c]);
  }
  return source;
}

struct Result {
  double error = 0.0;  // volume-weighted L2, over all cells or one region
  double least = 1.0, most = 0.0;
  double energy = 0.0;    // of the discrete surface energy [J]
  Index corrections = 0;  // until the damage moves by less than 1e-5
  Index cells = 0;
};

Result solve(const Mesh& mesh, const FractureModel& model, const Manufactured& exact, const std::string& region = {}) {
  DamageEquation equation(mesh, model, Vector::Zero());
  equation.set_source(source_of(mesh, model, exact));
  const std::size_t n = mesh.n_cells();
  const CellField<double> driving(n, psi), lower(n, 0.0);
  CellField<double> d(n, 0.0);
  Result result{.cells = mesh.n_cells()};
  for (double moved = 1.0; moved > 1e-5 && result.corrections < 100; ++result.corrections) {
    const CellField<double> before = d;
    EXPECT_TRUE(equation.solve(driving, lower, {}, d).converged);
    moved = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      moved = std::max(moved, std::abs(d[c] - before[c]));
      result.least = std::min(result.least, d[c]);
      result.most = std::max(result.most, d[c]);
    }
  }
  result.energy = equation.fracture_energy(d);
  const auto counts = [&](Index c) { return region.empty() || mesh.region[c] == mesh.region_index(region); };
  double volume = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!counts(c)) continue;
    result.error += mesh.cell_volume[c] * std::pow(d[c] - exact.d(mesh.cell_centre[c]), 2);
    volume += mesh.cell_volume[c];
  }
  result.error = std::sqrt(result.error / volume);
  return result;
}

Result solve(const Mesh& mesh, const std::string& law, const Manufactured& exact, const std::string& region = {}) {
  return solve(mesh, model_of(mesh, law), exact, region);
}

void expect_order(const std::string& label, const std::vector<Result>& results, double least_order,
                  double most_of_finest) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    const double order = i == 0 ? 0.0 : observed_order(results[i - 1].error, results[i - 1].cells, r.error, r.cells);
    report_row(label, {{"cells", r.cells},
                       {"error", r.error},
                       {"order", order},
                       {"corrections", r.corrections},
                       {"least d", r.least},
                       {"most d", r.most}});
    EXPECT_GE(r.least, 0.0);
    EXPECT_LE(r.most, 1.0);
    EXPECT_LE(r.corrections, 18);
  }
  const Result &coarse = results.front(), &fine = results.back();
  EXPECT_LE(fine.error, most_of_finest) << label;
  EXPECT_GE(observed_order(coarse.error, coarse.cells, fine.error, fine.cells), least_order) << label;
}

// ---- Tetrahedra in the unit cube: no flux through the sides.

const Manufactured waves{
    .d =
        [](const Vector& x) {
          return 0.5 + 0.4 * std::cos(std::numbers::pi * x[0]) * std::cos(std::numbers::pi * x[1]) *
                           std::cos(std::numbers::pi * x[2]);
        },
    .laplacian =
        [](const Vector& x) {
          return -3.0 * std::numbers::pi * std::numbers::pi * 0.4 * std::cos(std::numbers::pi * x[0]) *
                 std::cos(std::numbers::pi * x[1]) * std::cos(std::numbers::pi * x[2]);
        },
};

Mesh tetrahedra(double size) {
  ParticlesInBoxSettings settings;
  settings.upper = Vector::Ones();
  settings.boundary_size = size;
  settings.size_far = size;
  return make_particles_in_box(settings);
}

TEST(DamageEquationVerification, SecondOrderOnTetrahedra) {
  for (const std::string law : {"AT2", "AT1"}) {
    std::vector<Result> results;
    for (const double size : {0.2, 0.125, 0.08}) results.push_back(solve(tetrahedra(size), law, waves));
    expect_order(law + " on tetrahedra", results, 1.9, 7e-4);
  }
}

TEST(DamageEquationVerification, SecondOrderOnPolyhedra) {
  std::vector<Result> results;
  for (const double size : {0.2, 0.125, 0.08})
    results.push_back(solve(barycentric_dual(tetrahedra(size)), "AT2", waves));
  expect_order("AT2 on polyhedra", results, 1.8, 1.5e-3);
}

// The damage of cells beside planes of symmetry is that on the planes (solver/fracture/model/symmetry_planes.h).
TEST(DamageEquationVerification, SecondOrderBesidePlanesOfSymmetry) {
  const auto solved = [](const Mesh& mesh) {
    FractureModel model = model_of(mesh, "AT2");
    for (const char* side : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
      model.boundary.push_back(symmetry_on(side));
    return solve(mesh, model, waves);
  };
  std::vector<Result> hexahedral;
  for (const Index n : {8, 16, 24}) {
    BoxHexesSettings box;
    box.axes = {{{{1.0, n, 1.0}}, {{1.0, n, 1.0}}, {{1.0, n, 1.0}}}};
    hexahedral.push_back(solved(make_box_hexes(box)));
  }
  expect_order("hexahedra between planes of symmetry", hexahedral, 1.9, 2e-3);
}

// (Gc/2) (int d^2 / ell + ell |grad d|^2) of the waves.
TEST(DamageEquationVerification, SurfaceEnergyOnTetrahedra) {
  const double exact = 0.5 * Gc * (0.27 / ell + ell * 0.06 * std::numbers::pi * std::numbers::pi);
  for (const double size : {0.2, 0.1}) {
    const double error = solve(tetrahedra(size), "AT2", waves).energy / exact - 1.0;
    report_row("surface energy of AT2 on tetrahedra", {{"size", size}, {"relative error", error}});
    EXPECT_NEAR(error, 0.0, 1e-3);
    const double of_dual = solve(barycentric_dual(tetrahedra(size)), "AT2", waves).energy / exact - 1.0;
    report_row("on polyhedra", {{"size", size}, {"relative error", of_dual}});
    EXPECT_NEAR(of_dual, 0.0, 1e-2);
  }
}

// ---- A shell of damage around a sphere of radius 1, as debonding has it: prisms from 1 to 1.4, tetrahedra elsewhere.

constexpr double middle = 1.2, width = 0.5;

const Manufactured shell{
    .d = [](const Vector& x) { return 0.9 * std::exp(-std::pow((x.norm() - middle) / width, 2)); },
    .laplacian =
        [](const Vector& x) {
          const double r = x.norm(), s = (r - middle) / width;
          const double d = 0.9 * std::exp(-s * s);
          return d * ((4.0 * s * s - 2.0) / (width * width) - 4.0 * s / (width * r));
        },
};

TEST(DamageEquationVerification, SecondOrderOnPrismLayers) {
  std::vector<Result> everywhere, in_layers;
  for (const Index n : {4, 6, 8}) {
    const Mesh mesh = sphere_in_cube(n, 2 * n, 3.0, 0.2);
    everywhere.push_back(solve(mesh, "AT2", shell));
    in_layers.push_back(solve(mesh, "AT2", shell, "interface"));
  }
  expect_order("AT2 around a sphere", everywhere, 2.2, 2e-3);
  expect_order("AT2 in its prism layers", in_layers, 2.4, 7e-3);
}

}  // namespace
}  // namespace pfdm::verification::this_file
