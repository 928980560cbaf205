// The strength model at finite strain: one cell under 100 directions of Biot stress, a cell that softens at small
// strain beside the model of small strain, and a bar.

#include "tests/verification/finite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace pfdm::verification::this_file {
namespace {

// Polyurethane of Kamarei, Zeng, Dolbow, Lopez-Pamies, CMAME 448 (2026) 118449.
constexpr double mu = 0.52e6, Lambda = 85.77e6, Gc = 41.0, ts = 0.3e6, hs = 1e6;
constexpr double W_ts = 37308.952475628, W_hs = 5718.4529965;  // [J/m^3], by SciPy
constexpr double largest_ell = 3.0 * Gc / (16.0 * W_ts);       // [m]
const IsotropicElasticity polyurethane{.lambda = Lambda, .mu = mu};

// The strengths times `scale`, Gc times its square: the same at small strain but for the size of the strains.
FractureModel strength_model(const IsotropicElasticity& elasticity, double ell, std::vector<BoundaryCondition> boundary,
                             double scale = 1.0, bool is_finite = true) {
  FractureModel model = elastic_model({elasticity}, std::move(boundary));
  const auto material =
      is_finite ? make_hyperelastic("neo_hookean", {.elasticity = elasticity}) : std::shared_ptr<const Material>();
  const StrengthLaw& law = strength_law("strength");
  const StrengthData data{.elasticity = elasticity,
                          .tensile = scale * ts,
                          .hydrostatic = scale * hs,
                          .Gc = scale * scale * Gc,
                          .ell = ell,
                          .material = material};
  model.regions = {{.elasticity = elasticity,
                    .Gc = data.Gc,
                    .ell = ell,
                    .strength = {law, data, law.delta(data, 0.0)},
                    .material = material}};
  model.crack = &crack_geometry("AT1");
  return model;
}

Mesh one_cell() {
  return make_box_hexes({.axes = {{{{1e-6, 1, 1.0}}, {{1e-6, 1, 1.0}}, {{1e-6, 1, 1.0}}}}, .regions = {}, .slits = {}});
}

// By hand: principal Biot stress, energy, and what drives damage in a sound cell less what resists it.
Vector forces(const Vector& l) {
  const double J = l.prod();
  return mu * (l - l.cwiseInverse()) + Lambda * (J - 1.0) * J * l.cwiseInverse();
}
double energy(const Vector& l) {
  const double J = l.prod();
  return 0.5 * mu * (l.squaredNorm() - 3.0) - mu * std::log(J) + 0.5 * Lambda * (J - 1.0) * (J - 1.0);
}
double sqrt_J2(const Vector& t) { return std::sqrt(0.5 * (t.array() - t.mean()).square().sum()); }
double excess(const Vector& l, double ell) {
  const double bracket = (ts + (1.0 + 2.0 * std::sqrt(3.0)) * hs) / ((8.0 + 3.0 * std::sqrt(3.0)) * hs);
  const double delta = bracket * largest_ell / ell + 0.375, surface = delta * Gc / (8.0 * ell);
  const double by_trace = surface / hs - 2.0 * W_hs / (3.0 * hs);
  const double by_shear = std::sqrt(3.0) * (3.0 * hs - ts) / (hs * ts) * surface + 2.0 * W_hs / (std::sqrt(3.0) * hs) -
                          2.0 * std::sqrt(3.0) * W_ts / ts;
  const Vector t = forces(l);
  return (t.sum() >= 0.0 ? 2.0 * energy(l) : 0.0) + by_shear * sqrt_J2(t) + by_trace * t.sum() - 3.0 * surface;
}

// Stretches at these principal Biot stresses, from others nearby.
std::optional<Vector> stretches(const Vector& t, Vector l) {
  for (int k = 0; k < 50; ++k) {
    const Vector missing = t - forces(l);
    if (missing.norm() < 1e-9 * ts) return l;
    const double J = l.prod();
    Tensor slope = Lambda * J * (2.0 * J - 1.0) * l.cwiseInverse() * l.cwiseInverse().transpose();
    for (Index i = 0; i < 3; ++i)
      slope(i, i) += mu * (1.0 + 1.0 / (l[i] * l[i])) - Lambda * (J - 1.0) * J / (l[i] * l[i]);
    l += slope.fullPivLu().solve(missing);
    if (!(l.minCoeff() > 0.05 && l.maxCoeff() < 20.0)) return std::nullopt;
  }
  return std::nullopt;
}

// Where a sound cell begins to break on the way from no stress along this direction.
struct Breaking {
  Vector before, after;  // stretches, at stresses 0.1 % below and above
  double over_surface;   // stress over that of Drucker and Prager
};
std::optional<Breaking> breaking(const Vector& along, double ell) {
  constexpr double step = 0.01 * ts;
  double low = 0.0;
  Vector l = Vector::Ones();
  const auto at = [&](double size) { return stretches(size * along, l); };
  for (;; low += step) {
    const auto next = at(low + step);
    if (!next || low > 10.0 * ts) return std::nullopt;
    if (excess(*next, ell) > 0.0) break;
    l = *next;
  }
  double high = low + step;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const auto there = at(middle);
    if (!there) return std::nullopt;
    (excess(*there, ell) < 0.0 ? low : high) = middle;
  }
  const auto before = at(0.999 * low), after = at(1.001 * low);
  if (!before || !after) return std::nullopt;
  const double surface = (3.0 * hs - ts) * sqrt_J2(along) + ts / std::sqrt(3.0) * along.sum();
  return Breaking{*before, *after, low * surface / (std::sqrt(3.0) * ts * hs)};
}

