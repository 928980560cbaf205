// Conduction with the second-order scheme, against series solutions (Carslaw, Jaeger, Conduction of Heat in Solids,
// 1959, 3.3, 9.8, 9.10); heat of interfaces against resistances in series; the account.

#include "mesh/generators/sphere_sector.h"
#include "physics/error.h"
#include "solver/heat/heat_equation.h"

#include <cmath>
#include <numbers>

#include "tests/physics/physics_checks.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

using Kind = DiffusionBoundary::Kind;
constexpr double pi = std::numbers::pi;
constexpr double k = 0.3, c = 2e6;  // [W/(m K)], [J/(m^3 K)]

HeatBody uniform(const Mesh& mesh, std::vector<DiffusionBoundary> boundary) {
  return {.conductivity = CellField<double>(mesh.n_cells(), k),
          .capacity = CellField<double>(mesh.n_cells(), c),
          .boundary = std::move(boundary)};
}

// Rises at the end of `time`, under a source [W/m^3].
CellField<double> warmed(HeatEquation& equation, const Mesh& mesh, double source, double time, int n) {
  CellField<double> heat(mesh.n_cells()), rise(mesh.n_cells(), 0.0);
  for (Index i = 0; i < mesh.n_cells(); ++i) heat[i] = source * mesh.cell_volume[i] * time / n;
  HeatBalance account;
  for (int i = 0; i < n; ++i) equation.step(time / n, heat, rise, account);
  EXPECT_NEAR(account.made, account.stored + account.lost, 1e-8 * std::abs(account.stored));
  return rise;
}

// Root of the mean square over the volume.
template <class Exact>
double error_of(const Mesh& mesh, const CellField<double>& rise, Exact exact) {
  double sum = 0.0, volume = 0.0;
  for (Index i = 0; i < mesh.n_cells(); ++i) {
    const double wrong = rise[i] - exact(mesh.cell_centre[i]);
    sum += mesh.cell_volume[i] * wrong * wrong, volume += mesh.cell_volume[i];
  }
  return std::sqrt(sum / volume);
}

// A slab that is insulated at x = 0, its other side at 1 K from t = 0 on.
double slab_error(Index n, int n_steps) {
  constexpr double L = 0.02, Fo = 0.4, time = Fo * L * L * c / k;
  const Mesh mesh = box(n, 1, 1, {L, 0.01, 0.01});
  HeatEquation equation(mesh, uniform(mesh, {{.patch = "xmax", .kind = Kind::value, .value = 1.0}}));
  const auto exact = [&](const Vector& x) {
    double sum = 1.0;
    for (int m = 0; m < 40; ++m) {
      const double a = (2 * m + 1) * pi / 2.0;
      sum -= 2.0 / a * (m % 2 == 0 ? 1.0 : -1.0) * std::exp(-a * a * Fo) * std::cos(a * x.x() / L);
    }
    return sum;
  };
  return error_of(mesh, warmed(equation, mesh, 0.0, time, n_steps), exact);
}

TEST(HeatEquation, SlabIsOfOrderTwoInTimeAndSpace) {
  const double steps = std::log2(slab_error(800, 8) / slab_error(800, 16)),
               cells = std::log2(slab_error(10, 400) / slab_error(20, 400)),
               both = std::log2(slab_error(16, 16) / slab_error(32, 32));
  RecordProperty("orders", testing::PrintToString(std::vector{steps, cells, both, slab_error(32, 32)}));
  EXPECT_NEAR(steps, 2.0, 0.2);
  EXPECT_NEAR(cells, 2.0, 0.2);
  EXPECT_NEAR(both, 2.0, 0.2);
  EXPECT_LT(slab_error(32, 32), 3e-4);
}

// A hollow sphere with a source from t = 0 on, both surfaces kept at zero: r T is a Fourier series in (r - a)/L.
// Hexahedra and, on the axis, wedges.
double sphere_error(Index n, int n_steps) {
  constexpr double a = 2e-4, b = 1e-3, L = b - a, q = 1e6, Fo = 0.1, time = Fo * L * L * c / k, scale = q * L * L / k;
  const Mesh mesh = make_sphere_sector({.azimuth = 0.02,
                                        .inner_radius = a,
                                        .shells = {{.radial = {L, n, 1.0}, .region = "shell"}},
                                        .polar = {{0.5 * pi, n, 1.0}}});
  HeatBody body = uniform(mesh, {{.patch = "inner", .kind = Kind::value, .value = 0.0},
                                 {.patch = "outer", .kind = Kind::value, .value = 0.0}});
  body.plane_normal = Vector::UnitY();
  HeatEquation equation(mesh, std::move(body));
  const auto exact = [&](const Vector& at) {
    const double r = at.norm();
    double sum = 0.0;
    for (int m = 1; m < 60; ++m) {
      const double w = m * pi;
      sum += 2.0 / (w * w * w) * (a - b * (m % 2 == 0 ? 1.0 : -1.0)) / r * std::sin(w * (r - a) / L) *
             (1.0 - std::exp(-w * w * Fo));
    }
    return sum;
  };
  CellField<double> rise = warmed(equation, mesh, q, time, n_steps);
  for (double& T : rise) T /= scale;
  return error_of(mesh, rise, exact);
}

