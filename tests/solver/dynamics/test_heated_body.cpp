// Transient heat against series solutions (computed apart from this program, 60 terms and more) and closed forms.

#include "mesh/dual.h"
#include "physics/error.h"
#include "solver/dynamics/heated_body.h"
#include "solver/dynamics/steady_heating.h"

#include <cmath>
#include <numbers>

#include "tests/physics/physics_checks.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

using Kind = DiffusionBoundary::Kind;

// A slab of 20 mm, insulated at x = 0, cooled at x = L by h = 25 W/m^2K; surroundings that are 1 K warmer from t = 0.
double slab_error(Index n, int n_steps) {
  const Mesh mesh = box(n, 1, 1, {0.02, 0.01, 0.01});
  HeatedBody body(mesh, {.conductivity = 0.3, .capacity = 2e6},
                  {{.patch = "xmax", .kind = Kind::exchange, .value = 1.0, .coefficient = 25.0}});
  for (int i = 0; i < n_steps; ++i) body.step(600.0 / n_steps);
  const double surface = body.surface("xmax").mean, middle = 0.5 * (body.rise()[n / 2 - 1] + body.rise()[n / 2]);
  EXPECT_NEAR(body.account().stored + body.account().lost, 0.0, 1e-10 * body.account().stored);
  return std::max(std::abs(surface - (1.0 - 0.491308869773)), std::abs(middle - (1.0 - 0.804970318151)));
}

TEST(HeatedBody, SlabWithConvection) {
  EXPECT_LT(slab_error(80, 1200), 3e-4);
  EXPECT_NEAR(slab_error(80, 20) / slab_error(80, 40), 2.0, 0.15);  // backward Euler
  const double coarse = slab_error(6, 4800), fine = slab_error(12, 4800);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

// A source that stays, convection into warmer surroundings and a flux: the same surface without the steps between.
// Also where faces are oblique: then the factors of the steps are those of the two-point fluxes alone.
TEST(HeatedBody, SteadySourceInAKrylovSpace) {
  constexpr int n = 200;
  for (const auto& [mesh, size] :
       {std::pair(box(10, 8, 4, {0.1, 0.08, 0.01}), 0.01), std::pair(tetrahedra_and_prisms(2, 2), 1.0)}) {
    const HeatedMaterial material{.conductivity = 0.3, .capacity = 2e6 * std::pow(0.01 / size, 2)};
    const std::vector<DiffusionBoundary> boundary{
        {.patch = "zmax", .kind = Kind::exchange, .value = 1.0, .coefficient = 0.12 / size},
        {.patch = "xmin", .kind = Kind::exchange, .value = 0.0, .coefficient = 1.5 / size},
        {.patch = "ymin", .kind = Kind::flux, .value = 0.2 / size}};
    CellField<double> source(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const Vector x = 0.01 / size * mesh.cell_centre[c];
      source[c] = 2.0 / (size * size) * (1.0 + std::sin(60.0 * x[0]) * std::cos(50.0 * x[1]));
    }
    HeatedBody body(mesh, material, boundary);
    body.set_source(source);
    const auto reduced = surface_under_steady_source(mesh, material, boundary, source, "zmax", 15.0, n);
    ASSERT_EQ(reduced.size(), as_size(n));
    for (int k = 0; k < n; ++k) {
      body.step(15.0);
      const SurfaceTemperature due = body.surface("zmax");
      EXPECT_NEAR(reduced[k].mean, due.mean, 1e-6 * due.largest);
      EXPECT_NEAR(reduced[k].largest, due.largest, 1e-6 * due.largest);
    }
  }
}

// Two half-spaces of unequal temperature touch: the interface takes the temperature of their effusivities.
TEST(HeatedBody, ContactOfTwoMaterials) {
  const Mesh mesh =
      box(400, 1, 1, {0.2, 0.01, 0.01}, 1.0, {{.name = "other", .lower = {0.1, -1.0, -1.0}, .upper = {1.0, 1.0, 1.0}}});
  CellField<double> k(mesh.n_cells()), c(mesh.n_cells()), T(mesh.n_cells());
  for (Index i = 0; i < mesh.n_cells(); ++i) {
    const bool left = mesh.cell_centre[i].x() < 0.1;
    k[i] = left ? 0.3 : 1.2;
    c[i] = left ? 2e6 : 1e6;
    T[i] = left ? 1.0 : 0.0;
  }
  Diffusion diffusion(mesh, {.conductivity = k, .capacity = c, .boundary = {}});
  for (int i = 0; i < 400; ++i) ASSERT_TRUE(diffusion.step(0.25, T).converged);
  const auto at = [&](double x) {  // between the two nearest cells
    double below = -1.0, above = 1.0, T_below = 0.0, T_above = 0.0;
    for (Index i = 0; i < mesh.n_cells(); ++i) {
      const double d = mesh.cell_centre[i].x() - x;
      if (d <= 0.0 && d > below) below = d, T_below = T[i];
      if (d > 0.0 && d < above) above = d, T_above = T[i];
    }
    return (T_below * above - T_above * below) / (above - below);
  };
  EXPECT_NEAR(at(0.095), 0.788349251, 2e-3);
  EXPECT_NEAR(at(0.105), 0.309370159, 2e-3);
}

// T = product of 1 - (x_i/3)^2 in a cube of half-width 3 whose surface is held at zero.
double manufactured_error(const Mesh& mesh) {
  const auto exact = [](const Vector& x) {
    double T = 1.0;
    for (const double xi : x) T *= 1.0 - xi * xi / 9.0;
    return T;
  };
  const auto source = [&](const Vector& x) {  // -div grad T
    double sum = 0.0;
    for (Index a = 0; a < 3; ++a) {
      double term = 2.0 / 9.0;
      for (Index b = 0; b < 3; ++b)
        if (b != a) term *= 1.0 - x[b] * x[b] / 9.0;
      sum += term;
    }
    return sum;
  };
  std::vector<DiffusionBoundary> boundary;
  for (const Patch& patch : mesh.patches) boundary.push_back({.patch = patch.name, .kind = Kind::value});
  Diffusion diffusion(
      mesh, {.conductivity = CellField<double>(mesh.n_cells(), 1.0),
             .boundary = boundary,
             .source = [&](Index c, double) { return DiffusionSource{.value = source(mesh.cell_centre[c])}; }});
  CellField<double> T(mesh.n_cells(), 0.0);
  EXPECT_TRUE(diffusion.solve_steady(T).converged);
  double error = 0.0, size = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    error += mesh.cell_volume[c] * std::pow(T[c] - exact(mesh.cell_centre[c]), 2);
    size += mesh.cell_volume[c] * std::pow(exact(mesh.cell_centre[c]), 2);
  }
  return std::sqrt(error / size);
}

