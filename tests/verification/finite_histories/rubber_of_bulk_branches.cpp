// Rubber whose volume changes relax, too (physics/materials/volume_branches.h): a bar pulled to and fro against a
// point's equations (heated_rubber.py, SciPy, by hand), pads against the elastic ones that they relax to and against a
// Prony series at small strain, what is refused.

#include "mesh/dual.h"
#include "physics/error.h"
#include "physics/materials/prony.h"
#include "tests/verification/finite.h"
#include "tests/verification/heat_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double pi = std::numbers::pi, mu = 1e6, poisson = 0.2, period = 0.05;
const std::vector<PronyBranch> shear{{.modulus = 2e6, .time = 1e-2}}, bulk{{.modulus = 3e6, .time = 2e-2}};
const IsotropicElasticity relaxed = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson);

std::shared_ptr<const Material> rubber(const std::vector<PronyBranch>& in_shear,
                                       const std::vector<PronyBranch>& in_bulk,
                                       VolumetricForm form = VolumetricForm::quadratic) {
  return make_hyperelastic("neo_hookean",
                           {.elasticity = relaxed, .volumetric = form, .branches = in_shear, .bulk_branches = in_bulk});
}

struct Pulled {
  double rise, stress, lateral;  // [K], nominal [Pa], stretch
};

// After 1.25 and 3.25 cycles of a bar without losses of heat.
std::array<Pulled, 2> pulled(int steps_each) {
  const Mesh mesh = mapped_box({2, 1, 1}, [](const Vector& s) -> Vector { return s; });
  FractureModel model = finite_body(mesh, rubber(shear, bulk),
                                    {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
                                     moved("xmax", {true, false, false}, [](const Vector&, double t) -> Vector {
                                       return 0.3 * std::sin(2.0 * pi * t) * Vector::UnitX();
                                     })});
  RegionModel& region = model.regions[0];
  region.conductivity = 0.2, region.specific_heat = 1500.0, region.density = 1000.0;
  model.heat = HeatModel{};
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-11}, in_steps(3.25, 1.0 / steps_each, period));
  std::array<Pulled, 2> found{};
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    found[1] = {report.heat->figures.greatest, report.reaction[mesh.patch_index("xmax")].x(),
                1.0 + report.patch_displacement[mesh.patch_index("ymax")].y()};
    if (report.step <= 5 * steps_each / 4) found[0] = found[1];
  });
  return found;
}

TEST(RubberOfBulkBranches, ABarPulledToAndFroFollowsItsPoint) {
  const std::array<Pulled, 2> due{{{0.5026489915, 1353337.854, 0.9174326675}, {1.3718548, 1354396.524, 0.9089952023}}};
  const auto coarse = pulled(40), fine = pulled(80);
  for (std::size_t k = 0; k < 2; ++k)
    for (const auto& [what, value] :
         {std::pair{"rise", &Pulled::rise}, {"stress", &Pulled::stress}, {"lateral stretch", &Pulled::lateral}}) {
      const double error = coarse[k].*value / due[k].*value - 1.0, finer = fine[k].*value / due[k].*value - 1.0;
      report_row(fmt::format("{}, {} cycles", what, 1.25 + 2.0 * double(k)), {{"40 steps", error}, {"80", finer}});
      EXPECT_LT(std::abs(finer), 2e-3);
      EXPECT_LT(std::abs(finer), std::abs(error) / 3.4 + 1e-7);
    }
}

struct Pad {
  const char* cells;
  Mesh mesh;
};

std::vector<Pad> pads() {
  const auto flat = [](const Vector& s) -> Vector { return {s[0], s[1], s[2] / 3.0}; };
  return {{.cells = "hexahedra", .mesh = mapped_box({5, 5, 3}, flat)},
          {.cells = "prisms", .mesh = extruded_triangles(4, {0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25, 1.0 / 3.0})},
          {.cells = "tetrahedra", .mesh = mapped_box({3, 3, 2}, flat, BoxCells::tetrahedra)},
          {.cells = "polyhedra", .mesh = barycentric_dual(mapped_box({3, 3, 2}, flat, BoxCells::tetrahedra))}};
}

