// Bodies of viscoelastic rubber at finite strain (physics/materials/viscous_branches.h): a bar against its equation,
// bonded pads against the elastic ones that they relax to, a bonded disc against the Prony series of small strain.

#include "mesh/dual.h"
#include "tests/verification/finite.h"
#include "tests/verification/histories/held_discs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

using namespace discs;

const std::vector<PronyBranch> branches{{.modulus = 2.0 * mu, .time = 1.0}, {.modulus = 0.5 * mu, .time = 0.2}};

std::shared_ptr<const Material> viscous(double poisson, const std::vector<PronyBranch>& by = branches) {
  return make_hyperelastic("neo_hookean",
                           {.elasticity = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson), .branches = by});
}

// --- A bar under uniaxial stress -------------------------------------------------------------------------------------

constexpr double pulling = 3.0;                                                         // [s]
double stretch_at(double t) { return 1.0 + std::sin(std::numbers::pi * t / pulling); }  // to twice the length and back

// The bar's equation, P_b = 0 of the lateral stretch b, with the viscous strains v of its branches:
// P = l - 1/l + L (J - 1) J/l + sum m (l/v - J^(2/3)/l), over mu.
struct BarEquation {
  struct Viscous {
    double along = 1.0, across = 1.0;
  };
  using All = std::vector<Viscous>;
  double L;

  explicit BarEquation(double poisson) : L(2.0 * poisson / (1.0 - 2.0 * poisson)) {}

  double stress(double a, double b, const All& v, bool of_a) const {
    const double J = a * b * b, l = of_a ? a : b;
    double P = l - 1.0 / l + L * (J - 1.0) * J / l;
    for (std::size_t i = 0; i < branches.size(); ++i)
      P += branches[i].modulus / mu * (l / (of_a ? v[i].along : v[i].across) - std::pow(J, 2.0 / 3.0) / l);
    return P;
  }
  double lateral(double a, const All& v) const {  // by Newton's method
    double b = 1.0 / std::sqrt(a);
    for (int k = 0; k < 50; ++k) {
      constexpr double step = 1e-7;
      const double slope = (stress(a, b + step, v, false) - stress(a, b - step, v, false)) / (2.0 * step);
      b -= stress(a, b, v, false) / slope;
    }
    return b;
  }
  double nominal_stress(double t, const All& v) const {
    const double a = stretch_at(t);
    return stress(a, lateral(a, v), v, true);
  }
  All rate(double t, const All& v) const {
    const double a = stretch_at(t), b = lateral(a, v), size = std::pow(a * b * b, -2.0 / 3.0);
    All rates;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double r = size * (a * a / v[i].along + 2.0 * b * b / v[i].across) / 3.0;
      rates.push_back(
          {(size * a * a - r * v[i].along) / branches[i].time, (size * b * b - r * v[i].across) / branches[i].time});
    }
    return rates;
  }
};

BarEquation::All moved_by(const BarEquation::All& v, double dt, const BarEquation::All& rate) {
  BarEquation::All moved = v;
  for (std::size_t i = 0; i < v.size(); ++i)
    moved[i].along += dt * rate[i].along, moved[i].across += dt * rate[i].across;
  return moved;
}

// Nominal stresses over mu at the times k pulling/n, by Heun's method.
std::vector<double> bar_by_equation(double poisson, int n, int substeps) {
  const BarEquation bar(poisson);
  BarEquation::All v(branches.size());
  std::vector<double> stresses{0.0};
  const double dt = pulling / (double(n) * substeps);
  for (int k = 0; k < n * substeps; ++k) {
    const auto first = bar.rate(k * dt, v), second = bar.rate((k + 1) * dt, moved_by(v, dt, first));
    v = moved_by(moved_by(v, 0.5 * dt, first), 0.5 * dt, second);
    if ((k + 1) % substeps == 0) stresses.push_back(bar.nominal_stress((k + 1) * dt, v));
  }
  return stresses;
}

