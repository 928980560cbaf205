// Bodies that relax: the gaps at the faces of their cells relax as strains do, so that a body that has relaxed is the
// elastic one of the relaxed moduli. Nearly incompressible bodies with a history: cells have a pressure by their own
// law.

#include "mesh/generators/cylinder_sector.h"
#include "physics/materials/j2_plasticity.h"
#include "physics/materials/prony.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/histories/held_discs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

using namespace discs;

constexpr double nu = 0.4997;  // of the rubber
constexpr IsotropicElasticity rubber{.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu};

constexpr IsotropicElasticity foam{.lambda = 4.0 * mu, .mu = mu};  // relaxed, nu = 0.4

RegionModel prony_region(double shear, double bulk) {
  PronyLaw law{.relaxed = foam, .shear = {{shear * mu, 1.0}}};
  if (bulk > 0.0) law.bulk.push_back({bulk * foam.bulk_modulus(), 1.0});
  return relaxing_region(law);
}

Mesh wall(double inner, double outer, Index n) {
  return make_cylinder_sector({.azimuth = 0.05,
                               .inner_radius = inner,
                               .radius = {{.length = outer - inner, .n = n}},
                               .height = {{.length = 0.2, .n = 1}}});
}

// Shear alone, and with the bulk modulus.
TEST(RelaxingBodies, AreElasticWhereTheyHaveRelaxedAndWhereTheyHaveNot) {
  const Mesh mesh = disc(20, 4);
  for (const double bulk : {0.0, 0.5}) {
    const RegionModel region = prony_region(20.0, bulk);
    const double slow = pull_at_once(mesh, region, 1e13).modulus, fast = pull_at_once(mesh, region, 1e-13).modulus;
    const double soft = pull_at_once(mesh, elastic_region(foam), 1.0).modulus;
    const double stiff = pull_at_once(mesh, elastic_region(region.elasticity), 1.0).modulus;
    report_row(fmt::format("disc, bulk branch of {}", bulk),
               {{"slow", slow}, {"relaxed", soft}, {"fast", fast}, {"instantaneous", stiff}});
    EXPECT_NEAR(slow, soft, 1e-9 * soft);
    EXPECT_NEAR(fast, stiff, 1e-9 * stiff);
  }
}

// Errors of the inner face's displacement, relative; and what its energy account leaves over, of the work.
struct Creep {
  double first = 0.0, last = 0.0, worst = 0.0, account = 0.0;
};

double compliance(double M_inf, double M_1, double time) {
  return 1.0 / M_inf - (1.0 / M_inf - 1.0 / (M_inf + M_1)) * std::exp(-time * M_inf / (M_inf + M_1));
}

// Plane strain, pressure inside: u(r) = p a^2/(b^2 - a^2) (r/(2 (K + mu/3)) + b^2/(2 mu r)), each modulus by its
// compliance under a load that is held.
// The shear modulus is `ratio` times as large at once; n cells are across the wall.
Creep creep_of(double poisson, double ratio, Index n) {
  constexpr double a = 1.0, b = 2.0, p = 1e4, ramp = 1e-8;
  const double sizes = 0.5 * (1.0 + std::cos(0.025));  // the sector's faces are chords
  const IsotropicElasticity slow = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson);
  RegionModel region;
  region.material = make_prony({.relaxed = slow, .shear = {{(ratio - 1.0) * mu, 1.0}}});
  const Mesh mesh = wall(a, b, n);
  BoundaryCondition pressed{.patch = "inner", .value = {}};
  pressed.pressure = [](const Vector&, double t) { return p * std::min(t / ramp, 1.0); };
  FractureModel model = elastic_model(
      {region.material->elasticity()},
      {pressed, symmetry_on("bottom"), symmetry_on("top"), axisymmetric_on("front"), axisymmetric_on("back")});
  model.regions[0].material = region.material;
  FractureRun run(mesh, model, to_rounding,
                  {.initial_increment = ramp,
                   .minimum_increment = 1e-12,
                   .maximum_increment = 0.002,
                   .duration = 5.0 * ratio,
                   .stops = {},
                   .is_proportional = false});
  const auto inner = mesh.patch_index("inner");
  Creep creep;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step == 0) return;
    const double time = 5.0 * ratio * report.load, branch = (ratio - 1.0) * mu;
    const double due = p * a * a / (b * b - a * a) *
                       (a * compliance(slow.bulk_modulus() + slow.mu / 3.0, branch / 3.0, time) / 2.0 +
                        b * b / a * compliance(mu, branch, time) / 2.0);
    creep.last = report.patch_displacement[inner].x() / sizes / due - 1.0;
    if (report.step == 1) creep.first = creep.last;
    creep.worst = std::max(creep.worst, std::abs(creep.last));
    creep.account = std::max(creep.account, std::abs(left_over({}, report.energy)) / report.energy.external_work);
  });
  report_row(fmt::format("cylinder, nu {}, ratio {}, {} cells", poisson, ratio, n),
             {{"at once", creep.first}, {"worst", creep.worst}, {"relaxed", creep.last}, {"account", creep.account}});
  return creep;
}

TEST(RelaxingBodies, AThickCylinderCreepsAsTheClosedFormSays) {
  for (const double ratio : {21.0, 101.0}) {
    const Creep coarse = creep_of(0.4, ratio, 8), fine = creep_of(0.4, ratio, 16);
    EXPECT_LE(coarse.worst, 0.008);
    EXPECT_LE(fine.worst, 0.0022);
    EXPECT_LE(coarse.account, 0.008);
    EXPECT_LE(fine.account, 0.0025);
  }
}