// Bonded, compressed by 8 % and sheared by 30 % of their height times `part` within a period, and then held.
std::vector<Vector> forces(const Mesh& mesh, FractureModel model, double part, double held, double step) {
  model.boundary = {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("zmax", {true, true, true}, [=](const Vector&, double t) -> Vector {
                      return part * std::min(t, 1.0) / 3.0 * Vector(0.3, 0.0, -0.08);
                    })};
  FractureRun run(mesh, model, {.energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-10},
                  in_steps(1.0 + held, step, period));
  std::vector<Vector> force;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step > 0) force.push_back(report.reaction[mesh.patch_index("zmax")]);
  });
  return force;
}

TEST(RubberOfBulkBranches, PadsRelaxToTheElasticOnes) {
  for (const VolumetricForm form : {VolumetricForm::quadratic, VolumetricForm::logarithmic})
    for (const Pad& pad : pads()) {
      const auto force = [&](const auto& in_shear, const auto& in_bulk) {
        return forces(pad.mesh, finite_body(pad.mesh, rubber(in_shear, in_bulk, form), {}), 1.0, 15.0, 0.5);
      };
      const std::vector<Vector> held = force(shear, bulk),
                                due = force(std::vector<PronyBranch>{}, std::vector<PronyBranch>{});
      const double difference = (held.back() - due.back()).norm() / due.back().norm();
      report_row(fmt::format("pad of {} {}", pad.mesh.n_cells(), pad.cells),
                 {{"from the elastic one", difference}, {"at once, over it", held[1].norm() / due[1].norm()}});
      EXPECT_LT(difference, 1e-4);
      EXPECT_GT(held[1].norm(), 1.4 * due[1].norm());
    }
}

TEST(RubberOfBulkBranches, PadsAtSmallStrainAreThoseOfAPronySeries) {
  constexpr double part = 1e-4;
  const auto series = make_prony({.relaxed = relaxed, .shear = shear, .bulk = bulk});
  for (const Pad& pad : pads()) {
    FractureModel small = elastic_model({series->elasticity()}, {});
    small.regions[0].material = series;
    const std::vector<Vector> due = forces(pad.mesh, small, part, 4.0, 0.25),
                              found = forces(pad.mesh, finite_body(pad.mesh, rubber(shear, bulk), {}), part, 4.0, 0.25);
    double worst = 0.0;
    for (std::size_t k = 0; k < due.size(); ++k) worst = std::max(worst, (found[k] - due[k]).norm() / due[k].norm());
    report_row(fmt::format("small strain, {}", pad.cells), {{"largest difference", worst}});
    EXPECT_LT(worst, 5e-3);
  }
}

TEST(RubberOfBulkBranches, AreRefusedWhereCellsWouldNeedAPressure) {
  const auto complaint = [](const std::function<void()>& make) -> std::string {
    try {
      make();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([] { rubber(shear, bulk); }), "");
  EXPECT_NE(complaint([] { rubber(shear, {{.modulus = 4e6, .time = 1.0}}); }).find("bulk_branches"), std::string::npos);
  EXPECT_NE(complaint([] { rubber(shear, {{.modulus = 1e6, .time = -1.0}}); }), "");
  const Mesh mesh = mapped_box({1, 1, 1}, [](const Vector& s) -> Vector { return s; });
  const auto held = [](const Vector&) -> Vector { return Vector::Zero(); };
  FractureModel model = finite_body(
      mesh, rubber({}, bulk),
      {displacement_on("xmin", held), displacement_on("xmax", held), plane_stress_on("zmin"), plane_stress_on("zmax")});
  const std::string said = complaint([&] { FractureRun(mesh, model, {}, in_steps(1.0, 0.1, 1.0)); });
  EXPECT_NE(said.find("plane stress"), std::string::npos) << said;
}

}  // namespace
}  // namespace pfdm::verification::this_file