TEST(HeatedBody, ManufacturedOnTetrahedraAndPolyhedra) {
  const auto mesh_of = [](Index subdivision, double grading) {
    ParticlesInBoxSettings settings;
    settings.lower = Vector::Constant(-3.0);
    settings.upper = Vector::Constant(3.0);
    settings.grading = grading;
    Particle sphere;
    sphere.radius = 1.0;
    sphere.subdivision = subdivision;
    sphere.n_layers = subdivision;
    sphere.layer_thickness = 0.4;
    settings.particles = {sphere};
    return make_particles_in_box(settings);
  };
  const Mesh coarse = mesh_of(4, 0.35), fine = mesh_of(7, 0.18);
  const auto order = [](const Mesh& a, double error_a, const Mesh& b, double error_b) {
    return std::log(error_a / error_b) / std::log(std::cbrt(static_cast<double>(b.n_cells()) / a.n_cells()));
  };
  const double tets = order(coarse, manufactured_error(coarse), fine, manufactured_error(fine));
  const Mesh coarse_dual = barycentric_dual(coarse), fine_dual = barycentric_dual(fine);
  const double polyhedra =
      order(coarse_dual, manufactured_error(coarse_dual), fine_dual, manufactured_error(fine_dual));
  RecordProperty("order on tetrahedra and prisms", std::to_string(tets));
  RecordProperty("order on polyhedra", std::to_string(polyhedra));
  EXPECT_GT(tets, 1.8);
  EXPECT_GT(polyhedra, 1.8);
}