// Perfectly plastic to r = c, incompressible: p = 2 k log(c/a) + k (1 - c^2/b^2), u = k c^2/(2 mu r), k = Y/sqrt(3)
// (Hill, The Mathematical Theory of Plasticity, 1950, ch. V.1).
TEST(RelaxingBodies, AThickCylinderYieldsAtNu04999) {
  constexpr double a = 1.0, b = 2.0, c = 1.5, Y = 1e4, poisson = 0.4999;
  const double k = Y / std::numbers::sqrt3;
  const double due = 2.0 * k * std::log(c / a) + k * (1.0 - c * c / (b * b));
  const IsotropicElasticity elasticity = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson);
  double coarse = 0.0;
  for (const Index n : {8, 16}) {
    const Mesh mesh = wall(a, b, n);
    FractureModel model = elastic_model(
        {elasticity}, {moved("inner", {true, true, true},
                             [&](const Vector& x, double t) -> Vector {
                               return t * k * c * c / (2.0 * mu * a) * Vector(x.x(), x.y(), 0.0).normalized();
                             }),
                       symmetry_on("bottom"), symmetry_on("top"), axisymmetric_on("front"), axisymmetric_on("back")});
    model.regions[0].material = make_j2_plasticity(elasticity, {.yield_stress = Y});
    FractureRun run(mesh, model, to_rounding, {.initial_increment = 0.05, .maximum_increment = 0.05, .stops = {}});
    FractureState state = run.initial_state();
    StepReport last;
    while (!run.is_complete(state)) last = run.step(state);
    const OutputFields fields = run.output(state);
    const Patch& inner = mesh.patch("inner");
    double force = 0.0, area_of_inner = 0.0;
    for (Index f = inner.first_face; f < inner.first_face + inner.n_faces; ++f) {
      force += fields.traction[f].dot(mesh.face_area[f]);
      area_of_inner += mesh.face_area[f].norm();
    }
    const double error = std::abs(-force / area_of_inner / due - 1.0);
    report_row(fmt::format("plastic cylinder, {} cells", n), {{"pressure", error}});
    EXPECT_LE(error, n == 8 ? 0.02 : 0.006);
    if (n == 8) coarse = error;
    if (n == 16) {
      EXPECT_LE(error, 0.5 * coarse);
    }
  }
}

// A disc with a ring of a material that never yields: as elastic as one of two regions without a history.
TEST(RelaxingBodies, ElasticCellsBesideAHistoryKeepTheirPressure) {
  const Mesh mesh = make_cylinder_sector({.azimuth = azimuth,
                                          .radius = {{radius, 20, 1.0}},
                                          .height = {{height, 4, 1.0}},
                                          .regions = {{"ring", 0.5 * radius, radius, 0.0, height}}});
  const auto pull = [&](const std::shared_ptr<const Material>& material) {
    FractureModel model = disc_model(elastic_region(rubber), [](double t) { return t; });
    model.regions.push_back(model.regions[0]);
    model.regions[1].material = material;
    model.regions[1].expansion = 1e-30 * Tensor::Identity();  // a zone of its own without a material, too
    FractureRun run(mesh, model, to_rounding, {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
    double modulus = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) { modulus = pulled(mesh, report).modulus; });
    return modulus;
  };
  const double elastic = pull(nullptr), beside = pull(make_j2_plasticity(rubber, {.yield_stress = 1e12}));
  report_row("disc with a ring", {{"elastic", elastic}, {"beside a history", beside}});
  EXPECT_NEAR(beside, elastic, 1e-9 * elastic);
}

// Poisson's ratio that varies across the one from which cells have a pressure: each cell decides.
TEST(RelaxingBodies, CellsHaveAPressureByTheirOwnPoissonRatio) {
  const Mesh mesh = disc(20, 4);
  FractureModel model = disc_model(elastic_region(rubber), [](double t) { return t; });
  const auto at = [&](double poisson) { return from_young_poisson(2.0 * mu * (1.0 + poisson), poisson); };
  const auto with = [&](const std::function<double(const Vector&)>& poisson) {
    model.cells = CellField<RegionModel>(mesh.n_cells(), model.regions[0]);
    for (Index c = 0; c < mesh.n_cells(); ++c) model.cells[c].elasticity = at(poisson(mesh.cell_centre[c]));
    model.regions[0].elasticity = model.cells[0].elasticity;
    FractureRun run(mesh, model, to_rounding, {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
    double modulus = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) { modulus = pulled(mesh, report).modulus; });
    const std::size_t n = place_unknowns(mesh, elastic_body(model)).pressure_cells.size();
    return std::pair{modulus, n};
  };
  // The first cell lies on the axis; the middle of the disc is compressible, or its rim.
  const auto [outside, n_outside] = with([](const Vector& x) { return x.x() < 0.5 * radius ? 0.46 : 0.4997; });
  const auto [inside, n_inside] = with([](const Vector& x) { return x.x() < 0.5 * radius ? 0.4997 : 0.46; });
  report_row("disc with two ratios", {{"rim incompressible", outside}, {"middle incompressible", inside}});
  // Taylor-Hood elements, 72 x 18 graded.
  EXPECT_NEAR(outside, 13.828, 0.04 * 13.828);
  EXPECT_NEAR(inside, 14.131, 0.1 * 14.131);
  EXPECT_EQ(n_outside, as_size(mesh.n_cells()) / 2);
  EXPECT_EQ(n_inside, as_size(mesh.n_cells()) / 2);
}

}  // namespace
}  // namespace pfdm::verification::this_file
