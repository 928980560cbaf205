// Bodies with eigenstrains, as of thermal expansion, by closed forms: what expands freely has no stress; a bar between
// rigid walls; a sphere that does not fit its hole (Eshelby, Proc. R. Soc. A 241 (1957) 376: a mean strain e in the
// sphere, displacement A r inside, A a^3/r^2 outside, A = 3 K e/(3 K + 4 mu), K of the sphere and mu of the matrix).

#include "mesh/generators/cylinder_sector.h"
#include "mesh/generators/sphere_sector.h"
#include "physics/materials/hyperelastic.h"
#include "tests/verification/bar.h"
#include "tests/verification/layers/eigenstrain_bodies.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

// Also without a displacement on the surface: what expands freely has no stress.
double stress_of_free_body(Mesh mesh, const IsotropicElasticity& material, const std::string& split, bool damaged,
                           const Tensor& expansion, std::vector<BoundaryCondition> sides) {
  FractureModel model = elastic_model({}, std::move(sides));
  model.split = energy_split(split);
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
    model.regions.push_back(
        {.elasticity = material, .Gc = 1.0, .ell = 1.0, .damageable = damaged, .eigenstrain = given(expansion)});
  const CellField<double> damage = damaged ? some_damage(mesh) : CellField<double>(mesh.n_cells(), 0.0);
  const Answer answer = equilibrium(mesh, model, damage);
  return largest(answer.cells.stress) / (material.young_modulus() * expansion.norm());
}

TEST(Eigenstrains, LeaveAFreeBodyWithoutStress) {
  const Tensor alike = 1e-3 * Tensor::Identity(), three = Vector(1e-3, -4e-4, 2e-3).asDiagonal();
  const std::vector<BoundaryCondition> corner{symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")};
  const std::vector<BoundaryCondition> sector{axisymmetric_on("front"), axisymmetric_on("back"),
                                              symmetry_on("equator")};
  const auto shell = [] {
    return make_sphere_sector({.azimuth = 0.1,
                               .inner_radius = 0.5,
                               .shells = {{{0.5, 4, 1.0}, "body"}},
                               .polar = {{std::numbers::pi / 2.0, 8, 1.0}}});
  };
  const Mesh cube = sphere_in_cube(1, 2, 2.0, 0.6);
  for (const auto& split : {"none", "volumetric_deviatoric", "spectral"})
    for (const bool damaged : {false, true}) {
      const double found = stress_of_free_body(cube, epoxy, split, damaged, three, corner);
      report_row(fmt::format("{}{}", split, damaged ? ", damaged" : ""), {{"stress over E eps*", found}});
      EXPECT_LT(found, 1e-10);
    }
  const double in_rubber = stress_of_free_body(cube, rubber, "none", false, three, corner);
  const double in_sector = stress_of_free_body(shell(), epoxy, "none", true, alike, sector);
  const double of_rubber = stress_of_free_body(shell(), rubber, "none", false, alike, sector);
  report_row("rubber, sector, sector of rubber", {{"a", in_rubber}, {"b", in_sector}, {"c", of_rubber}});
  EXPECT_LT(in_rubber, 1e-9);  // over E: the pressure has 1/(1 - 2 nu) times its rounding
  EXPECT_LT(in_sector, 1e-10);
  EXPECT_LT(of_rubber, 1e-9);
}

// Heated between walls: -E alpha dT along it, the work of heating is what it stores.
TEST(Eigenstrains, BarBetweenWalls) {
  BoxHexesSettings box;
  box.axes = {{{{10.0, 10, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}};
  const Mesh mesh = make_box_hexes(box);
  FractureModel model =
      elastic_model({epoxy}, {symmetry_on("xmin"), symmetry_on("xmax"), symmetry_on("ymin"), symmetry_on("zmin")});
  constexpr double alpha = 6e-5, dT = 40.0;
  model.regions[0].expansion = alpha * Tensor::Identity();
  model.loads.temperature = [](const Vector&, double t) { return t * dT; };
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12},
                  {.initial_increment = 0.5, .maximum_increment = 0.5, .stops = {}});
  StepReport last;
  const FractureState state = run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
  const double E = epoxy.young_modulus(), stress = -E * alpha * dT;
  const double energy = 0.5 * stress * stress / E * 10.0;
  const OutputFields fields = run.output(state);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_NEAR(fields.stress[c](0, 0) / stress, 1.0, 1e-9);
    EXPECT_NEAR(fields.stress[c](1, 1) / stress, 0.0, 1e-9);
    EXPECT_NEAR(fields.strain[c](1, 1), (1.0 + epoxy.poisson_ratio()) * alpha * dT, 1e-12);
  }
  EXPECT_NEAR(last.reaction[1][0] / stress, 1.0, 1e-9);
  EXPECT_NEAR(last.energy.elastic / energy, 1.0, 1e-9);
  EXPECT_NEAR(last.energy.eigenstrain_work / energy, 1.0, 1e-9);
  EXPECT_NEAR(left_over({}, last.energy) / energy, 0.0, 1e-9);
}

