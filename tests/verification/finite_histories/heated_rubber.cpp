// Heat of bodies at finite strain: blocks of viscous rubber strained to and fro against a point's equations
// (heated_rubber.py, SciPy, by hand), small amplitudes against small strain, cells and interfaces that break.

#include "physics/materials/prony.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/finite.h"
#include "tests/verification/heat_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace pfdm::verification::this_file {
namespace {

constexpr double pi = std::numbers::pi, capacity = 1500.0 * 1000.0;  // [J/(m^3 K)]
constexpr double mu = 1e6, branch = 2e6, tau = 1e-2, period = 0.05;
using Rises = std::array<double, 3>;  // at the ends of three cycles [K]

const TemperatureShift wlf{.law = TemperatureShift::Law::wlf, .reference = 300.0, .c1 = 8.86, .c2 = 101.6};
const TemperatureShift arrhenius{
    .law = TemperatureShift::Law::arrhenius, .reference = 290.0, .activation_energy = 120e3};

std::shared_ptr<const Material> rubber(double poisson, std::optional<TemperatureShift> shift = {}, double time = tau) {
  return make_hyperelastic("neo_hookean", {.elasticity = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson),
                                           .branches = {{.modulus = branch, .time = time}},
                                           .shift = shift});
}

// What the heat's account has to be in every step: all that the body dissipates, and nothing is lost.
void expect_account(const StepReport& report, double made) {
  EXPECT_NEAR(report.heat->account.made, made, 1e-12 + 1e-9 * made) << report.step;
  EXPECT_NEAR(report.heat->account.stored, made, 1e-12 + 1e-8 * made) << report.step;
}

// Rises at the ends of the cycles of an insulated body that strains evenly.
Rises rises(const Mesh& mesh, FractureModel model, int steps_each) {
  give_heat(model, {.cycle = 1.0, .repeats_within = 1e-9});
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-11}, cycles(3.0, steps_each, period));
  Rises found{};
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step > 0) expect_account(report, report.energy.plastic_dissipation);
    if (report.step > 0 && report.step % steps_each == 0)
      found.at(as_size(report.step / steps_each - 1)) = report.heat->figures.greatest;
  });
  return found;
}

Mesh bar(BoxCells cells) {
  return mapped_box(
      {2, 1, 1}, [](const Vector& s) -> Vector { return s; }, cells);
}

std::vector<BoundaryCondition> sheared(const Mesh& mesh, double amplitude) {
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, true}, [amplitude](const Vector& x, double t) {
      return Vector(amplitude * std::sin(2.0 * pi * t) * x.y(), 0.0, 0.0);
    }));
  return boundary;
}

std::vector<BoundaryCondition> pulled(double amplitude) {
  return {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
          moved("xmax", {true, false, false}, [amplitude](const Vector&, double t) -> Vector {
            return amplitude * std::sin(2.0 * pi * t) * Vector::UnitX();
          })};
}

// Errors over the oracle's rise, of 40 and of 80 steps a cycle.
void expect_second_order(const std::string& label, const Rises& coarse, const Rises& fine, const Rises& due) {
  for (std::size_t k = 0; k < due.size(); ++k) {
    const double error = coarse[k] / due[k] - 1.0, finer = fine[k] / due[k] - 1.0;
    report_row(fmt::format("{}, cycle {}", label, k + 1), {{"rise", fine[k]}, {"40 steps", error}, {"80", finer}});
    EXPECT_LT(std::abs(finer), 2e-3);
    EXPECT_NEAR(error / finer, 4.0, 0.5);
  }
}

TEST(HeatedRubber, ABlockShearedToAndFroIsAsWarmAsItsPoint) {
  const Rises due{0.9498181075, 2.155310519, 3.362699672};
  const Mesh mesh = bar(BoxCells::tetrahedra);
  const FractureModel model = finite_body(mesh, rubber(0.3), sheared(mesh, 0.8));
  expect_second_order("sheared by 0.8", rises(mesh, model, 40), rises(mesh, model, 80), due);
}

TEST(HeatedRubber, ABlockPulledToAndFroIsAsWarmAsItsPoint) {
  const Mesh mesh = bar(BoxCells::hexahedra);
  for (const auto& [poisson, due] : {std::pair{0.3, Rises{0.5080318359, 1.316546588, 2.133010712}},
                                     {0.4995, Rises{1.25554856, 3.015673351, 4.779779813}}}) {
    const FractureModel model = finite_body(mesh, rubber(poisson), pulled(0.5));
    expect_second_order(fmt::format("pulled by 0.5, nu {}", poisson), rises(mesh, model, 40), rises(mesh, model, 80),
                        due);
  }
}

