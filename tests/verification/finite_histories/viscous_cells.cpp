// Cells of viscoelastic rubber: what drives their damage, their heat as they swell or break, laws whose shear part has
// a stiffness against changes of volume.

#include "physics/error.h"
#include "solver/fracture/cells/degraded_heat.h"
#include "tests/verification/finite.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double mu = 1e6;

std::shared_ptr<const Material> rubber(double poisson, double branch, double second_invariant = 0.0) {
  HyperelasticParameters p{.elasticity = from_young_poisson(2.0 * mu * (1.0 + poisson), poisson),
                           .second_invariant = second_invariant};
  if (branch > 0.0) p.branches = {{.modulus = branch * mu, .time = 1.0}};
  return make_hyperelastic(second_invariant > 0.0 ? "mooney_rivlin" : "neo_hookean", p);
}

Mesh cube(Index n) {
  return mapped_box({n, n, n}, [](const Vector& s) -> Vector { return s; });
}

BoundaryCondition moved_by(const std::string& patch, int axis, const std::function<double(double)>& u) {
  std::array<bool, 3> components{};
  components[static_cast<std::size_t>(axis)] = true;
  return moved(patch, components, [=](const Vector&, double t) -> Vector { return u(t) * Vector::Unit(axis); });
}

// Stretched alike along all axes branches bear nothing, and their energy at rest is that of the elastic cube: damage
// begins at the same load, at any rate.
TEST(ViscousCells, ADilatedCubeBeginsToBreakAsTheElasticOne) {
  const Mesh mesh = cube(2);
  const auto begins = [&](double branch, double duration) {
    std::vector<BoundaryCondition> boundary{symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")};
    for (int axis = 0; axis < 3; ++axis)
      boundary.push_back(moved_by(std::string(1, "xyz"[axis]) + "max", axis, [](double t) { return 2e-3 * t; }));
    FractureModel model = finite_body(mesh, rubber(0.4995, branch), boundary);
    model.crack = &crack_geometry("AT1");
    model.degradation = degradation("quadratic");
    model.split = energy_split("none");
    model.regions[0].damageable = true;
    model.regions[0].Gc = 0.02 * mu;
    model.regions[0].ell = 2.0;
    FractureRun run(mesh, model, {},
                    {.initial_increment = 0.02, .maximum_increment = 0.02, .duration = duration, .stops = {}});
    double sound = 0.0;
    FractureState state = run.initial_state();
    while (!run.is_complete(state)) {
      const StepReport report = run.step(state);
      if (report.max_damage > 0.0) break;
      sound = report.load;
    }
    return sound;
  };
  const double due = begins(0.0, 1.0);
  ASSERT_GT(due, 0.1);
  ASSERT_LT(due, 0.9);
  for (const double duration : {1e-4, 1.0, 1e5}) EXPECT_NEAR(begins(10.0, duration), due, 0.03) << duration;
}

// A block that has swollen or shrunk is stretched and let back: work, stored energy and heat are those of its volume.
TEST(ViscousCells, SwollenBlocksKeepTheirAccount) {
  const Mesh mesh = cube(2);
  for (const double swelling : {-0.1, 0.0, 0.2}) {
    FractureModel model = finite_body(
        mesh, rubber(0.3, 2.0),
        {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"), moved_by("xmax", 0, [=](double t) {
           return swelling * std::min(5.0 * t, 1.0) + 0.4 * std::sin(std::numbers::pi * std::max(t - 0.2, 0.0) / 0.8);
         })});
    const Tensor strain = swelling * Tensor::Identity();
    if (swelling != 0.0)
      model.regions[0].eigenstrain = std::make_shared<const LoadField<Tensor>>(
          [strain](const Vector&, double t) -> Tensor { return std::min(5.0 * t, 1.0) * strain; });
    FractureRun run(
        mesh, model, {.energy_tolerance = 1e-8, .equilibrium_tolerance = 1e-9},
        {.initial_increment = 0.01, .maximum_increment = 0.01, .duration = 3.0, .stops = {}, .is_proportional = false});
    StepReport last;
    run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
    const double left = left_over({}, last.energy) / last.energy.plastic_dissipation;
    report_row(fmt::format("block, swollen by {}", swelling),
               {{"heat", last.energy.plastic_dissipation}, {"left over it", left}});
    EXPECT_GT(last.energy.plastic_dissipation, 0.0);
    EXPECT_LT(std::abs(left), 2e-3);
  }
}

