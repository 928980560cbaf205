// Elasticity that depends on the direction. Linear displacements on every kind of cell; a turned block in tension,
// 1/E(theta) = c^4/E1 + (1/G12 - 2 nu12/E1) c^2 s^2 + s^4/E2 (Lekhnitskii, Theory of Elasticity of an Anisotropic Body,
// 1963, art. 5) in plane stress; a laminate against its layers in parallel; a ring of cylindrical orthotropy under an
// inner pressure (art. 64: sigma_r of powers r^(k-1) and r^(-k-1), k^2 = E_theta/E_r in plane stress); a bar that
// breaks as an isotropic one of the same modulus; isotropic constants against the isotropic program.

#include "physics/damage/energy_split.h"
#include "physics/elasticity/anisotropy.h"
#include "physics/error.h"
#include "tests/verification/bar.h"
#include "tests/verification/support.h"

#include "mesh/geometry.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double GPa = 1e9;
const OrthotropicConstants carbon{140 * GPa, 10 * GPa, 9 * GPa, 0.3, 0.28, 0.45, 5 * GPa, 4.5 * GPa, 3.4 * GPa};

std::shared_ptr<const MandelMatrix> shared(const MandelMatrix& C) { return std::make_shared<const MandelMatrix>(C); }

Tensor about_z(double angle) {
  return axes_along({std::cos(angle), std::sin(angle), 0.0}, {-std::sin(angle), std::cos(angle), 0.0});
}

FractureModel model_of(const std::vector<MandelMatrix>& by_region, std::vector<BoundaryCondition> boundary) {
  FractureModel model = elastic_model(
      std::vector<IsotropicElasticity>(by_region.size(), from_young_poisson(20 * GPa, 0.3)), std::move(boundary));
  for (std::size_t r = 0; r < by_region.size(); ++r) model.regions[r].stiffness = shared(by_region[r]);
  return model;
}

struct Solved {
  StepReport report;
  OutputFields fields;
};

Solved solve(const Mesh& mesh, const FractureModel& model, double tolerance = 1e-11) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  Solved solved;
  const FractureState state =
      run_to_end(run, [&](const FractureState&, const StepReport& report) { solved.report = report; });
  solved.fields = run.output(state);
  return solved;
}

std::vector<BoundaryCondition> displaced(const Mesh& mesh, const Tensor& slope) {
  std::vector<BoundaryCondition> all;
  for (const Patch& patch : mesh.patches)
    all.push_back(displacement_on(patch.name, [slope](const Vector& x) -> Vector { return slope * x; }));
  return all;
}

TEST(Orthotropy, LinearDisplacementsAreExact) {
  const Tensor slope = (Tensor() << 1.0, 0.3, -0.2, 0.1, -0.7, 0.4, 0.25, -0.15, 0.6).finished() * 1e-3;
  const MandelMatrix C = turned(orthotropic_stiffness(carbon), arbitrary_rotation());
  const Tensor exact = to_tensor(C * to_mandel(symmetric_part(slope)));
  BoxHexesSettings box;
  box.axes = {{{{1.0, 5, 3.0}}, {{1.0, 4, 1.0}}, {{1.0, 4, 0.5}}}};
  const Mesh tetrahedra = sphere_in_cube(1, 2, 2.0, 0.6);
  for (const Mesh& mesh : {make_box_hexes(box), tetrahedra, barycentric_dual(tetrahedra)}) {
    const FractureModel model =
        model_of(std::vector<MandelMatrix>(mesh.region_names.size(), C), displaced(mesh, slope));
    const Solved solved = solve(mesh, model, 1e-12);
    double error = 0.0;
    for (const Tensor& stress : solved.fields.stress) error = std::max(error, (stress - exact).norm() / exact.norm());
    double volume = 0.0;
    for (const double v : mesh.cell_volume) volume += v;
    const double energy = solved.report.energy.elastic / (0.5 * volume * contract(exact, slope)) - 1.0;
    report_row(fmt::format("{} cells", mesh.n_cells()), {{"stress", error}, {"energy", energy}});
    EXPECT_LT(error, 1e-9);
    EXPECT_LT(std::abs(energy), 1e-9);
  }
}

