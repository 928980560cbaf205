// Rises of the temperature that act on the body: relaxation times that shift, expansion, cycles of load that are gone
// through again within a long time. Oracles are the equations of a point, integrated with fine steps.

#include "physics/materials/prony.h"
#include "tests/verification/finite.h"
#include "tests/verification/heat_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double pi = std::numbers::pi, capacity = 1500.0 * 1000.0;  // [J/(m^3 K)]
constexpr double mu_0 = 1e6, mu_1 = 4e6, tau = 1e-2, start = 290.0;
const TemperatureShift wlf{.law = TemperatureShift::Law::wlf, .reference = 300.0, .c1 = 8.86, .c2 = 101.6};
const TemperatureShift arrhenius{
    .law = TemperatureShift::Law::arrhenius, .reference = 290.0, .activation_energy = 120e3};

PronyLaw law(const TemperatureShift& shift) {
  return {.relaxed = {.lambda = 2e6, .mu = mu_0}, .shear = {{mu_1, tau}}, .shift = shift};
}

// tau at a temperature [K], by the published equations.
double time_at(const TemperatureShift& shift, double T) {
  if (shift.law == TemperatureShift::Law::arrhenius)
    return tau * std::exp(shift.activation_energy / 8.314462618 * (1.0 / T - 1.0 / shift.reference));
  return tau * std::pow(10.0, -shift.c1 * (T - shift.reference) / (shift.c2 + T - shift.reference));
}

Mesh block() {
  return mapped_box({2, 2, 2}, [](const Vector& s) -> Vector { return 1e-3 * s; });
}

// Sheared by gamma(t) on all sides.
FractureModel sheared(const Mesh& mesh, const PronyLaw& by, const std::function<double(double)>& gamma) {
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, true},
                             [gamma](const Vector& x, double t) { return Vector(gamma(t) * x.y(), 0.0, 0.0); }));
  const auto material = make_prony(by);
  FractureModel model = elastic_model({material->elasticity()}, boundary);
  RegionModel& region = model.regions[0];
  region.material = material;
  region.conductivity = 0.2, region.specific_heat = 1500.0, region.density = 1000.0;
  model.loads.start_temperature = start;
  return model;
}

double shear_stress(const Mesh& mesh, const StepReport& report) {
  return report.reaction[mesh.patch_index("ymax")].x() / 1e-6;
}

// The state of a point with its number of values, a step of Runge and Kutta.
template <class Rate, std::size_t n>
std::array<double, n> runge_kutta(const Rate& rate, double t, double dt, const std::array<double, n>& y) {
  const auto at = [&](double part, const std::array<double, n>& k) {
    std::array<double, n> z = y;
    for (std::size_t i = 0; i < n; ++i) z[i] += part * dt * k[i];
    return z;
  };
  const auto k1 = rate(t, y), k2 = rate(t + 0.5 * dt, at(0.5, k1)), k3 = rate(t + 0.5 * dt, at(0.5, k2)),
             k4 = rate(t + dt, at(1.0, k3));
  std::array<double, n> next = y;
  for (std::size_t i = 0; i < n; ++i) next[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  return next;
}

class WarmBodies : public ::testing::TestWithParam<TemperatureShift> {};

// At another temperature, the times of the reference times a_T: to the last digits.
TEST_P(WarmBodies, AColdBodyIsOneOfOtherTimes) {
  const Mesh mesh = block();
  const auto force = [&](const PronyLaw& by) {
    FractureRun run(mesh, sheared(mesh, by, [](double t) { return 1e-3 * t; }), {.equilibrium_tolerance = 1e-12},
                    in_steps(1.0, 0.1, 0.02));
    double stress = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) { stress = shear_stress(mesh, report); });
    return stress;
  };
  TemperatureShift shift = GetParam();
  shift.reference = 280.0;
  PronyLaw other = law(shift);
  other.shear[0].time = time_at(shift, start);
  other.shift.reset();
  EXPECT_NEAR(force(law(shift)), force(other), 1e-9 * force(other));
}

