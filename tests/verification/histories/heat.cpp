// Heat that load steps make, and its cycles: a sheared viscoelastic block, two blocks that rub.

#include "physics/materials/prony.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/heat_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double pi = std::numbers::pi;

constexpr double capacity = 1500.0 * 1000.0;  // [J/(m^3 K)]

// Each cycle makes pi G'' gamma_0^2 per volume, G'' = mu_1 w tau/(1 + (w tau)^2), once the start has been forgotten.
TEST(Heat, AShearedViscoelasticBlockWarmsByItsLoss) {
  constexpr double mu_1 = 1e6, tau = 1e-3, gamma_0 = 1e-3, period = 2.0 * pi * 2e-3;
  const auto material = make_prony({.relaxed = from_young_poisson(2e6, 0.4), .shear = {{mu_1, tau}}});
  const Mesh mesh =
      make_box_hexes({.axes = {{{{1e-3, 2, 1.0}}, {{1e-3, 2, 1.0}}, {{1e-3, 2, 1.0}}}}, .regions = {}, .slits = {}});
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, true}, [](const Vector& x, double t) {
      return Vector(gamma_0 * std::sin(2.0 * pi * t) * x.y(), 0.0, 0.0);
    }));
  FractureModel model = elastic_model({material->elasticity()}, boundary);
  model.regions[0].material = material;
  give_heat(model, {.cycle = 1.0, .repeats_within = 1e-4});
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10}, cycles(10.0, 160, period));
  double before = 0.0, rise = 0.0;  // at the beginning and at the end of the last cycle
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (std::abs(report.load - std::round(report.load)) > 1e-9) return;
    before = rise;
    rise = report.heat->figures.greatest;
    EXPECT_NEAR(report.heat->account.made, report.energy.plastic_dissipation, 1e-9 * report.heat->account.made);
    EXPECT_NEAR(report.heat->account.stored, report.heat->account.made, 1e-7 * report.heat->account.made);
  });
  EXPECT_LT(end.load, 5.5);  // it repeats before the end
  EXPECT_LE(end.heat.cycle_change, 1e-4);
  const double wt = 2.0 * pi / period * tau, loss = mu_1 * wt / (1.0 + wt * wt);
  const double due = pi * loss * gamma_0 * gamma_0 / capacity;
  report_row("sheared block", {{"rise of a cycle over closed form", (rise - before) / due}});
  EXPECT_NEAR(rise - before, due, 1e-3 * due);
  // The long time under the mean of the last cycle: G'' gamma_0^2 w/2.
  CellField<double> warmed;
  const std::vector<HeatRow> rows = run.warm_by_cycles(end, 60.0, 10, warmed);
  const double rate = loss * gamma_0 * gamma_0 * pi / period / capacity;
  EXPECT_NEAR(rows.back().figures.greatest, 60.0 * rate, 1e-3 * 60.0 * rate);
  EXPECT_NEAR(rows.back().figures.mean, rows.back().figures.greatest, 1e-6 * 60.0 * rate);
}