TEST(Eigenstrains, SphereThatDoesNotFit) {
  constexpr double e = 1e-3;
  for (const bool soft : {false, true}) {
    const IsotropicElasticity matrix = soft ? rubber : epoxy;
    const double K = glass.bulk_modulus(), A = 3.0 * K * e / (3.0 * K + 4.0 * matrix.mu);
    const auto shrunk = [&](const Vector& x) -> Vector {
      const double r = x.norm();
      return r < 1.0 ? (A * x).eval() : (A / (r * r * r) * x).eval();
    };
    const auto exact = [&](const Vector& x) -> Tensor {
      const double r = x.norm();
      if (r < 1.0) return -4.0 * matrix.mu * A * Tensor::Identity();
      const Vector n = x / r;
      return 2.0 * matrix.mu * A / (r * r * r) * (Tensor::Identity() - 3.0 * n * n.transpose());
    };
    std::vector<double> errors;
    for (const Index n : {1, 2}) {
      const double ring = 0.1 / static_cast<double>(n);
      const Mesh mesh = make_sphere_sector({.azimuth = ring,
                                            .inner_radius = 0.2,
                                            .shells = {{{0.8, 6 * n, 1.0}, "glass"}, {{1.5, 12 * n, 3.0}, "matrix"}},
                                            .polar = {{std::numbers::pi / 2.0, 10 * n, 1.0}}});
      FractureModel model = elastic_model({glass, matrix}, {axisymmetric_on("front"), axisymmetric_on("back"),
                                                            symmetry_on("equator"), displacement_on("inner", shrunk)});
      if (soft)  // a pressure there would be anything
        model.boundary.push_back(
            traction_on("outer", [&](const Vector& x) -> Vector { return exact(x) * x / x.norm(); }));
      else
        model.boundary.push_back(displacement_on("outer", shrunk));
      model.regions[0].eigenstrain = given(e * Tensor::Identity());
      const Answer answer = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), 0.0));
      const auto inside = [&](Index c) { return mesh.region[c] == 0; };
      const auto outside = [&](Index c) { return mesh.region[c] == 1; };
      const double in = relative_stress_error(mesh, answer.cells.stress, exact, inside);
      const double out = relative_stress_error(mesh, answer.cells.stress, exact, outside);
      report_row(fmt::format("{} cells, nu = {:.4f}", mesh.n_cells(), matrix.poisson_ratio()),
                 {{"inside", in}, {"outside", out}});
      errors.push_back(out);
      EXPECT_LT(in, 0.03);
      EXPECT_LT(out, 0.05);
    }
    EXPECT_LT(errors[1], 0.6 * errors[0]);
  }
}

