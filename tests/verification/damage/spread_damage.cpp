// Uniform bodies that soften everywhere: in equilibrium, and unstable if they are long. A bar of AT1 under prescribed
// displacement keeps its uniform damage up to a length of some ell (Pham, Amor, Marigo, Maurini, Int. J. Damage Mech.
// 20 (2011) 618).

#include "physics/closed_forms/bars.h"
#include "solver/fracture/model/toughness_perturbation.h"

#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace pfdm::verification::this_file {
namespace {

constexpr double E = 30e9, Gc = 100.0, ell = 2e-3, h = ell / 4.0;

struct Pulled {
  Index n_warnings = 0;
  double least_damage = 1.0, most_damage = 0.0;
};

// A plate of n_x x n_y cells, pulled along x to 1.3 times the strain at its strength, or held and cooled so far.
Pulled pull(const std::string& law, Index n_x, Index n_y, double perturbation = 0.0, bool is_cooled = false) {
  BoxHexesSettings settings;
  settings.axes = {{{{double(n_x) * h, n_x, 1.0}}, {{double(n_y) * h, n_y, 1.0}}, {{h, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  FractureModel model;
  model.regions = {{.elasticity = from_young_poisson(E, 0.0), .Gc = Gc, .ell = ell}};
  model.crack = &crack_geometry(law);
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  const double strength = law == "AT1" ? at1_strength(E, Gc, ell) : (16.0 / 9.0) * at2_strength(E, Gc, ell);
  const double elongation = 1.3 * strength / E * double(n_x) * h;
  model.boundary = {
      symmetry_on("xmin"), symmetry_on("ymin"), plane_on("zmin"), plane_on("zmax"),
      moved("xmax", {true, false, false}, [=](const Vector&, double t) { return Vector(elongation * t, 0.0, 0.0); })};
  if (is_cooled) {
    model.boundary.back().value = nullptr;
    const double strain = elongation / (double(n_x) * h);
    model.regions[0].eigenstrain = std::make_shared<const LoadField<Tensor>>(
        [=](const Vector&, double t) -> Tensor { return Vector(-strain * t, 0.0, 0.0).asDiagonal(); });
  }
  if (perturbation > 0.0) perturb_toughness(mesh, perturbation, 1, model);
  LoadingSettings loading;
  loading.maximum_increment = 0.05;
  FractureRun run(mesh, model, {}, loading);
  Pulled pulled;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
    for (const std::string& remark : report.remarks)
      if (remark.find("unstable") != std::string::npos) ++pulled.n_warnings;
  });
  pulled.least_damage = *std::min_element(end.damage.begin(), end.damage.end());
  pulled.most_damage = *std::max_element(end.damage.begin(), end.damage.end());
  return pulled;
}

TEST(SpreadDamage, IsNamedOnceInLongBodies) {
  for (const std::string law : {"AT1", "AT2"})
    for (const auto& [n_x, n_y] : {std::pair<Index, Index>{100, 1}, {60, 20}}) {
      const Pulled pulled = pull(law, n_x, n_y);
      EXPECT_EQ(pulled.n_warnings, 1) << law << ", " << n_y;
      EXPECT_NEAR(pulled.least_damage, pulled.most_damage, 1e-3) << law;
    }
}

// Between clamps it shrinks as the other is pulled. Its energy counted the eigenstrains twice, and was not compared.
TEST(SpreadDamage, IsNamedInBodiesThatCool) {
  for (const std::string law : {"AT1", "AT2"}) {
    const Pulled pulled = pull(law, 100, 1), cooled = pull(law, 100, 1, 0.0, true);
    EXPECT_EQ(cooled.n_warnings, 1) << law;
    EXPECT_NEAR(cooled.most_damage, pulled.most_damage, 1e-6) << law;
    EXPECT_EQ(pull(law, 2, 2, 0.0, true).n_warnings, 0) << law;
  }
}

// In a body of half an ell uniform damage is stable.
TEST(SpreadDamage, IsRightInShortBodies) {
  for (const std::string law : {"AT1", "AT2"}) EXPECT_EQ(pull(law, 2, 2).n_warnings, 0) << law;
}

TEST(SpreadDamage, GathersInAPerturbedBody) {
  for (const std::string law : {"AT1", "AT2"}) {
    const Pulled pulled = pull(law, 100, 4, 0.01);
    EXPECT_EQ(pulled.n_warnings, 0) << law;
    EXPECT_GT(pulled.most_damage, 0.98) << law;
    EXPECT_LT(pulled.least_damage, 0.5) << law;
  }
}

TEST(ToughnessPerturbation, IsSmallAndOfItsSeed) {
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, 20, 1.0}}, {{1.0, 20, 1.0}}, {{1.0, 5, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  const auto perturbed = [&](std::uint64_t seed) {
    FractureModel model;
    model.regions = {{.elasticity = {}, .Gc = Gc, .ell = ell}};
    perturb_toughness(mesh, 0.1, seed, model);
    return model;
  };
  const FractureModel one = perturbed(1), again = perturbed(1), other = perturbed(2);
  double mean = 0.0, square = 0.0;
  Index same = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double part = one.cells[c].Gc / Gc - 1.0;
    EXPECT_LE(std::abs(part), 0.1);
    EXPECT_EQ(one.cells[c].Gc, again.cells[c].Gc);
    if (one.cells[c].Gc == other.cells[c].Gc) ++same;
    mean += part / mesh.n_cells();
    square += part * part / mesh.n_cells();
  }
  EXPECT_EQ(same, 0);
  EXPECT_NEAR(mean, 0.0, 0.01);
  EXPECT_NEAR(square, 0.01 / 3.0, 3e-4);
}

}  // namespace
}  // namespace pfdm::verification::this_file