// Sheared at once and held while the temperature rises by 10 K: reduced time, of second order in the steps.
TEST_P(WarmBodies, RelaxationUnderARisingTemperature) {
  const Mesh mesh = block();
  constexpr double gamma = 1e-3, duration = 0.02, ramp = 1e-6;
  double reduced = 0.0;  // integral of dt/tau
  for (int i = 0; i < 10000; ++i) reduced += duration / 10000.0 / time_at(GetParam(), start + 10.0 * (i + 0.5) / 1e4);
  const double due = gamma * (mu_0 + mu_1 * std::exp(-reduced));
  std::array<double, 2> error{};
  for (const int fine : {0, 1}) {
    FractureModel model = sheared(mesh, law(GetParam()), [](double t) { return gamma * std::min(t / ramp, 1.0); });
    model.loads.temperature = [](const Vector&, double t) { return 10.0 * t; };
    LoadingSettings loading = in_steps(1.0, fine == 0 ? 0.05 : 0.025, duration);
    loading.initial_increment = ramp;
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12}, loading);
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      error[fine] = shear_stress(mesh, report) / due - 1.0;
    });
  }
  report_row("relaxation under a ramp of temperature", {{"error", error[0]}, {"steps halved", error[1]}});
  EXPECT_LE(std::abs(error[0]), 2e-3);
  EXPECT_LE(std::abs(error[1]), 0.35 * std::abs(error[0]) + 1e-6);
}

// Sheared at a constant rate without losing heat, it becomes warm by tens of kelvins, relaxes faster, and so on.
TEST_P(WarmBodies, AShearedBlockWarmsAndSoftens) {
  constexpr double gamma = 10.0, duration = 0.2;
  const auto rate = [&](double, const std::array<double, 2>& y) -> std::array<double, 2> {
    const double q = y[0], of_spring = q / time_at(GetParam(), y[1]);  // q' = gamma' - q/tau, heat mu_1 q^2/tau
    return {gamma / duration - of_spring, mu_1 * q * of_spring / capacity};
  };
  std::array<double, 2> point{0.0, start};
  for (int i = 0; i < 20000; ++i) point = runge_kutta(rate, 0.0, duration / 20000.0, point);
  const double stress = mu_0 * gamma + mu_1 * point[0], rise = point[1] - start;
  std::array<double, 2> stress_error{}, rise_error{};
  const Mesh mesh = block();
  for (const int fine : {0, 1}) {
    FractureModel model = sheared(mesh, law(GetParam()), [](double t) { return gamma * t; });
    model.heat = HeatModel{.is_two_way = true};
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12},
                    in_steps(1.0, fine == 0 ? 1.0 / 400.0 : 1.0 / 800.0, duration));
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      if (report.load < 1.0 - 1e-9) return;
      stress_error[fine] = shear_stress(mesh, report) / stress - 1.0;
      rise_error[fine] = report.heat->figures.greatest / rise - 1.0;
      EXPECT_NEAR(report.heat->elapsed, duration, 1e-12);
    });
  }
  report_row("sheared without losing heat", {{"rise", rise},
                                             {"error", rise_error[0]},
                                             {"steps halved", rise_error[1]},
                                             {"of stress", stress_error[0]},
                                             {"steps halved", stress_error[1]}});
  EXPECT_GT(rise, 5.0);
  for (const auto& error : {stress_error, rise_error}) {
    EXPECT_LE(std::abs(error[0]), 0.01);
    EXPECT_NEAR(error[1], 0.5 * error[0], 0.1 * std::abs(error[0]) + 1e-6);  // of first order
  }
}

INSTANTIATE_TEST_SUITE_P(Shifts, WarmBodies, ::testing::Values(wlf, arrhenius));