// A tube between rigid ends that expands along the radius alone: u = A r + B/r + C r ln r, C = e mu/(lambda + 2 mu), A
// and B by its free surfaces. What it shears across the sector is rounding.
TEST(Eigenstrains, TubeThatExpandsAlongTheRadius) {
  constexpr double a = 1.0, b = 3.0, e = 1e-3;
  const double M = epoxy.lambda + 2.0 * epoxy.mu, C = e * epoxy.mu / M;
  // s_rr = 2 (lambda + mu) A - 2 mu B/r^2 + stress(r)
  const auto stress = [&](double r) { return C * (M * (std::log(r) + 1.0) + epoxy.lambda * std::log(r)) - M * e; };
  const double B = (stress(b) - stress(a)) / (2.0 * epoxy.mu * (1.0 / (b * b) - 1.0 / (a * a)));
  const double A = (2.0 * epoxy.mu * B / (a * a) - stress(a)) / (2.0 * (epoxy.lambda + epoxy.mu));
  const auto exact = [&](double r) { return A * r + B / r + C * r * std::log(r); };
  std::vector<double> errors;
  for (const Index n : {10, 20}) {
    const Mesh mesh = make_cylinder_sector({.azimuth = 1.0 / static_cast<double>(n),
                                            .inner_radius = a,
                                            .radius = {{b - a, n, 1.0}},
                                            .height = {{0.2, 2, 1.0}}});
    FractureModel model = elastic_model(
        {epoxy}, {axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("bottom"), symmetry_on("top")});
    model.regions[0].eigenstrain = std::make_shared<const LoadField<Tensor>>([](const Vector& x, double t) -> Tensor {
      const Vector outwards = Vector(x.x(), x.y(), 0.0).normalized();
      return t * e * outwards * outwards.transpose();
    });
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10},
                    {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
    const OutputFields fields = run.output(run_to_end(run, [](const FractureState&, const StepReport&) {}));
    errors.push_back(relative_error(
        mesh, [&](Index c) { return fields.displacement[c]; },
        [&](Index c) { return Vector(exact(mesh.cell_centre[c].x()), 0.0, 0.0); }, [](Index) { return true; }));
    report_row(fmt::format("{} cells", n), {{"u", errors.back()}});
  }
  EXPECT_LT(errors[1], 0.005);
  EXPECT_LT(errors[1], 0.4 * errors[0]);
}

// A bar that shrinks between walls breaks as one that is pulled by as much.
TEST(Eigenstrains, ShrinkingBarBreaksAsAPulledOne) {
  for (const char* split : {"none", "spectral"}) {
    const Bar bar({.length = 4.3, .poisson_ratio = 0.2, .split = split});
    const auto run = [&](const FractureModel& model) { return reports_of_break(bar, model); };
    FractureModel shrinking = bar.model();
    shrinking.boundary[1] = symmetry_on("xmax");
    const Tensor strain = -bar.strength() / Bar::E * Vector::UnitX() * Vector::UnitX().transpose();
    const auto eigenstrain = given(strain);
    for (RegionModel& region : shrinking.regions) region.eigenstrain = eigenstrain;
    const std::vector<StepReport> pulled = run(bar.model()), shrunk = run(shrinking);
    ASSERT_EQ(pulled.size(), shrunk.size());
    const auto wall = bar.mesh().patch_index("xmax");
    const double strength = bar.strength() * bar.area(), Gc = Bar::Gc * bar.area();
    double force = 0.0, fracture = 0.0, account = 0.0;
    for (std::size_t k = 1; k < pulled.size(); ++k) {
      force = std::max(force, std::abs(pulled[k].reaction[wall][0] - shrunk[k].reaction[wall][0]) / strength);
      fracture = std::max(fracture, std::abs(pulled[k].energy.fracture - shrunk[k].energy.fracture) / Gc);
      account = std::max(account, std::abs(pulled[k].energy.external_work - shrunk[k].energy.eigenstrain_work) / Gc);
    }
    report_row(split, {{"force", force}, {"fracture energy", fracture}, {"work", account}});
    EXPECT_GT(pulled.back().max_damage, 0.9);
    EXPECT_LT(force, 1e-4);
    EXPECT_LT(fracture, 1e-4);
    EXPECT_LT(account, 1e-4);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
