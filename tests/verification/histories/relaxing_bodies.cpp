// Bodies that relax: the gaps at the faces of their cells relax as strains do, so that a body that has relaxed is the
// elastic one of the relaxed moduli. Nearly incompressible bodies with a history: cells have a pressure by their own
// law.

#include "mesh/dual.h"
#include "mesh/generators/cylinder_sector.h"
#include "physics/materials/j2_plasticity.h"
#include "physics/materials/prony.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/finite.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double mu = 1e6, nu = 0.4997;  // of the rubber
constexpr IsotropicElasticity rubber{.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu};
constexpr StaggeredSettings tight{.damage_tolerance = 1e-9, .energy_tolerance = 1e-12, .equilibrium_tolerance = 1e-12};

// A disc between bonded plates, four times as wide as thick.
constexpr double radius = 1.0, height = 0.25, azimuth = std::numbers::pi / 36.0, rise = 1e-3 * height;
const double area = 0.5 * std::sin(azimuth) * radius * radius;

Mesh disc(Index in_radius, Index in_height) {
  return make_cylinder_sector(
      {.azimuth = azimuth, .radius = {{radius, in_radius, 1.0}}, .height = {{height, in_height, 1.0}}});
}

/// `grown` is the share of the rise at a load parameter.
FractureModel disc_model(const RegionModel& region, const std::function<double(double)>& grown) {
  FractureModel model = elastic_model(
      {region.elasticity}, {axisymmetric_on("front"), axisymmetric_on("back"),
                            displacement_on("bottom", [](const Vector&) -> Vector { return Vector::Zero(); }),
                            moved("top", {true, true, true}, [grown](const Vector&, double t) -> Vector {
                              return rise * grown(t) * Vector::UnitZ();
                            })});
  model.regions[0].material = region.material;
  return model;
}

constexpr IsotropicElasticity foam{.lambda = 4.0 * mu, .mu = mu};  // relaxed, nu = 0.4

RegionModel prony_region(double shear, double bulk) {
  PronyLaw law{.relaxed = foam, .shear = {{shear * mu, 1.0}}};
  if (bulk > 0.0) law.bulk.push_back({bulk * foam.bulk_modulus(), 1.0});
  RegionModel region;
  region.material = make_prony(law);
  region.elasticity = region.material->elasticity();
  return region;
}

struct Pad {
  const char* cells;
  Mesh mesh;
};

std::vector<Pad> pads() {
  const auto flat = [](const Vector& s) -> Vector { return {s[0], s[1], s[2] / 3.0}; };
  return {{.cells = "prisms", .mesh = extruded_triangles(6, {0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25, 1.0 / 3.0})},
          {.cells = "tetrahedra", .mesh = mapped_box({5, 5, 3}, flat, BoxCells::tetrahedra)},
          {.cells = "polyhedra", .mesh = barycentric_dual(mapped_box({5, 5, 3}, flat, BoxCells::tetrahedra))}};
}

RegionModel elastic_region(const IsotropicElasticity& elasticity) {
  RegionModel region;
  region.elasticity = elasticity;
  return region;
}

struct Pulled {
  double modulus = 0.0;  // mean stress over nominal strain and mu
  double account = 0.0;  // what is left of the work, relative
};

Pulled pulled(const Mesh& mesh, const StepReport& report) {
  const auto top = mesh.patch_index("top");
  return {.modulus = report.reaction[top].z() / area / (rise / height) / mu,
          .account = left_over({}, report.energy) / report.energy.external_work};
}

constexpr StaggeredSettings closely{.energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-10};

/// In one step of this duration [s].
Pulled pull_at_once(const Mesh& mesh, const RegionModel& region, double duration,
                    const StaggeredSettings& settings = tight) {
  FractureRun run(mesh, disc_model(region, [](double t) { return t; }), settings,
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .duration = duration, .stops = {}});
  Pulled result;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step > 0) result = pulled(mesh, report);
  });
  return result;
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