// Confined, and warmed from its surfaces: a pressure 3 K alpha T, whatever damage is there; the account is closed.
TEST(WarmBody, ConfinedItIsUnderPressure) {
  constexpr double alpha = 1e-4, rise = 10.0;
  const IsotropicElasticity elasticity = from_young_poisson(1e7, 0.3);
  const Mesh mesh = mapped_box({4, 3, 3}, [](const Vector& s) -> Vector { return 1e-3 * s; });
  for (const bool is_two_way : {false, true}) {
    std::vector<BoundaryCondition> boundary;
    std::vector<DiffusionBoundary> warm;
    for (const Patch& patch : mesh.patches) {
      boundary.push_back(symmetry_on(patch.name));
      warm.push_back({.patch = patch.name, .kind = DiffusionBoundary::Kind::value, .value = rise});
    }
    FractureModel model = elastic_model({elasticity}, boundary);
    RegionModel& region = model.regions[0];
    region.expansion = alpha * Tensor::Identity();
    region.conductivity = 0.2, region.specific_heat = 1500.0, region.density = 1000.0;
    model.heat = HeatModel{.boundary = warm, .is_two_way = is_two_way};
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12}, in_steps(1.0, 0.1, 100.0));
    const double due = is_two_way ? -3.0 * elasticity.bulk_modulus() * alpha * rise : 0.0;
    double stress = 0.0, account = 0.0;
    const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
      stress = report.reaction[mesh.patch_index("xmax")].x() / 1e-6;
      account = left_over({}, report.energy);
    });
    EXPECT_NEAR(stress, due, 1e-4 * std::abs(due) + 1e-6);
    EXPECT_LE(std::abs(account), 2e-3 * 1.5 * std::abs(due) * alpha * rise * 1e-9);  // of what is stored
    // What is shown is what was solved.
    const OutputFields fields = run.output(end);
    for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_NEAR(fields.stress[c](1, 1), due, 1e-4 * std::abs(due) + 1e-6);
  }
}

// Sheared to and fro, with an exchange of heat: c T' = G''(w a_T(T)) gamma^2 w/2 - h A/V (T - T_0). The cycle is gone
// through again when moduli have changed by some per cent.
TEST(WarmBody, FollowsALongTimeByCyclesThatRepeat) {
  constexpr double gamma = 0.2, period = 2.0 * pi * 4e-3, time = 20.0, exchange = 1000.0, side = 1e-3;
  const auto rate = [&](double, const std::array<double, 1>& y) -> std::array<double, 1> {
    const double wt = 2.0 * pi / period * time_at(arrhenius, y[0]);
    const double power = mu_1 * wt / (1.0 + wt * wt) * gamma * gamma * pi / period;
    return {(power - exchange * 2.0 / side * (y[0] - start)) / capacity};
  };
  std::array<double, 1> point{start};
  std::array<double, 1> cold = rate(0.0, point);
  for (int i = 0; i < 20000; ++i) point = runge_kutta(rate, 0.0, time / 20000.0, point);
  const double rise = point[0] - start;
  const Mesh mesh = block();
  std::array<double, 2> error{};
  for (const int fine : {0, 1}) {
    FractureModel model = sheared(mesh, law(arrhenius), [](double t) { return gamma * std::sin(2.0 * pi * t); });
    model.regions[0].conductivity = 200.0;  // nearly uniform
    HeatModel heat{.cycle = 1.0,
                   .repeats_within = 2e-3,
                   .time = time,
                   .time_steps = 200,
                   .is_two_way = true,
                   .changes_within = fine == 0 ? 0.04 : 0.02};
    for (const char* patch : {"xmin", "xmax"})
      heat.boundary.push_back(
          {.patch = patch, .kind = DiffusionBoundary::Kind::exchange, .value = 0.0, .coefficient = exchange});
    model.heat = heat;
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-9}, in_steps(200.0, 1.0 / 80.0, period));
    StepReport last;
    run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
    EXPECT_NEAR(last.heat->elapsed, time, 1e-6 * time);
    error[fine] = last.heat->figures.mean / rise - 1.0;
    const HeatBalance& account = last.heat->account;
    EXPECT_NEAR(account.made, account.stored + account.lost, 1e-7 * account.made);
    report_row("cycles of a long time", {{"rise", last.heat->figures.mean}, {"due", rise}, {"cycles", last.load}});
  }
  report_row(
      "cycles of a long time",
      {{"error", error[0]}, {"half the change of moduli", error[1]}, {"at the cold rate", cold[0] * time / rise}});
  EXPECT_LE(std::abs(error[0]), 0.01);
  EXPECT_LE(std::abs(error[1]), 0.004);
}

}  // namespace
}  // namespace pfdm::verification::this_file
