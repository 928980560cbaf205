// Cohesive faces whose traction depends on the rate of opening: two blocks pulled at a constant speed, against implicit
// steps and an ODE solver; a double cantilever beam opened at three rates, against beams on springs. The expected
// figures are those of rate_interfaces.py (SciPy, by hand).

#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/corrected_beams.h"
#include "tests/verification/cohesive_faces/finite_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

const InterfaceRateLaw& power() { return find_by_name(interface_rate_laws(), "power", "rate law"); }

struct Pulled {
  double opening, traction;  // [m], [Pa]
  EnergyAccount energy;      // [J]
};

// Of 2 mm, pulled apart by 0.3 mm at 1 mm/s.
struct PulledBlocks {
  static constexpr double far = 0.3e-3, speed = 1e-3, area = edge * edge;
  Mesh mesh = two_blocks(2);
  FractureModel model;
  LoadingSettings loading{.end = 1.0, .duration = far / speed, .stops = {}};

  explicit PulledBlocks(Index n_steps) {
    InterfaceLaw law = law_of(linear());
    law.rate = {.law = &power(), .p = {0.2, 1e-3}};
    model = glued_blocks(mesh, law);
    model.boundary = {
        displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
        moved("xmax", {true, true, true}, [](const Vector&, double t) -> Vector { return far * t * Vector::UnitX(); })};
    loading.initial_increment = loading.minimum_increment = loading.maximum_increment = 1.0 / double(n_steps);
  }
  FractureRun run() const { return {mesh, model, {.equilibrium_tolerance = 1e-12}, loading}; }
  std::vector<Pulled> pull() const {
    FractureRun run = this->run();
    std::vector<Pulled> points;
    run_to_end(run, [&](const FractureState& state, const StepReport& report) {
      const OutputInterface interface = run.output(state).interfaces[0];
      points.push_back({interface.opening[0], interface.traction[0].x(), report.energy});
    });
    return points;
  }
};

TEST(InterfacesWithRate, AreTheLawInSeriesWithTheBlocks) {
  struct Due {
    double opening, traction, viscous;
  };
  constexpr Due due[] = {
      {4.283514992151e-05, 3.582425039e+06, 7.306427096e+01}, {9.385859769653e-05, 3.070701152e+06, 1.581029481e+02},
      {1.448821647465e-04, 2.558917627e+06, 2.300592775e+02}, {1.959057317972e-04, 2.047134101e+06, 2.889326380e+02},
      {2.469292988479e-04, 1.535350576e+06, 3.347230295e+02}, {2.979528658986e-04, 1.023567051e+06, 3.674304520e+02}};
  const std::vector<Pulled> points = PulledBlocks(24).pull();
  ASSERT_EQ(points.size(), 25u);
  double of_opening = 0.0, of_traction = 0.0, of_viscous = 0.0;
  for (std::size_t i = 0; i < std::size(due); ++i) {
    const Pulled& now = points[4 * (i + 1)];
    of_opening = std::max(of_opening, std::abs(now.opening / due[i].opening - 1.0));
    of_traction = std::max(of_traction, std::abs(now.traction / due[i].traction - 1.0));
    of_viscous = std::max(
        of_viscous, std::abs(now.energy.interface_viscous_dissipation / PulledBlocks::area / due[i].viscous - 1.0));
  }
  report_row("two blocks", {{"opening", of_opening}, {"traction", of_traction}, {"viscous dissipation", of_viscous}});
  EXPECT_LT(of_opening, 1e-8);
  EXPECT_LT(of_traction, 1e-8);
  EXPECT_LT(of_viscous, 1e-8);
}

// The linear law softens at a constant rate in the end: opening and traction do not depend on the steps. What is
// dissipated on the way does, in the first order.
TEST(InterfacesWithRate, TendToTheSolutionInTime) {
  constexpr double opening = 2.979528658986e-04, viscous = 3.749348547e+02;  // ODE
  double before = 0.0;
  for (const Index n : {48, 96, 192}) {
    const Pulled end = PulledBlocks(n).pull().back();
    const double error = end.energy.interface_viscous_dissipation / PulledBlocks::area / viscous - 1.0;
    const double account = left_over({}, end.energy) / end.energy.external_work;
    report_row(fmt::format("two blocks, {} steps", n), {{"viscous dissipation", error}, {"energy account", account}});
    EXPECT_NEAR(end.opening, opening, 1e-8 * opening);
    EXPECT_LT(std::abs(account), 0.1 / double(n));
    if (before != 0.0) {
      EXPECT_NEAR(error / before, 0.5, 0.1);
    }
    before = error;
  }
  EXPECT_NEAR(before, 0.0, 2e-3);
}