// Blocks pressed by N on each other that slide to and fro by a: 4 mu N a in each cycle.
TEST(Heat, TwoBlocksRub) {
  constexpr double pressure = 1e4, mu = 0.3, a = 1e-4, E = 1e9;
  const Mesh mesh = two_blocks(2);
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, true}, [](const Vector& x, double t) {
      const double phase = t - std::floor(t);  // 0, a, 0, -a, 0
      const double slide = phase < 0.25 ? 4.0 * phase : phase < 0.75 ? 2.0 - 4.0 * phase : 4.0 * phase - 4.0;
      return Vector(-pressure / E * x.x(), x.x() > edge ? a * slide : 0.0, 0.0);
    }));
  FractureModel model = elastic_model({block}, boundary);
  InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  law.friction = mu;
  glue(model, mesh, law, {.strength = 1e3, .toughness = 1e-6, .stiffness = 2e15}, Vector::UnitX(),
       [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
  give_heat(model, {.cycle = 1.0});
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10}, cycles(6.0, 8, 1e-2));
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
    EXPECT_NEAR(report.heat->account.made, report.energy.interface_dissipation, 1e-9 * report.heat->account.made);
    EXPECT_NEAR(report.heat->account.stored, report.heat->account.made, 1e-7 * report.heat->account.made);
  });
  EXPECT_LE(end.load, 3.0);  // in the first the interface breaks; the others are alike
  double of_cycle = 0.0;
  for (const double q : end.heat.cycle) of_cycle += q;
  const double due = 4.0 * mu * pressure * edge * edge * a;
  report_row("rubbing blocks", {{"heat of a cycle over 4 mu N a", of_cycle / due}});
  EXPECT_NEAR(of_cycle, due, 1e-3 * due);
  // Each block, of one material, takes half of it, and only the cells beside the interface are given it.
  for (Index c = 0; c < mesh.n_cells(); ++c)
    EXPECT_NEAR(end.heat.cycle[c], std::abs(mesh.cell_centre[c].x() - edge) < 0.5 * edge ? due / 8.0 : 0.0, 2e-3 * due)
        << mesh.cell_centre[c].transpose();
}

// A face that has debonded and is open conducts by its own key, one that is closed again perfectly.
TEST(Heat, OpenFacesInsulate) {
  const Mesh mesh = two_blocks(2);
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, true, true}, [](const Vector&, double) { return Vector(Vector::Zero()); }),
      moved("xmax", {true, true, true},
            [](const Vector&, double t) { return Vector(t < 1.5 ? 4e-3 * t : 0.0, 0.0, 0.0); })};
  for (const double open : {0.0, 30.0}) {
    FractureModel model = elastic_model({block}, boundary);
    glue(model, mesh, law_of(find_by_name(traction_separation_laws(), "linear", "law")), glued, Vector::UnitX(),
         [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
    give_heat(model, {.boundary = {{.patch = "xmin", .kind = DiffusionBoundary::Kind::value, .value = 1.0}},
                      .debonding_share = 0.0,
                      .open_conductance = open});
    LoadingSettings loading = cycles(2.0, 1, 1e8);
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10}, loading);
    run_to_end(run, [&](const FractureState& state, const StepReport& report) {
      if (report.step == 0) return;
      const bool is_open = report.step == 1;
      for (Index c = 0; c < mesh.n_cells(); ++c) {
        const bool far = mesh.cell_centre[c].x() > edge;
        EXPECT_NEAR(state.heat.rise[c], far && is_open && open == 0.0 ? 0.0 : 1.0, 1e-3) << report.step;
      }
      EXPECT_EQ(report.heat->account.made, 0.0);
    });
  }
}

TEST(Heat, IsRefusedWithWhatItCannotBeCombinedWith) {
  const Mesh mesh = two_blocks(1);
  const auto complaint = [&](const std::function<void(FractureModel&, LoadingSettings&)>& change) -> std::string {
    FractureModel model =
        elastic_model({block}, displacement_on_all(mesh, [](const Vector&) { return Vector(Vector::Zero()); }));
    LoadingSettings loading = cycles(1.0, 4, 1.0);
    give_heat(model, {});
    change(model, loading);
    try {
      FractureRun(mesh, model, {}, loading);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](FractureModel&, LoadingSettings&) {}), "");
  EXPECT_NE(complaint([](FractureModel& m, LoadingSettings&) { m.regions[0].density = 0.0; }).find("density"),
            std::string::npos);
  EXPECT_NE(complaint([](FractureModel&, LoadingSettings& l) { l.duration = 0.0; }).find("duration"),
            std::string::npos);
  EXPECT_NE(complaint([](FractureModel&, LoadingSettings& l) { l.maximum_dissipation = 1.0; }).find("dissipation"),
            std::string::npos);
  EXPECT_NE(complaint([](FractureModel& m, LoadingSettings&) {
              m.heat->boundary = {{.patch = "nowhere", .kind = DiffusionBoundary::Kind::value}};
            }).find("nowhere"),
            std::string::npos);
}

}  // namespace
}  // namespace pfdm::verification::this_file