// The pressure keeps a modulus within any step, where the shear part has much of lambda; or the material is refused.
TEST(ViscousCells, PressuresKeepAModulusForLawsThatResistChangesOfVolume) {
  const Mesh mesh = cube(2);
  int n_run = 0, n_refused = 0;
  for (const double poisson : {0.405, 0.42, 0.45})
    for (const double branch : {0.5, 3.0, 20.0}) {
      std::shared_ptr<const Material> material;
      try {
        material = rubber(poisson, branch, 1.0);
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("Poisson's ratio"), std::string::npos);
        ++n_refused;
        continue;
      }
      ++n_run;
      const auto& law = dynamic_cast<const HyperelasticMaterial&>(*material);
      const double at_once = law.pressure_modulus() - (law.branch_ratio() + 2.0 / 3.0) * branch * mu;
      EXPECT_GE(at_once, 0.19 * material->elasticity().bulk_modulus()) << poisson << ' ' << branch;
      const FractureModel model =
          finite_body(mesh, material,
                      {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                       moved("xmax", {true, true, true},
                             [](const Vector&, double t) -> Vector { return t * Vector(0.2, 0.1, 0.0); })});
      FractureRun run(mesh, model, {},
                      {.initial_increment = 0.1, .maximum_increment = 0.1, .duration = 2.0, .stops = {}});
      EXPECT_NO_THROW(run_to_end(run, [](const FractureState&, const StepReport&) {})) << poisson << ' ' << branch;
    }
  EXPECT_GT(n_run, 0);
  EXPECT_GT(n_refused + n_run, 8);
}

struct Torn {
  std::vector<double> force, crack;
};

constexpr double toughness = 0.6 * mu;  // of sheets with a crack [J/m^2]

Torn tear(const Mesh& mesh, const std::shared_ptr<const Material>& material, double duration) {
  FractureModel model = finite_body(
      mesh, material,
      {moved("ymin", {true, true, true}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
       moved("ymax", {true, true, false}, [](const Vector&, double t) -> Vector { return 1.6 * t * Vector::UnitY(); }),
       plane_stress_on("zmin"), plane_stress_on("zmax")});
  model.crack = &crack_geometry("AT1");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  model.regions[0].damageable = true;
  model.regions[0].Gc = toughness;
  model.regions[0].ell = 2.0;
  model.initial_damage = CellField<double>(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() < 4.0 && std::abs(mesh.cell_centre[c].y() - 2.75) < 0.1) model.initial_damage[c] = 1.0;
  FractureRun run(mesh, model, {.damage_tolerance = 1e-5, .energy_tolerance = 1e-6},
                  {.initial_increment = 0.1, .maximum_increment = 0.1, .duration = duration, .stops = {}});
  Torn torn;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    torn.force.push_back(report.reaction[mesh.patch_index("ymax")].y());
    torn.crack.push_back(report.energy.fracture);
  });
  return torn;
}

// Torn in a time in which nothing relaxes it is the elastic sheet at the same stretches: damage is driven by the energy
// at rest, and the displacements are those of a sheet that is as much stiffer everywhere. Not quite: the pressure in
// damaged cells is greater, and its energy drives the damage whole.
TEST(ViscousCells, ASheetTornFastBreaksAtTheStretchesOfTheElasticOne) {
  constexpr double poisson = 0.4995;
  const Mesh mesh = make_box_hexes(
      {.axes = {{{{.length = 12.0, .n = 24}}, {{.length = 6.0, .n = 12}}, {{1.0, 1}}}}, .regions = {}, .slits = {}});
  const Torn elastic = tear(mesh, rubber(poisson, 0.0), 1.0), fast = tear(mesh, rubber(poisson, 2.0), 1e-6);
  ASSERT_EQ(fast.crack.size(), elastic.crack.size());
  const double begun = elastic.crack.front(), grown = elastic.crack.back() - begun;
  ASSERT_GT(grown, 0.02 * toughness * 6.0);
  for (std::size_t k = 1; k < fast.crack.size(); ++k) {
    const double due = elastic.crack[k] - begun;
    report_row(fmt::format("torn sheet, step {}", k), {{"force over the elastic one", fast.force[k] / elastic.force[k]},
                                                       {"crack", (fast.crack[k] - begun) / grown},
                                                       {"elastic", due / grown}});
    EXPECT_NEAR(fast.crack[k] - begun, due, 0.2 * due + 1e-3 * grown);
    if (due > 0.5 * grown) continue;  // torn: what pulls is the network of broken cells, which does not relax
    EXPECT_NEAR(fast.force[k], 3.0 * elastic.force[k], 0.02 * fast.force[k]);
  }
}

// - int W dg, W a power of g, by the closed form; small steps by the trapezoidal rule; no jump at an energy of zero.
TEST(DegradedHeat, IsThatOfAPowerOfTheStiffness) {
  for (const double power : {-0.3, -0.7, 0.5}) {
    const double g = 1e-3, due = (1.0 - std::pow(g, power + 1.0)) / (power + 1.0);
    EXPECT_NEAR(freed_energy(1.0, 1.0, g, std::pow(g, power)), due, 1e-12 * due);
  }
  EXPECT_NEAR(freed_energy(0.5, 2.0, 0.4999, 2.001), 1e-4 * 2.0005, 1e-11);
  EXPECT_EQ(freed_energy(0.5, 2.0, 0.5, 3.0), 0.0);
  EXPECT_EQ(freed_energy(1.0, 2.0, 0.0, 5.0), 2.0);
  EXPECT_EQ(freed_energy(1.0, 0.0, 0.5, 0.0), 0.0);
  EXPECT_NEAR(freed_energy(1.0, 0.0, 1e-9, 1e9), freed_energy(1.0, 1e-3, 1e-9, 1e9), 1e-9 * 1e9);
  EXPECT_LT(freed_energy(1.0, 0.0, 1e-9, 1e9), 1e5);
}

}  // namespace
}  // namespace pfdm::verification::this_file