TEST(HeatedRubber, ASmallShearMakesTheHeatOfSmallStrain) {
  constexpr double amplitude = 1e-3, poisson = 0.3;
  const Mesh mesh = bar(BoxCells::prisms);
  const auto series = make_prony({.relaxed = rubber(poisson)->elasticity(), .shear = {{branch, tau}}});
  FractureModel small = elastic_model({series->elasticity()}, sheared(mesh, amplitude));
  small.regions[0].material = series;
  const Rises due = rises(mesh, small, 40),
              found = rises(mesh, finite_body(mesh, rubber(poisson), sheared(mesh, amplitude)), 40);
  for (std::size_t k = 0; k < due.size(); ++k) EXPECT_NEAR(found[k], due[k], 1e-5 * due[k]);
  EXPECT_NEAR(found[2], 5.647943757e-06, 5e-3 * found[2]);
}

// The long time under the mean of a cycle that repeats.
TEST(HeatedRubber, CyclesThatRepeatWarmForALongTime) {
  constexpr double time = 10.0;
  const Mesh mesh = bar(BoxCells::hexahedra);
  FractureModel model = finite_body(mesh, rubber(0.3), sheared(mesh, 0.8));
  give_heat(model, {.cycle = 1.0, .repeats_within = 5e-3});
  FractureRun run(mesh, model, {}, cycles(8.0, 80, period));
  const FractureState end = run_to_end(run, [](const FractureState&, const StepReport&) {});
  EXPECT_LT(end.load, 3.5);
  CellField<double> warmed;
  const std::vector<HeatRow> rows = run.warm_by_cycles(end, time, 10, warmed);
  const double due = (3.362699672 - 2.155310519) / period * time;
  EXPECT_NEAR(rows.back().figures.mean, due, 3e-3 * due);
}

// Blocks of rubber that are pulled until what glues them has debonded: its toughness is heat, beside the branches'.
TEST(HeatedRubber, DebondingHeatsWhatItParts) {
  const Mesh mesh = two_blocks(2);
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, true, true}, [](const Vector&, double) { return Vector(Vector::Zero()); }),
      moved("xmax", {true, true, true},
            [](const Vector&, double t) { return Vector(1.2 * edge * t, 0.4 * edge * t, 0.0); })};
  for (const double share : {1.0, 0.25}) {
    FractureModel model = finite_body(mesh, rubber(0.3), boundary);
    constexpr double strength = 0.4 * mu;
    const double toughness = 0.1 * strength * edge;
    glue(model, mesh, law_of(find_by_name(traction_separation_laws(), "linear", "law")),
         {.strength = strength, .toughness = toughness, .stiffness = 1e2 * mu / edge}, Vector::UnitX(),
         [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
    give_heat(model, {.debonding_share = share});
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10}, cycles(1.0, 40, period));
    StepReport last;
    const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
      const EnergyAccount& energy = report.energy;
      if (report.step > 0)
        expect_account(report, energy.plastic_dissipation + share * energy.interface_dissipation +
                                   energy.interface_viscous_dissipation);
      last = report;
    });
    EXPECT_NEAR(last.energy.interface_dissipation, toughness * edge * edge, 1e-6 * toughness * edge * edge);
    EXPECT_GT(last.energy.plastic_dissipation, 0.05 * last.energy.interface_dissipation);
    report_row("debonding", {{"debonding over heat", last.energy.interface_dissipation / last.heat->account.made}});
  }
}

// A cell that is torn: what flows in its branches, and what damage frees of them.
TEST(HeatedRubber, ATornCellIsWarmedByWhatItsBranchesLose) {
  const Mesh mesh = bar(BoxCells::hexahedra);
  FractureModel model = finite_body(mesh, rubber(0.4), pulled(2.0));
  model.crack = &crack_geometry("AT1");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  model.viscosity = 1e3;
  RegionModel& region = model.regions[0];
  region.damageable = true, region.Gc = 2.0 * mu, region.ell = 2.0;
  give_heat(model, {});
  FractureRun run(mesh, model, {.damage_tolerance = 1e-6}, cycles(0.2, 200, period));
  StepReport last;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step > 0) expect_account(report, report.energy.plastic_dissipation + report.energy.viscous_dissipation);
    last = report;
  });
  EXPECT_GT(last.max_damage, 0.5);
  EXPECT_GT(last.energy.viscous_dissipation, 0.0);
  EXPECT_LT(std::abs(left_over({}, last.energy)), 2e-2 * last.energy.external_work);
}