TEST(Orthotropy, TurnedBlockInTension) {
  BoxHexesSettings box;
  box.axes = {{{{2.0, 6, 1.0}}, {{1.0, 3, 1.0}}, {{0.5, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(box);
  for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    const MandelMatrix C = turned(orthotropic_stiffness(carbon), about_z(angle));
    FractureModel model = model_of({C}, {plane_stress_on("zmin"), plane_stress_on("zmax")});
    // The exact state, sigma_xx = 1 MPa alone: its displacement on the left, its traction on the others.
    const Mandel strain = C.inverse() * (1e6 * Mandel::Unit(0));
    const Tensor slope = to_tensor(strain);
    model.boundary.push_back(displacement_on("xmin", [slope](const Vector& x) -> Vector {
      const Vector u = slope * x;
      return {u[0], u[1], 0.0};
    }));
    model.boundary.push_back(traction_on("xmax", [](const Vector&) -> Vector { return 1e6 * Vector::UnitX(); }));
    const Solved solved = solve(mesh, model);
    const double modulus = 1.0 / (c * c * c * c / carbon.E1 + s * s * s * s / carbon.E2 +
                                  (1.0 / carbon.G12 - 2.0 * carbon.nu12 / carbon.E1) * c * c * s * s);
    double error = 0.0;
    for (Index k = 0; k < mesh.n_cells(); ++k)
      error = std::max(error, std::abs(solved.fields.strain[k](0, 0) * modulus / 1e6 - 1.0));
    report_row(fmt::format("{} degrees", degrees), {{"E/E1", modulus / carbon.E1}, {"strain", error}});
    EXPECT_LT(error, 1e-9) << degrees;
  }
}

// Layers along x and across it, in turns over z: in parallel within the plane, free of stress across it.
TEST(Orthotropy, CrossPlyLaminate) {
  BoxHexesSettings box;
  box.axes = {{{{1.0, 3, 1.0}}, {{1.0, 3, 1.0}}, {{1.0, 8, 1.0}}}};
  box.base_region = "along";
  box.regions = {{.name = "across", .lower = {-1.0, -1.0, 0.25}, .upper = {2.0, 2.0, 0.5}},
                 {.name = "across", .lower = {-1.0, -1.0, 0.75}, .upper = {2.0, 2.0, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  const MandelMatrix along = orthotropic_stiffness(carbon), across = turned(along, about_z(std::numbers::pi / 2.0));
  constexpr double strain = 1e-3;
  FractureModel model =
      model_of({along, across}, {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("ymax"), symmetry_on("zmin")});
  for (std::size_t r = 0; r < 2; ++r)
    model.regions[r].stiffness = shared(mesh.region_names[r] == "along" ? along : across);
  model.boundary.push_back(moved("xmax", {true, false, false},
                                 [](const Vector&, double t) -> Vector { return t * strain * Vector::UnitX(); }));
  const Solved solved = solve(mesh, model);
  const auto of_layer = [&](const MandelMatrix& C) { return (C(0, 0) - C(0, 2) * C(2, 0) / C(2, 2)) * strain; };
  const double exact = 0.5 * (of_layer(along) + of_layer(across));
  const auto pulled = mesh.patch_index("xmax");
  const double error = solved.report.reaction[pulled].x() / exact - 1.0;
  report_row("laminate", {{"force", error}});
  EXPECT_LT(std::abs(error), 1e-9);
}

// A quarter of a ring from a bent box; axes along the radius and the hoop in each cell.
Mesh quarter_ring(Index n, double inner, double outer) {
  BoxHexesSettings box;
  box.origin = Vector(inner, 0.0, 0.0);
  box.axes = {{{{outer - inner, n, 1.0}}, {{1.0, 2 * n, 1.0}}, {{0.1, 1, 1.0}}}};
  box.sides = {"inner", "outer", "ymin", "xmin", "zmin", "zmax"};
  Mesh mesh = make_box_hexes(box);
  for (Vector& x : mesh.points) {
    const double angle = 0.5 * std::numbers::pi * x[1], r = x[0];
    x = Vector(r * std::cos(angle), r * std::sin(angle), x[2]);
  }
  compute_geometry(mesh);
  return mesh;
}

TEST(Orthotropy, RingUnderPressure) {
  constexpr double a = 1.0, b = 2.0, p = 1e6;
  const OrthotropicConstants wound{10 * GPa, 90 * GPa, 10 * GPa, 0.03, 0.3, 0.27, 5 * GPa, 4 * GPa, 5 * GPa};
  const double k = std::sqrt(wound.E2 / wound.E1), ratio = a / b;
  const double A = p * std::pow(ratio, k + 1.0) / (1.0 - std::pow(ratio, 2.0 * k));
  const auto radial = [&](double r) { return A * (std::pow(r / b, k - 1.0) - std::pow(b / r, k + 1.0)); };
  const auto hoop = [&](double r) { return A * k * (std::pow(r / b, k - 1.0) + std::pow(b / r, k + 1.0)); };
  std::vector<double> errors;
  for (const Index n : {8, 16, 32}) {
    const Mesh mesh = quarter_ring(n, a, b);
    FractureModel model = model_of({orthotropic_stiffness(wound)}, {plane_stress_on("zmin"), plane_stress_on("zmax"),
                                                                    symmetry_on("xmin"), symmetry_on("ymin")});
    BoundaryCondition pressed;
    pressed.patch = "inner";
    pressed.pressure = [](const Vector&, double t) { return t * p; };
    model.boundary.push_back(pressed);
    model.cells = CellField<RegionModel>(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const Vector& x = mesh.cell_centre[c];
      model.cells[c] = model.regions[0];
      model.cells[c].stiffness = shared(turned(orthotropic_stiffness(wound), about_z(std::atan2(x[1], x[0]))));
    }
    const Solved solved = solve(mesh, model, 1e-9);
    errors.push_back(relative_stress_error(
        mesh, solved.fields.stress,
        [&](const Vector& x) -> Tensor {
          const double r = std::hypot(x[0], x[1]);
          const Vector e(x[0] / r, x[1] / r, 0.0), f(-e[1], e[0], 0.0);
          return radial(r) * e * e.transpose() + hoop(r) * f * f.transpose();
        },
        [](Index) { return true; }));
    report_row(fmt::format("{} cells", mesh.n_cells()), {{"stress", errors.back()}});
  }
  EXPECT_LT(errors[2], 0.01);
  EXPECT_LT(errors[2], 0.6 * errors[1]);
}

// Damaged to 0.9, stretched and pressed along each axis and sheared: stress and energy of the law.
TEST(Orthotropy, ADamagedBlockFollowsItsSplit) {
  const MandelMatrix C = turned(orthotropic_stiffness(carbon), arbitrary_rotation());
  const AnisotropicElasticity elasticity = anisotropic_elasticity(C);
  BoxHexesSettings box;
  box.axes = {{{{1.0, 3, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}};
  const Mesh mesh = make_box_hexes(box);
  constexpr double d = 0.9, k = 1e-6, g = (1.0 - k) * (1.0 - d) * (1.0 - d) + k;
  for (const char* name : {"volumetric_deviatoric", "orthogonal"}) {
    double of_stress = 0.0, of_energy = 0.0;
    for (Index component = 0; component < 4; ++component)
      for (const double size : {1e-3, -1e-3}) {
        const Tensor strain = size * to_tensor(Mandel::Unit(component));
        FractureModel model = model_of({C}, displaced(mesh, strain));
        model.split = energy_split(name);
        model.residual_stiffness = k;
        model.regions[0].damageable = true;
        model.regions[0].Gc = 1e9, model.regions[0].ell = 1.0;  // nothing breaks any further
        model.initial_damage = CellField<double>(mesh.n_cells(), d);
        const Solved solved = solve(mesh, model);
        const Tensor exact = to_tensor(degraded_tangent(model.split, elasticity, g, strain) * to_mandel(strain));
        for (const Tensor& stress : solved.fields.stress)
          of_stress = std::max(of_stress, (stress - exact).norm() / exact.norm());
        const auto [plus, minus] = energy(model.split, elasticity, strain);
        of_energy = std::max(of_energy, std::abs(solved.report.energy.elastic / (g * plus + minus) - 1.0));
      }
    report_row(name, {{"stress", of_stress}, {"energy", of_energy}});
    EXPECT_LT(of_stress, 1e-8);
    EXPECT_LT(of_energy, 1e-8);
  }
}

// With the isotropic constants as a matrix everything is as without, damage too; one of nu = 0 along the bar breaks as
// an isotropic one, whatever its stiffness across.
TEST(Orthotropy, BarsBreakAsIsotropicOnes) {
  for (const char* split : {"none", "volumetric_deviatoric", "orthogonal"}) {
    const Bar bar({.length = 4.3, .poisson_ratio = 0.2, .split = split});
    const auto run = [&](const FractureModel& model) { return reports_of_break(bar, model); };
    FractureModel same = bar.model();
    for (RegionModel& region : same.regions) region.stiffness = shared(stiffness_matrix(region.elasticity));
    const Bar plain({.length = 4.3, .split = split});
    FractureModel other = plain.model();
    for (RegionModel& region : other.regions)
      region.stiffness = shared(orthotropic_stiffness(
          {Bar::E, 0.1 * Bar::E, 0.2 * Bar::E, 0.0, 0.0, 0.0, 0.05 * Bar::E, 0.05 * Bar::E, 0.05 * Bar::E}));
    for (const auto& [name, plainly, by_matrix] :
         {std::tuple{"isotropic", bar.model(), same}, std::tuple{"orthotropic", plain.model(), other}}) {
      const std::vector<StepReport> a = run(plainly), b = run(by_matrix);
      ASSERT_EQ(a.size(), b.size());
      double force = 0.0, fracture = 0.0, account = 0.0;
      for (std::size_t k = 1; k < a.size(); ++k) {
        force = std::max(force, std::abs(a[k].reaction[1][0] - b[k].reaction[1][0]) / (bar.strength() * bar.area()));
        fracture = std::max(fracture, std::abs(a[k].energy.fracture - b[k].energy.fracture) / (Bar::Gc * bar.area()));
        account = std::max(account, std::abs(left_over({}, b[k].energy)) / (Bar::Gc * bar.area()));
      }
      report_row(fmt::format("{}, {}", name, split),
                 {{"force", force}, {"fracture energy", fracture}, {"account", account}});
      EXPECT_GT(b.back().max_damage, 0.9);
      EXPECT_LT(force, 1e-4);
      EXPECT_LT(fracture, 1e-4);
    }
  }
}

TEST(Orthotropy, ConstantsWithoutAPositiveEnergyAreRefused) {
  OrthotropicConstants wrong = carbon;
  wrong.nu23 = 1.1;
  EXPECT_THROW(orthotropic_stiffness(wrong), InputError);
  EXPECT_THROW(cubic_stiffness(100 * GPa, 110 * GPa, 50 * GPa), InputError);
  EXPECT_NO_THROW(cubic_stiffness(168 * GPa, 121 * GPa, 75 * GPa));
}

}  // namespace
}  // namespace pfdm::verification::this_file