// Largest difference of the nominal stress over the instantaneous modulus.
double bar_error(double poisson, int steps, double* account = nullptr) {
  const Mesh mesh = mapped_box({2, 1, 1}, [](const Vector& s) -> Vector { return s; });
  const FractureModel model = finite_body(mesh, viscous(poisson),
                                          {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
                                           moved("xmax", {true, false, false}, [](const Vector&, double t) -> Vector {
                                             return (stretch_at(pulling * t) - 1.0) * Vector::UnitX();
                                           })});
  const std::vector<double> due = bar_by_equation(poisson, steps, 40);
  FractureRun run(mesh, model, closely,
                  {.initial_increment = 1.0 / steps,
                   .maximum_increment = 1.0 / steps,
                   .duration = pulling,
                   .stops = {},
                   .is_proportional = false});
  double worst = 0.0, most = 0.0, left = 0.0;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    const double stress = report.reaction[mesh.patch_index("xmax")].x() / mu;
    worst = std::max(worst, std::abs(stress - due.at(static_cast<std::size_t>(report.step))));
    most = std::max(most, report.energy.external_work);
    left = left_over({}, report.energy);
  });
  if (account != nullptr) *account = left / most;
  return worst / 3.5;
}

TEST(ViscousRubber, ABarFollowsItsEquation) {
  for (const double poisson : {0.3, 0.46, 0.499}) {
    double account = 0.0;
    const double coarse = bar_error(poisson, 20), fine = bar_error(poisson, 40, &account);
    report_row(fmt::format("viscous bar, nu {}", poisson), {{"20 steps", coarse}, {"40", fine}, {"account", account}});
    EXPECT_LT(fine, 1e-3);
    EXPECT_NEAR(coarse / fine, 4.0, 0.8);
    EXPECT_LT(std::abs(account), 2e-3);
  }
}

// --- Bonded pads ----------------------------------------------------------------------------------------------------

struct Pad {
  const char* cells;
  Mesh mesh;
};

std::vector<Pad> pads() {
  const auto flat = [](const Vector& s) -> Vector { return {s[0], s[1], s[2] / 3.0}; };
  return {{.cells = "hexahedra", .mesh = mapped_box({6, 6, 4}, flat)},
          {.cells = "prisms", .mesh = extruded_triangles(5, {0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25, 1.0 / 3.0})},
          {.cells = "tetrahedra", .mesh = mapped_box({4, 4, 2}, flat, BoxCells::tetrahedra)},
          {.cells = "polyhedra", .mesh = barycentric_dual(mapped_box({3, 3, 2}, flat, BoxCells::tetrahedra))}};
}

// Pads are compressed by 8 % and sheared by 30 % of their height within a second, and then held [s].
constexpr double moving = 1.0;
FractureModel pad_model(const Mesh& mesh, const std::shared_ptr<const Material>& material, double duration) {
  return finite_body(mesh, material,
                     {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                      moved("zmax", {true, true, true}, [duration](const Vector&, double t) -> Vector {
                        return std::min(t * duration / moving, 1.0) / 3.0 * Vector(0.3, 0.0, -0.08);
                      })});
}

Vector pad_force(const Mesh& mesh, const std::shared_ptr<const Material>& material, double duration, double step) {
  FractureRun run(mesh, pad_model(mesh, material, duration), closely,
                  {.initial_increment = 0.1 * moving / duration,
                   .maximum_increment = step / duration,
                   .duration = duration,
                   .stops = {moving / duration},
                   .is_proportional = false});
  Vector force = Vector::Zero();
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    force = report.reaction[mesh.patch_index("zmax")] / mu;
  });
  return force;
}