// --- Rises that act on the body ------------------------------------------------------------------------------------

// At another temperature, the times of the reference times a_T: to the last digits. Cells have a pressure or none.
TEST(HeatedRubber, AtAnotherTemperatureItHasOtherTimes) {
  constexpr double held_at = 290.0;
  const Mesh mesh = bar(BoxCells::tetrahedra);
  for (const double poisson : {0.3, 0.4995}) {
    const auto force = [&](const std::shared_ptr<const Material>& material) {
      FractureModel model =
          finite_body(mesh, material,
                      {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                       moved("xmax", {true, true, true}, [](const Vector&, double t) -> Vector {
                         return {0.5 * t, 0.3 * t, 0.0};
                       })});
      model.loads.start_temperature = held_at;
      FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12}, cycles(1.0, 10, period));
      Vector found;
      run_to_end(run, [&](const FractureState&, const StepReport& report) {
        found = report.reaction[mesh.patch_index("xmax")];
      });
      return found;
    };
    TemperatureShift shift = wlf;
    shift.reference = 280.0;
    const double time = tau * std::pow(10.0, -8.86 * 10.0 / (101.6 + 10.0));
    const Vector due = force(rubber(poisson, {}, time)), unshifted = force(rubber(poisson));
    EXPECT_LT((force(rubber(poisson, shift)) - due).norm(), 1e-8 * due.norm()) << poisson;
    EXPECT_GT((unshifted - due).norm(), 0.05 * due.norm()) << poisson;
  }
}

struct Warmed {
  double rise, along, across;  // [K], nominal stresses [Pa]
};

// Sheared by 1 to and fro, its volume held, without losing heat: after 1.25 and 3.25 cycles.
std::array<Warmed, 2> warmed(const TemperatureShift& shift, double expansion, int steps_each) {
  const Mesh mesh = bar(BoxCells::hexahedra);
  FractureModel model = finite_body(mesh, rubber(0.3, shift), sheared(mesh, 1.0));
  model.regions[0].expansion = expansion * Tensor::Identity();
  model.loads.start_temperature = 290.0;
  give_heat(model, {.is_two_way = true});
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-11}, cycles(3.25, steps_each, period));
  std::array<Warmed, 2> found{};
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step > 0) expect_account(report, report.energy.plastic_dissipation);
    const Vector force = report.reaction[mesh.patch_index("ymax")];
    if (report.step <= 5 * steps_each / 4) found[0] = {report.heat->figures.greatest, force.x(), force.y()};
    found[1] = {report.heat->figures.greatest, force.x(), force.y()};
  });
  return found;
}

// The coupling is of first order in the step: errors halve with it, and what they tend to is the point's answer.
TEST(HeatedRubber, ABlockThatWarmsItselfRelaxesFasterAndExpands) {
  struct Case {
    const TemperatureShift& shift;
    double expansion;
    std::array<Warmed, 2> due;
  };
  for (const Case& at :
       {Case{wlf, 1e-3, {{{0.5141119464, 2623793.975, -291683.6501}, {1.3734669, 2521273.028, -448255.1607}}}},
        {arrhenius, 0.0, {{{2.224700987, 1683237.501, -316388.4373}, {5.676402725, 1343757.857, -124286.196}}}},
        {arrhenius, 1e-3, {{{2.227197767, 1686759.346, -331445.762}, {5.690952554, 1350269.735, -161176.6533}}}}}) {
    const auto coarse = warmed(at.shift, at.expansion, 160), fine = warmed(at.shift, at.expansion, 320);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto expect = [&](const char* what, double Warmed::*value, double over) {
        const double due = at.due[k].*value, first = (coarse[k].*value - due) / over,
                     second = (fine[k].*value - due) / over;
        report_row(fmt::format("{}, expansion {}", what, at.expansion),
                   {{"due", due}, {"160 steps", first}, {"320", second}, {"to none", 2.0 * second - first}});
        EXPECT_LT(std::abs(second), 1e-3);
        EXPECT_LT(std::abs(2.0 * second - first), 3e-4);
      };
      expect("rise", &Warmed::rise, at.due[k].rise);
      expect("stress along", &Warmed::along, at.due[k].along);
      expect("stress across", &Warmed::across, at.due[k].along);
    }
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