TEST(HeatEquation, SphereIsOfOrderTwo) {
  const double both = std::log2(sphere_error(12, 8) / sphere_error(24, 16)),
               cells = std::log2(sphere_error(12, 64) / sphere_error(24, 64)), fine = sphere_error(24, 16);
  RecordProperty("orders", testing::PrintToString(std::vector{both, cells, fine}));
  EXPECT_NEAR(both, 2.0, 0.25);
  EXPECT_NEAR(cells, 2.0, 0.25);
  EXPECT_LT(fine, 1e-3);
}

// A uniform flux q from a spherical cavity into an infinite body: T = q a^2/(k r) (erfc(x) - exp((r - a)/a + Fo)
// erfc(x + Fo^1/2)), x = (r - a)/(2 (alpha t)^1/2), Fo = alpha t/a^2.
TEST(HeatEquation, FluxOnASphereInAnInfiniteBody) {
  constexpr double a = 1e-4, q = 1e3, Fo = 2.0, time = Fo * a * a * c / k;
  const Mesh mesh = make_sphere_sector({.azimuth = 0.02,
                                        .inner_radius = a,
                                        .shells = {{.radial = {12.0 * a, 90, 40.0}, .region = "body"}},
                                        .polar = {{0.5 * pi, 32, 1.0}}});
  HeatBody body = uniform(mesh, {{.patch = "inner", .kind = Kind::flux, .value = q}});
  body.plane_normal = Vector::UnitY();
  HeatEquation equation(mesh, std::move(body));
  const CellField<double> rise = warmed(equation, mesh, 0.0, time, 40);
  double worst = 0.0;
  for (Index i = 0; i < mesh.n_cells(); ++i) {
    const double r = mesh.cell_centre[i].norm(), x = (r - a) / (2.0 * a * std::sqrt(Fo));
    const double exact =
        q * a * a / (k * r) * (std::erfc(x) - std::exp((r - a) / a + Fo) * std::erfc(x + std::sqrt(Fo)));
    worst = std::max(worst, std::abs(rise[i] - exact) / (q * a / k));
  }
  RecordProperty("worst", testing::PrintToString(worst));
  EXPECT_LT(worst, 0.01);
}

// Two slabs whose outer sides are kept at zero, with heat and a conductance between them, at rest.
TEST(HeatEquation, InterfacesAreResistancesInSeries) {
  constexpr double L_1 = 0.01, L_2 = 0.03, k_1 = 0.3, k_2 = 2.0, area = 1e-4, power = 0.02;
  const Mesh mesh =
      box(8, 1, 1, {L_1 + L_2, 0.01, 0.01}, 1.0, {{.name = "far", .lower = {L_1, -1, -1}, .upper = {1, 1, 1}}});
  HeatBody body{.conductivity = CellField<double>(mesh.n_cells()),
                .capacity = CellField<double>(mesh.n_cells(), c),
                .boundary = {{.patch = "xmin", .kind = Kind::value, .value = 0.0},
                             {.patch = "xmax", .kind = Kind::value, .value = 0.0}}};
  for (Index i = 0; i < mesh.n_cells(); ++i) body.conductivity[i] = mesh.cell_centre[i].x() < L_1 ? k_1 : k_2;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f)
    if (std::abs(mesh.face_centre[f].x() - L_1) < 1e-9) body.interfaces.push_back(f);
  ASSERT_EQ(body.interfaces.size(), 1u);
  HeatEquation equation(mesh, body);
  constexpr double forever = 1e9;
  for (const double h : {0.0, 50.0, std::numeric_limits<double>::infinity()}) {
    equation.set_transmittance({equation.transmittance(0, h)});
    CellField<double> heat(mesh.n_cells(), 0.0), rise(mesh.n_cells(), 0.0);
    equation.add_interfaces({power * forever}, heat);
    HeatBalance account;
    equation.step(forever, heat, rise, account);
    const double g_1 = k_1 / L_1, g_2 = k_2 / L_2, half = 0.5 * power / area;
    // Of the sides: (g + h) T_1 - h T_2 = half, and likewise.
    const double det = g_1 * g_2 + h * (g_1 + g_2);
    const double T_1 = std::isinf(h) ? 2.0 * half / (g_1 + g_2) : half * (g_2 + 2.0 * h) / det,
                 T_2 = std::isinf(h) ? T_1 : half * (g_1 + 2.0 * h) / det;
    for (Index i = 0; i < mesh.n_cells(); ++i) {
      const double x = mesh.cell_centre[i].x();
      EXPECT_NEAR(rise[i], x < L_1 ? T_1 * x / L_1 : T_2 * (L_1 + L_2 - x) / L_2, 1e-5 * (T_1 + T_2)) << h << " " << x;
    }
  }
}