TEST(InterfacesWithRate, GoOnFromAStateWithTheSameBits) {
  const PulledBlocks blocks(12);
  FractureRun run = blocks.run();
  std::vector<FractureState> states;
  run_to_end(run, [&](const FractureState& state, const StepReport&) { states.push_back(state); });
  FractureRun again = blocks.run();
  const FractureState end = run_to_end(again, states[5], [](const FractureState&, const StepReport&) {});
  EXPECT_EQ(end.interfaces, states.back().interfaces);
  EXPECT_EQ(end.displacement, states.back().displacement);
  EXPECT_EQ(end.energy, states.back().energy);
}

TEST(InterfacesWithRate, NeedADuration) {
  PulledBlocks blocks(12);
  blocks.loading.duration = 0.0;
  EXPECT_THROW(blocks.run(), InputError);
  blocks.loading.duration = 1.0;
  blocks.loading.maximum_dissipation = 1e-6;
  EXPECT_THROW(blocks.run(), InputError);
}

// A neo-Hookean bar and the law in series, opened at changing rates, unloaded, opened again.
TEST(InterfacesWithRate, FollowTheirLawAtFiniteStrain) {
  using namespace finite_blocks;
  InterfaceLaw law = law_of(linear());
  law.rate = {.law = &power(), .p = {0.2, 1e-3}};
  const double length = bond.toughness / bond.strength;
  std::vector<double> path{0.0}, traction{0.0};
  InterfaceHistory history;
  for (const double x : {0.01, 0.2, 0.4, 0.6, 0.3, 0.7, 1.0}) {
    const InterfaceResponse response = law.respond(bond, Vector::UnitX(), x * length * Vector::UnitX(), history, 0.5);
    history = response.history;
    traction.push_back(response.traction.x());
    path.push_back(x * length + 2.0 * edge * (confined_stretch(traction.back()) - 1.0));
  }
  const Mesh mesh = two_blocks(2);
  FractureModel model = bonded_blocks(mesh, law, rubber);
  model.boundary = pulled_along(path);
  const std::vector<Step> steps = finite_steps(mesh, model, path.size() - 1, 1e-12, 0.5);
  ASSERT_EQ(steps.size(), path.size());
  double of_force = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i)
    of_force = std::max(of_force, std::abs(steps[i].force.x() / (edge * edge) - traction[i]) / bond.strength);
  const double viscous = steps.back().energy.interface_viscous_dissipation / (edge * edge);
  report_row("neo-Hookean bar", {{"traction", of_force}, {"viscous dissipation", viscous / history.viscous - 1.0}});
  EXPECT_LT(of_force, 1e-9);
  EXPECT_NEAR(viscous, history.viscous, 1e-9 * history.viscous);
}

// A bond that holds and a branch beside it, pulled and let go: without load (K + K_v) delta' = -K delta/tau.
TEST(InterfacesWithRate, CloseSlowlyWhenTheLoadIsGone) {
  const double K_v = 2.0 * stiffness, tau = 2e-3, time = 8e-3;
  PulledBlocks blocks(80);
  InterfaceLaw law = law_of(linear());
  law.branches = {{.stiffness = K_v, .time = tau}};
  FractureModel model = glued_blocks(blocks.mesh, law);
  const double most = 0.5 * strength;
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {false, false, false}, [=](const Vector&, double t) -> Vector {
                      return most * std::max(0.0, 1.0 - std::abs(4.0 * t - 1.0)) * Vector::UnitX();
                    })};
  blocks.model = std::move(model);
  blocks.loading.duration = time;
  const std::vector<Pulled> points = blocks.pull();
  ASSERT_EQ(points.size(), 81u);
  EXPECT_GT(points[40].opening, 0.1 * most / stiffness);
  const double rest = points.back().opening / points[40].opening,
               due = std::exp(-0.5 * time * stiffness / (tau * (stiffness + K_v)));
  const double account = left_over({}, points.back().energy) / points.back().energy.interface_viscous_dissipation;
  report_row("let go", {{"what is left of the opening", rest / due - 1.0}, {"energy account", account}});
  EXPECT_NEAR(rest / due, 1.0, 1e-3);
  EXPECT_LT(std::abs(account), 5e-3);
}

