// 3. A material of one's own: a bar of a metal that creeps is stretched and held, and its stress relaxes.
//
// Problem: a bar of 20 mm with square section of 4 mm is stretched by 0.1 % within 1 ms and held for 1000 s.
// Material: E = 100 GPa, nu = 0.3, with Norton's creep, which the program does not have: a viscous strain that grows in
// the direction of the stress deviator s at the equivalent rate A sigma_eq^m, sigma_eq = (3/2 s:s)^(1/2), A = 1e-28
// Pa^-3 s^-1, m = 3 (Norton 1929; the implicit step as Simo, Hughes, Computational Inelasticity, 1998, sec. 1.7).
//
//      z,y ^  ____________________________
//   sym.   | |                            | -> u_x
//          +-+----------------------------+---> x         4 x 2 x 2 cells; y = 0 and z = 0 are planes of symmetry
//
// Result: under the strain that is held sigma' = -E A sigma^m, hence sigma(t) = (sigma_0^(1-m) + (m-1) E A
// t)^(1/(1-m)); the program ends with 1 unless the stress follows it within 1 %.
//
//   cmake -S cases/cpp -B build/cpp -DCMAKE_PREFIX_PATH=DIR && cmake --build build/cpp && build/cpp/3_creep

#include "mesh/generators/box_hexes.h"
#include "physics/materials/small_strain_material.h"
#include "solver/fracture/fracture_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace {

using namespace pfdm;

constexpr double E = 100e9, nu = 0.3;          // [Pa], [-]
constexpr double A = 1e-28, m = 3.0;           // [Pa^-m s^-1], [-]
constexpr double length = 0.02, width = 4e-3;  // [m]
constexpr double stretch = 1e-3, hold = 1e3;   // [-], [s]

/// History: the viscous strain in six Mandel components [-], and the energy that has become heat [J/m^3].
class NortonCreep : public SmallStrainMaterial {
 public:
  explicit NortonCreep(const IsotropicElasticity& elasticity) : SmallStrainMaterial("norton_creep", elasticity) {}

  bool depends_on_rate() const override { return true; }
  std::size_t history_size() const override { return 7; }
  std::vector<HistoryField> history_fields() const override {
    return {{.name = "creep_strain", .unit = "1", .first = 0, .size = 6}};
  }

 protected:
  /// Backward Euler: sigma_eq + 3 mu dt A sigma_eq^m = that of the trial stress, by Newton's method; s keeps its
  /// direction.
  Response update_strain(const Step& step, std::span<double> history) const override {
    const double mu = elasticity().mu, dt = step.duration;
    Eigen::Map<Mandel> creep(history.data());
    const Mandel before = Eigen::Map<const Mandel>(step.history.data());
    const MandelMatrix C = stiffness_matrix(elasticity());
    const Mandel trial = C * (step.to - before), s = deviator(trial);
    const double trial_eq = std::sqrt(1.5 * s.dot(s));
    creep = before;
    history[6] = step.history[6];
    if (trial_eq == 0.0) return {.stress = trial, .tangent = C};

    double eq = trial_eq, slope = 1.0;
    for (int i = 0; i < 50; ++i) {
      slope = 1.0 + 3.0 * mu * dt * A * m * std::pow(eq, m - 1.0);
      const double miss = trial_eq - eq - 3.0 * mu * dt * A * std::pow(eq, m);
      eq += miss / slope;
      if (std::abs(miss) < 1e-12 * trial_eq) break;
    }
    const double strain = dt * A * std::pow(eq, m);  // equivalent, of the step
    const Mandel n = s * (1.5 / trial_eq);
    creep += strain * n;
    history[6] += eq * strain;
    const MandelMatrix along = n * n.transpose() / 1.5;  // n:n = 3/2
    const MandelMatrix softer = (1.0 - eq / trial_eq) * (deviatoric_projector() - along) + (1.0 - 1.0 / slope) * along;
    return {.stress = trial - 2.0 * mu * strain * n, .tangent = C - 2.0 * mu * softer};
  }

  Inelastic inelastic(std::span<const double> history) const override {
    return {.strain = Eigen::Map<const Mandel>(history.data()), .dissipated = history[6]};
  }
};

Mesh bar() {
  BoxHexesSettings box;
  box.axes = {std::vector{AxisBlock{.length = length, .n = 4}}, std::vector{AxisBlock{.length = 0.5 * width, .n = 2}},
              std::vector{AxisBlock{.length = 0.5 * width, .n = 2}}};
  return make_box_hexes(box);
}

FractureModel model() {
  const IsotropicElasticity elasticity = from_young_poisson(E, nu);
  FractureModel made;
  made.regions = {RegionModel{
      .elasticity = elasticity, .damageable = false, .material = std::make_shared<NortonCreep>(elasticity)}};
  made.crack = &crack_geometry("AT2");
  made.degradation = degradation("quadratic");
  made.split = energy_split("none");
  for (const char* side : {"xmin", "ymin", "zmin"})
    made.boundary.push_back({.patch = side, .kind = BoundaryCondition::Kind::symmetry});
  made.boundary.push_back(
      {.patch = "xmax", .displacement_prescribed = {true, false, false}, .value = [](const Vector&, double t) {
         return Vector(stretch * length * std::min(t / 1e-6, 1.0), 0.0, 0.0);
       }});
  return made;
}

}  // namespace

int main() {
  const Mesh mesh = bar();
  // The load parameter t is the time over `hold`; increments grow from that of the stretching, 1e-6, to 0.2 s.
  LoadingSettings loading{.initial_increment = 1e-6,
                          .minimum_increment = 1e-9,
                          .maximum_increment = 2e-4,
                          .duration = hold,
                          .is_proportional = false};
  FractureRun run(mesh, model(), {}, loading);
  const auto end = mesh.patch_index("xmax");

  FractureState state = run.initial_state();
  double error = 0.0;
  while (!run.is_complete(state)) {
    const StepReport report = run.step(state);
    const double stress = report.reaction[end].x() / (0.25 * width * width);
    const double expected =
        std::pow(std::pow(E * stretch, 1.0 - m) + (m - 1.0) * E * A * hold * report.load, 1.0 / (1.0 - m));
    error = std::max(error, std::abs(stress / expected - 1.0));
    if (report.step % 1000 == 0)
      std::printf("%7.2f s: %7.3f MPa, expected %7.3f MPa\n", hold * report.load, 1e-6 * stress, 1e-6 * expected);
  }
  std::printf("largest difference %.2f %%\n", 100.0 * error);
  return error < 0.01 ? 0 : 1;
}