// Between nu = 0.4 and 0.47 only the viscoelastic cells have a pressure: there the elastic pads have other errors, and
// the relaxed ones are of the same material, whose branches relax within any step.
TEST(ViscousRubber, PadsRelaxToTheElasticOnes) {
  constexpr double held_for = 30.0;
  for (const double poisson : {0.3, 0.46, 0.4997})
    for (const Pad& pad : pads()) {
      const Vector held = pad_force(pad.mesh, viscous(poisson), held_for, 1.0);
      std::vector<PronyBranch> quick = branches;
      for (PronyBranch& branch : quick) branch.time *= 1e-9;
      const Vector slow = pad_force(pad.mesh, viscous(poisson, quick), held_for, held_for);
      const Vector due = pad_force(pad.mesh, viscous(poisson, {}), held_for, held_for);
      report_row(fmt::format("viscous pad of {} {}, nu {}", pad.mesh.n_cells(), pad.cells, poisson),
                 {{"from the elastic one", (held - due).norm() / due.norm()},
                  {"shear", held.x()},
                  {"elastic", due.x()},
                  {"pressure", held.z()},
                  {"elastic", due.z()}});
      EXPECT_LT((held - slow).norm(), 1e-3 * due.norm());
      const double bound = poisson == 0.46 ? 1.0 : 1e-3;
      EXPECT_LT((held - due).norm(), bound * due.norm());
    }
}

// --- A bonded disc at small strain -----------------------------------------------------------------------------------

TEST(ViscousRubber, ADiscAtSmallStrainIsThatOfAPronySeries) {
  constexpr double duration = 3.0, ends = 1e-3;  // of the load, by which it is pulled
  const Mesh mesh = disc(20, 4);
  for (const double poisson : {0.46, 0.4997}) {
    const IsotropicElasticity relaxed = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson);
    const auto moduli = [&](const RegionModel& region, double elastic_limit) {
      FractureRun run(mesh, disc_model(region, [=](double t) { return elastic_limit * std::min(t / ends, 1.0); }),
                      closely,
                      {.initial_increment = ends,
                       .minimum_increment = 1e-12,
                       .maximum_increment = 0.05,
                       .duration = duration,
                       .stops = {ends},
                       .is_proportional = false});
      std::vector<double> found;
      run_to_end(run, [&](const FractureState&, const StepReport& report) {
        if (report.step > 0) found.push_back(pulled(mesh, report).modulus / elastic_limit);
      });
      return found;
    };
    RegionModel of_finite;
    of_finite.material = viscous(poisson);
    of_finite.elasticity = relaxed;
    const auto small = moduli(relaxing_region({.relaxed = relaxed, .shear = branches}), 1.0);
    const auto finite = moduli(of_finite, 0.01);
    ASSERT_EQ(small.size(), finite.size());
    double worst = 0.0;
    for (std::size_t k = 0; k < small.size(); ++k) worst = std::max(worst, std::abs(finite[k] / small[k] - 1.0));
    report_row(fmt::format("disc at small strain, nu {}", poisson), {{"at once", finite.front()},
                                                                     {"small strain", small.front()},
                                                                     {"held", finite.back()},
                                                                     {"small strain", small.back()},
                                                                     {"largest difference", worst}});
    EXPECT_LT(worst, 0.005);
  }
}

// --- A state is a value ----------------------------------------------------------------------------------------------

TEST(ViscousRubber, GoesOnFromAnyStateToTheSameBits) {
  const Mesh mesh = pads()[1].mesh;
  const FractureModel model = pad_model(mesh, viscous(0.4997), 2.0);
  const LoadingSettings loading{
      .initial_increment = 0.1, .maximum_increment = 0.1, .duration = 2.0, .stops = {0.5}, .is_proportional = false};
  FractureRun run(mesh, model, closely, loading);
  FractureState half;
  const FractureState whole = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.step == 6) half = state;
    if (report.step == 7) run.output(state);  // looking at a state changes nothing
  });
  FractureRun again(mesh, model, closely, loading);
  const FractureState resumed = advance_to_end(again, half, [](const FractureState&, const StepReport&) {});
  EXPECT_EQ(resumed.displacement, whole.displacement);
  EXPECT_EQ(resumed.histories, whole.histories);
}

}  // namespace
}  // namespace pfdm::verification::this_file