// A bond that holds and a branch beside it: u = delta + c T, T = K delta + q, q' + q/tau = K_v delta', in closed form
// by z = delta: (1 + c (K + K_v)) z' = V - ((1 + c K) z - V t)/tau.
TEST(InterfacesWithRate, RelaxByTheirBranches) {
  const double c = 2e-3 / 1e9, K = stiffness, K_v = 2.0 * stiffness, tau = 2e-3, far = 2e-6, time = 4e-3;
  const double V = far / time, a = 1.0 + c * (K + K_v), b = 1.0 + c * K, decay = b / (a * tau);
  const auto opening = [&](double t) {  // z = V t/b + B (1 - exp(-decay t))
    return V * t / b + V * tau / b * (1.0 - a / b) * (1.0 - std::exp(-decay * t));
  };
  double before = 0.0;
  for (const Index n : {20, 40, 80}) {
    PulledBlocks blocks(n);
    InterfaceLaw law = law_of(linear());
    law.branches = {{.stiffness = K_v, .time = tau}};
    FractureModel model = glued_blocks(blocks.mesh, law);
    model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                      moved("xmax", {true, true, true},
                            [&](const Vector&, double t) -> Vector { return far * t * Vector::UnitX(); })};
    blocks.model = std::move(model);
    blocks.loading.duration = time;
    const Pulled end = blocks.pull().back();
    const double error = end.opening / opening(time) - 1.0,
                 account = left_over({}, end.energy) / end.energy.external_work;
    report_row(fmt::format("branch, {} steps", n), {{"opening", error}, {"energy account", account}});
    EXPECT_LT(std::abs(account), 1e-3);
    if (before != 0.0) {
      EXPECT_NEAR(error / before, 0.25, 0.1);
    }
    before = error;
  }
  EXPECT_NEAR(before, 0.0, 1e-4);
}

// Opened by D at constant rates; G by force and D (corrected_beams.h), of any length of the crack.
struct PeeledBeam {
  Index along = 52, across = 12, n_steps = 176;

  double toughness_at(double rate) const {
    constexpr double width = 1e-3, h = CorrectedBeam::height, slit = 30e-3, end = 2.2e-3;
    BoxHexesSettings box;
    box.axes[0] = {{29e-3, 55, 1.0}, {13e-3, along, 1.0}, {18e-3, 14, 8.0}};
    box.axes[1] = {{2.0 * h, across, 1.0}};
    box.axes[2] = {{width, 1, 1.0}};
    box.slits = {{.name = "slit", .lower = {-1.0, h, -1.0}, .upper = {slit, h, 1.0}}};
    box.patches = {{.name = "upper", .lower = {-1.0, h, -1.0}, .upper = {1e-9, 3.0 * h, 1.0}},
                   {.name = "lower", .lower = {-1.0, -h, -1.0}, .upper = {1e-9, h, 1.0}}};
    const Mesh mesh = make_box_hexes(box);
    FractureModel model =
        elastic_model({from_young_poisson(CorrectedBeam::E, CorrectedBeam::nu)}, {plane_on("zmin"), plane_on("zmax")});
    for (const double side : {1.0, -1.0})
      model.boundary.push_back(moved(side > 0.0 ? "upper" : "lower", {false, true, false},
                                     [=](const Vector&, double t) { return Vector(0.0, 0.5 * side * end * t, 0.0); }));
    model.boundary.push_back(displacement_on("xmax", [](const Vector&) -> Vector { return Vector::Zero(); }));
    InterfaceLaw law = law_of(linear());
    law.rate = {.law = &power(), .p = {0.2, 1e-4}};
    glue(model, mesh, law, {.strength = 50e6, .toughness = 281.0}, Vector::UnitY(),
         [&](const Vector& x) { return std::abs(x.y() - h) < 1e-9; });
    const double increment = 1.0 / double(n_steps);
    FractureRun run(mesh, model, {},
                    {.end = 1.0,
                     .initial_increment = increment,
                     .maximum_increment = increment,
                     .duration = end / rate,
                     .stops = {}});
    double force = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      force = report.reaction[mesh.patch_index("upper")].y() / width;
    });
    const double E_h3 = CorrectedBeam().plane_modulus * std::pow(h, 3);
    const double length = std::cbrt(end * E_h3 / (8.0 * force));
    return 12.0 * force * force * length * length / E_h3;
  }
};

TEST(InterfacesWithRate, PeelABeamAtThreeRates) {
  struct Due {
    double rate, G, limit;  // [m/s], [J/m^2] of the beams: with as many steps, and with steps extrapolated to none
  };
  for (const auto& [rate, due, limit] :
       {Due{1e-4, 437.05, 440.1}, Due{1e-3, 530.54, 535.8}, Due{1e-2, 679.23, 687.3}}) {
    const double G = PeeledBeam().toughness_at(rate);
    report_row(fmt::format("beam opened at {} mm/s", 1e3 * rate),
               {{"toughness, J/m^2", G}, {"error", G / due - 1.0}, {"from the limit", G / limit - 1.0}});
    EXPECT_NEAR(G, due, 0.02 * due);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