// Pulled at once and held, in steps of at most half a relaxation time: the shear modulus falls to a 21st, and of nu =
// 0.46 the bulk modulus by a third.
TEST(RelaxingBodies, NearlyIncompressibleDiscsRelaxToTheElasticOnes) {
  constexpr double branch = 20.0, ramp = 1e-7, duration = 400.0;
  for (const double poisson : {0.46, 0.4997})
    for (const Index fine : {1, 2}) {
      const Mesh mesh = disc(20 * fine, 4 * fine);
      const IsotropicElasticity stiff = from_young_poisson(2.0 * (1.0 + branch) * mu * (1.0 + poisson), poisson);
      const double of_bulk = poisson < 0.47 ? stiff.bulk_modulus() / 3.0 : 0.0;
      const IsotropicElasticity soft{.lambda = stiff.bulk_modulus() - of_bulk - 2.0 * mu / 3.0, .mu = mu};
      PronyLaw law{.relaxed = soft, .shear = {{branch * mu, 1.0}}};
      if (of_bulk > 0.0) law.bulk = {{of_bulk, 3.0}};
      RegionModel region;
      region.material = make_prony(law);
      region.elasticity = region.material->elasticity();
      FractureRun run(mesh, disc_model(region, [](double t) { return std::min(t / ramp, 1.0); }), closely,
                      {.initial_increment = ramp,
                       .minimum_increment = 1e-12,
                       .maximum_increment = 0.5 / duration,
                       .duration = duration,
                       .stops = {},
                       .is_proportional = false});
      Pulled first, last;
      double account = 0.0;
      run_to_end(run, [&](const FractureState&, const StepReport& report) {
        if (report.step == 0) return;
        last = pulled(mesh, report);
        if (report.step == 1) first = last;
        account = std::max(account, std::abs(last.account));
      });
      const double due = pull_at_once(mesh, elastic_region(soft), 1.0).modulus;
      report_row(fmt::format("held disc, nu {}, {} cells", poisson, mesh.n_cells()),
                 {{"at once", first.modulus}, {"held", last.modulus}, {"relaxed", due}, {"account", account}});
      EXPECT_NEAR(last.modulus, due, 2e-4 * due);
      EXPECT_LE(account, fine == 1 ? 0.035 : 0.009);
    }
}

// Square pads, six times as wide as thick, of other cells. The prisms' surfaces are bonded as those of the hexahedra.
TEST(RelaxingBodies, NearlyIncompressiblePadsOfAnyCellsRelaxToTheElasticOnes) {
  constexpr double branch = 20.0, ramp = 1e-7, duration = 200.0;
  for (const double poisson : {0.46, 0.4997})
    for (const Pad& pad : pads()) {
      const IsotropicElasticity stiff = from_young_poisson(2.0 * (1.0 + branch) * mu * (1.0 + poisson), poisson);
      const IsotropicElasticity soft{.lambda = stiff.bulk_modulus() - 2.0 * mu / 3.0, .mu = mu};
      const auto pull = [&](const std::shared_ptr<const Material>& material) {
        FractureModel model =
            elastic_model({material ? material->elasticity() : soft},
                          {symmetry_on("xmin"), symmetry_on("ymin"),
                           displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                           moved("zmax", {true, true, true}, [](const Vector&, double t) -> Vector {
                             return 1e-3 / 3.0 * std::min(t / ramp, 1.0) * Vector::UnitZ();
                           })});
        model.regions[0].material = material;
        FractureRun run(pad.mesh, model, closely,
                        {.initial_increment = material ? ramp : 1.0,
                         .minimum_increment = 1e-12,
                         .maximum_increment = material ? 1.0 / duration : 1.0,
                         .duration = duration,
                         .stops = {},
                         .is_proportional = false});
        double force = 0.0;
        run_to_end(run, [&](const FractureState&, const StepReport& report) {
          force = report.reaction[pad.mesh.patch_index("zmax")].z();
        });
        return force / (1e-3 * mu);
      };
      const double held = pull(make_prony({.relaxed = soft, .shear = {{branch * mu, 1.0}}})), due = pull(nullptr);
      report_row(fmt::format("held pad of {} {}, nu {}", pad.mesh.n_cells(), pad.cells, poisson),
                 {{"held", held}, {"relaxed", due}});
      EXPECT_NEAR(held, due, 1e-3 * due);
    }
}