// Largest damage after a step to these principal stretches, turned.
double damage_at(const Mesh& mesh, double ell, const Vector& l) {
  const Tensor turn = arbitrary_rotation(), R = Eigen::AngleAxisd(0.4, Vector::UnitZ()).toRotationMatrix();
  const Tensor H = R * turn * l.asDiagonal() * turn.transpose() - Tensor::Identity();
  FractureRun run(
      mesh,
      strength_model(polyurethane, ell, displacement_on_all(mesh, [&](const Vector& x) -> Vector { return H * x; })),
      {}, {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  FractureState state = run.initial_state();
  return run.step(state).max_damage;
}

// Sound 0.1 % below the model's surface in Biot stress, damaged 0.1 % above it; and how far that is from Drucker and
// Prager's.
TEST(FiniteStrength, OneCellBreaksOnTheSurfaceInEveryDirection) {
  const Mesh mesh = one_cell();
  double coarser = 0.0;
  for (const double ell : {50e-6, 25e-6, 12.5e-6}) {
    double in_tension = 0.0, in_all = 0.0;
    int n_met = 0;
    for (int i = 0; i < 200; ++i) {
      const double z = -1.0 + (i + 0.5) / 100.0, angle = 2.399963 * i, r = std::sqrt(1.0 - z * z);
      const Vector along(r * std::cos(angle), r * std::sin(angle), z);
      if (along.sum() < 0.0) continue;
      const auto at = breaking(along, ell);
      if (!at) continue;
      ++n_met;
      if (i % (ell == 50e-6 ? 1 : 10) == 0) {
        EXPECT_EQ(damage_at(mesh, ell, at->before), 0.0) << i;
        EXPECT_GT(damage_at(mesh, ell, at->after), 0.0) << i;
      }
      in_all = std::max(in_all, std::abs(at->over_surface - 1.0));
      if (along.minCoeff() >= 0.0) in_tension = std::max(in_tension, std::abs(at->over_surface - 1.0));
    }
    report_row("directions of Biot stress", {{"ell", ell},
                                             {"met, of 200", double(n_met)},
                                             {"distance from Drucker-Prager, tension", in_tension},
                                             {"trace >= 0", in_all}});
    EXPECT_GT(n_met, 60);
    if (coarser > 0.0) {
      EXPECT_LT(in_all, 0.4 * coarser);
      EXPECT_LT(in_tension, 0.02);
    }
    coarser = in_all;
  }
  EXPECT_LT(coarser, 0.006);  // as of glass
}

// Damage of a cell that is stretched along its axes to these stretches at load 1.
double softened(const std::function<FractureModel(std::vector<BoundaryCondition>)>& model, const Vector& strain) {
  const Mesh mesh = one_cell();
  std::vector<BoundaryCondition> stretched;
  for (const Patch& patch : mesh.patches)
    stretched.push_back(moved(patch.name, {true, true, true},
                              [&](const Vector& x, double t) -> Vector { return t * strain.cwiseProduct(x); }));
  FractureRun run(mesh, model(stretched), {.damage_tolerance = 1e-10, .energy_tolerance = 1e-10},
                  {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
  double damage = 0.0;
  run_to_end(run, [&](const FractureState&, const StepReport& report) { damage = report.max_damage; });
  return damage;
}

// At strains of 1e-7 both models are one; strengths scaled, and Gc by the square.
TEST(FiniteStrength, IsThatOfSmallStrainAtSmallStrain) {
  constexpr double scale = 5e-7;
  const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.45);  // without a pressure
  const double strain = 1.2 * scale * ts / rubber.young_modulus();
  const auto damage = [&](bool is_finite) {
    return softened(
        [&](std::vector<BoundaryCondition> boundary) {
          return strength_model(rubber, 50e-6, std::move(boundary), scale, is_finite);
        },
        Vector(strain, -0.45 * strain, -0.45 * strain));
  };
  const double finite = damage(true), small = damage(false);
  report_row("small strain",
             {{"strain", strain}, {"damage", small}, {"of finite strain, less 1", finite / small - 1.0}});
  EXPECT_GT(small, 0.01);
  EXPECT_LT(small, 0.9);
  EXPECT_NEAR(finite / small, 1.0, 1e-6);
}

// Half of a bar of 1 mm, 50 cells, two of them beside each other across; the first 40 um are 1 % weaker.
FractureRun bar_in_tension(const Mesh& mesh) {
  std::vector<BoundaryCondition> boundary{moved(
      "xmax", {true, false, false}, [](const Vector&, double t) -> Vector { return 0.13e-3 * t * Vector::UnitX(); })};
  for (const char* patch : {"xmin", "ymin", "zmin"}) boundary.push_back(symmetry_on(patch));
  FractureModel model = strength_model(polyurethane, 80e-6, std::move(boundary));
  model.cells = CellField<RegionModel>(mesh.n_cells(), model.regions[0]);
  StrengthData weak = model.regions[0].strength.data();
  weak.tensile *= 0.99, weak.hydrostatic *= 0.99;
  const StrengthLaw& law = strength_law("strength");
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() < 40e-6) model.cells[c].strength = {law, weak, law.delta(weak, 0.0)};
  return {mesh, model, {}, {.energy_release = 0.02, .finest_increment = 5e-3, .stops = {}}};
}

TEST(FiniteStrength, ABarBreaksAtItsStrength) {
  const Mesh mesh =
      make_box_hexes({.axes = {{{{0.5e-3, 25, 1.0}}, {{1e-3, 2, 1.0}}, {{1e-3, 1, 1.0}}}}, .regions = {}, .slits = {}});
  FractureRun run = bar_in_tension(mesh);
  double peak = 0.0, at_peak = 0.0, last = 0.0;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    last = report.reaction[mesh.patch_index("xmax")].x() / 1e-6;
    if (last > peak) peak = last, at_peak = 1.0 + 0.13e-3 * state.load / 0.5e-3;
  });
  report_row(
      "bar",
      {{"peak over strength", peak / ts}, {"stretch there", at_peak}, {"force at the end over peak", last / peak}});
  EXPECT_NEAR(peak / ts, 1.0, 0.01);
  EXPECT_NEAR(at_peak, 1.2342, 0.005);
  EXPECT_LT(last, 0.95 * peak);
}

}  // namespace
}  // namespace pfdm::verification::this_file