// A plate with uniform heat: rise q t/(rho c_p) insulated; q h_p/(2 h) (1 - exp(-t/tau)) with convection on both faces,
// tau = rho c_p h_p/(2 h), while it is thermally thin.
// A ball of radius 1 that is heated evenly within an infinite body, k = rho c = 1: the rise is the integral over time
// of
//
//   F = 1/2 [erf((1 - r)/(2 sqrt t)) + erf((1 + r)/(2 sqrt t))] - sqrt(t/pi)/r [exp(-(1 - r)^2/4t) - exp(-(1 +
//   r)^2/4t)]
//
// (Carslaw, Jaeger, Conduction of Heat in Solids, 10.3).
double rise_of_ball(double r, double until) {
  const auto F = [r](double t) {
    if (t == 0.0) return r < 1.0 ? 1.0 : 0.0;
    const double below = (1.0 - r) / (2.0 * std::sqrt(t)), above = (1.0 + r) / (2.0 * std::sqrt(t));
    return 0.5 * (std::erf(below) + std::erf(above)) -
           std::sqrt(t / std::numbers::pi) / r * (std::exp(-below * below) - std::exp(-above * above));
  };
  constexpr int n = 400;
  double sum = 0.0;
  for (int i = 0; i <= n; ++i) sum += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * F(until * i / n);
  return sum * until / (3.0 * n);
}

// Rms over the ball and its surroundings up to r = 1.5, relative to the largest rise.
double ball_error(Index subdivision) {
  constexpr double until = 0.125;
  const Mesh mesh = tetrahedra_and_prisms(subdivision, subdivision);
  HeatedBody body(mesh, {.conductivity = 1.0, .capacity = 1.0}, {});
  CellField<double> source(mesh.n_cells(), 0.0);
  double heated = 0.0, sum = 0.0, volume = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].norm() < 1.0) {
      source[c] = 1.0;
      heated += mesh.cell_volume[c];
    }
  body.set_source(source);
  for (int i = 0; i < 100; ++i) body.step(until / 100.0);
  EXPECT_NEAR(body.account().heat, until * heated, 1e-10 * heated);
  EXPECT_NEAR(body.account().stored, body.account().heat, 1e-10 * heated);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (const double r = mesh.cell_centre[c].norm(); r < 1.5) {
      sum += mesh.cell_volume[c] * std::pow(body.rise()[c] - rise_of_ball(r, until), 2);
      volume += mesh.cell_volume[c];
    }
  return std::sqrt(sum / volume) / rise_of_ball(1e-3, until);
}

TEST(HeatedBody, BallHeatedWithinABody) {
  const double coarse = ball_error(2), fine = ball_error(4);
  RecordProperty("error", std::to_string(coarse) + ", " + std::to_string(fine));
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

TEST(HeatedBody, UniformHeatInAPlate) {
  const double thickness = 0.0127, q = 1250.0, capacity = 1.92e6, h = 10.0;
  const Mesh mesh = box(6, 5, 10, {0.1778, 0.254, thickness});
  HeatedBody insulated(mesh, {.conductivity = 50.0, .capacity = capacity}, {});
  HeatedBody cooled(mesh, {.conductivity = 50.0, .capacity = capacity},
                    {{.patch = "zmin", .kind = Kind::exchange, .coefficient = h},
                     {.patch = "zmax", .kind = Kind::exchange, .coefficient = h}});
  for (HeatedBody* body : {&insulated, &cooled}) {
    body->set_source(CellField<double>(mesh.n_cells(), q));
    for (int i = 0; i < 720; ++i) body->step(5.0);
    const HeatAccount& account = body->account();
    EXPECT_NEAR(account.heat, q * 3600.0 * 0.1778 * 0.254 * thickness, 1e-10 * account.heat);
    EXPECT_NEAR(account.heat, account.stored + account.lost, 1e-10 * account.heat);
  }
  const double tau = capacity * thickness / (2.0 * h);
  EXPECT_NEAR(insulated.surface("zmax").mean, q * 3600.0 / capacity, 1e-9);
  EXPECT_NEAR(cooled.surface("zmax").mean, q * thickness / (2.0 * h) * (1.0 - std::exp(-3600.0 / tau)), 2e-3);
  EXPECT_NEAR(cooled.surface("zmax").largest, cooled.surface("zmax").mean, 1e-9);
}

TEST(HeatedBody, Conductances) {
  EXPECT_NEAR(conductance_of_insulation(0.019, 0.035, 8.0), 1.0 / (0.019 / 0.035 + 0.125), 1e-12);
  EXPECT_NEAR(conductance_of_radiation(0.9, 293.15), 5.1425, 1e-3);  // W/m^2K
}

}  // namespace
}  // namespace pfdm::this_file