// By the correspondence principle the force under a held rise is the inverse Laplace transform of the elastic one,
// mu~(s)/s times the elastic modulus at K/mu~(s). What the latter differs by from the relaxed one is transformed by
// Stehfest's method with eight values (Comm. ACM 13 (1970) 47).
TEST(RelaxingBodies, ANearlyIncompressibleDiscRelaxesByTheCorrespondencePrinciple) {
  constexpr double branch = 20.0, poisson = 0.4997, ramp = 1e-7;
  const Mesh mesh = disc(20, 4);
  const double K = from_young_poisson(2.0 * (1.0 + branch) * mu * (1.0 + poisson), poisson).bulk_modulus();
  const auto elastic = [&](double modulus) {  // mean stress over strain and mu; of the same operator
    RegionModel region;
    region.material =
        make_prony({.relaxed = {.lambda = K - 2.0 * modulus / 3.0, .mu = modulus}, .shear = {{1e-12 * mu, 1.0}}});
    region.elasticity = region.material->elasticity();
    return pull_at_once(mesh, region, 1e13, closely).modulus;
  };
  const double relaxed = elastic(mu);
  const auto due = [&](double time) {
    constexpr std::array<double, 8> weights{-1.0 / 3.0,     145.0 / 3.0, -906.0,         16394.0 / 3.0,
                                            -43130.0 / 3.0, 18730.0,     -35840.0 / 3.0, 8960.0 / 3.0};
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double s = static_cast<double>(k + 1) * std::numbers::ln2 / time;
      const double modulus = 1.0 + branch * s / (s + 1.0);
      sum += weights[k] * (elastic(mu * modulus) - modulus * relaxed) / s;
    }
    return (1.0 + branch * std::exp(-time)) * relaxed + sum * std::numbers::ln2 / time;
  };
  const std::array times{0.5, 1.0, 2.0, 4.0, 8.0};
  std::size_t next = 0;
  RegionModel region;
  region.material = make_prony({.relaxed = {.lambda = K - 2.0 * mu / 3.0, .mu = mu}, .shear = {{branch * mu, 1.0}}});
  region.elasticity = region.material->elasticity();
  constexpr double duration = 8.0;
  FractureRun run(mesh, disc_model(region, [](double t) { return std::min(t / ramp, 1.0); }), closely,
                  {.initial_increment = ramp,
                   .minimum_increment = 1e-12,
                   .maximum_increment = 0.05 / duration,
                   .duration = duration,
                   .stops = {0.5 / duration, 1.0 / duration, 2.0 / duration, 4.0 / duration},
                   .is_proportional = false});
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (next == times.size() || std::abs(duration * report.load - times[next]) > 1e-9) return;
    const double found = pulled(mesh, report).modulus, by_principle = due(times[next]);
    report_row(fmt::format("disc after {} relaxation times", times[next++]),
               {{"held", found}, {"by the correspondence principle", by_principle}});
    EXPECT_NEAR(found, by_principle, 0.002 * by_principle);
  });
  EXPECT_EQ(next, times.size());
}

// Plane strain, pressure inside: u(r) = p a^2/(b^2 - a^2) (r/(2 (K + mu/3)) + b^2/(2 mu r)), each modulus by its
// compliance under a load that is held.
TEST(RelaxingBodies, AThickCylinderCreepsAsTheClosedFormSays) {
  constexpr double a = 1.0, b = 2.0, p = 1e4, ramp = 1e-8;
  const double sizes = 0.5 * (1.0 + std::cos(0.025));  // the sector's faces are chords
  struct Creep {
    double first = 0.0, last = 0.0, worst = 0.0, account = 0.0;
  };
  const auto compliance = [](double M_inf, double M_1, double time) {
    return 1.0 / M_inf - (1.0 / M_inf - 1.0 / (M_inf + M_1)) * std::exp(-time * M_inf / (M_inf + M_1));
  };
  const auto errors = [&](double poisson, double ratio, Index n) {
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
    FractureRun run(mesh, model, tight,
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
  };
  for (const double ratio : {21.0, 101.0}) {
    const Creep coarse = errors(0.4, ratio, 8), fine = errors(0.4, ratio, 16);
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
    FractureRun run(mesh, model, tight, {.initial_increment = 0.05, .maximum_increment = 0.05, .stops = {}});
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
    FractureRun run(mesh, model, tight, {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
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
    FractureRun run(mesh, model, tight, {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
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