// What warms by less than any figure that is printed is not lost: it adds up.
TEST(HeatEquation, TinyHeatIsStored) {
  const Mesh mesh = box(4, 1, 1, {0.02, 0.01, 0.01});
  HeatEquation equation(mesh, uniform(mesh, {}));
  const CellField<double> rise = warmed(equation, mesh, 1e-12, 1.0, 10);
  for (const double value : rise) EXPECT_NEAR(value, 1e-12 / c, 1e-8 * 1e-12 / c);
}

// A sheet of skewed cells, one thick, of which nobody says that it is one: a field that is linear along it.
TEST(HeatEquation, OneLayerOfSkewedCellsIsLinear) {
  Mesh mesh = box(6, 6, 1, {0.01, 0.01, 0.002});
  CellSoup soup;
  soup.points = mesh.points;
  const auto bulge = [](Vector& x) {
    const double by = 0.0015 * std::sin(100.0 * pi * x.x()) * std::sin(100.0 * pi * x.y());
    x += Vector(by, by, 0.0);
  };
  soup.region_names = {"body"};
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) {
    const auto points = mesh.points_of_cell(cell);
    soup.add_cell(mesh.shape[cell], points, 0);
  }
  for (Vector& x : soup.points) bulge(x);
  const auto at = [](double y) {
    return PatchRule{
        .name = y == 0.0 ? "low" : "high",
        .holds = [y](const Vector& x, const Vector&, std::span<const Index>) { return std::abs(x.y() - y) < 1e-9; }};
  };
  const auto rest =
      PatchRule{.name = "rest", .holds = [](const Vector&, const Vector&, std::span<const Index>) { return true; }};
  mesh = assemble_mesh(std::move(soup), {at(0.0), at(0.01), rest});
  HeatEquation equation(mesh, uniform(mesh, {{.patch = "low", .kind = Kind::value, .value = 0.0},
                                             {.patch = "high", .kind = Kind::value, .value = 1.0}}));
  const CellField<double> rise = warmed(equation, mesh, 0.0, 1e5, 20);
  double worst = 0.0;
  for (Index cell = 0; cell < mesh.n_cells(); ++cell)
    worst = std::max(worst, std::abs(rise[cell] - 100.0 * mesh.cell_centre[cell].y()));
  EXPECT_LT(worst, 0.02);
}

TEST(HeatEquation, RowsUnderASteadySource) {
  const Mesh mesh = box(4, 1, 1, {0.02, 0.01, 0.01});
  HeatEquation equation(mesh, uniform(mesh, {}));
  CellField<double> power(mesh.n_cells(), 0.0), rise = power;
  power[3] = 0.5;
  const std::vector<HeatRow> rows = equation.under_steady_source(power, 100.0, 5, rise);
  ASSERT_EQ(rows.size(), 6u);
  for (const HeatRow& row : rows) {
    EXPECT_NEAR(row.account.made, 0.5 * row.time, 1e-12 * 50.0);
    EXPECT_NEAR(row.account.stored, row.account.made, 1e-8 * 50.0);
    EXPECT_NEAR(row.figures.mean, 0.5 * row.time / (c * 2e-6), 1e-8 * 12.5);
  }
  EXPECT_EQ(rows.back().time, 100.0);
  EXPECT_EQ(rows.back().figures.place, mesh.cell_centre[3]);
  EXPECT_EQ(rows.back().figures.greatest, rise[3]);
}

}  // namespace
}  // namespace pfdm::this_file
