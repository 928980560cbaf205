// Boxes that are loaded by mean strains while phase field breaks their material, against the closed form of damage that
// is the same everywhere (AT2: Pham, Amor, Marigo, Maurini, Int. J. Damage Mech. 20 (2011) 618), and against the same
// body whose patches are displaced.

#include "tests/verification/box_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double E = 2e9, nu = 0.3, Gc = 100.0;

FractureModel breakable(const std::string& law, double ell, std::size_t n_regions = 1) {
  FractureModel model = elastic_model(std::vector<IsotropicElasticity>(n_regions, from_young_poisson(E, nu)), {});
  model.crack = &crack_geometry(law);
  for (RegionModel& region : model.regions) {
    region.Gc = Gc;
    region.ell = ell;
    region.damageable = true;
  }
  return model;
}

std::vector<StepReport> follow(FractureRun& run) {
  std::vector<StepReport> reports;
  run_to_end(run, [&](const FractureState&, const StepReport& report) { reports.push_back(report); });
  return reports;
}

StaggeredSettings tight() {
  return {
      .damage_tolerance = 1e-8, .energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-9, .maximum_iterations = 5000};
}

LoadingSettings in_steps(double n) {
  return {.initial_increment = 1.0 / n, .minimum_increment = 1e-4 / n, .maximum_increment = 1.0 / n, .stops = {}};
}

Mesh block(Index n, double length, Index n_long) {
  BoxHexesSettings settings;
  settings.axes = {{{{.length = 1e-3, .n = n}}, {{.length = 1e-3, .n = n}}, {{.length = length, .n = n_long}}}};
  return make_box_hexes(settings);
}

// ell is twice the box: the damage stays uniform, past the peak. Stress along z at the strain e and none along y, with
// strain along x held or free: sigma = g E' e, d = 2 (1 - k) psi / (Gc/ell + 2 (1 - k) psi), psi = E' e^2 / 2.
class UniformDamage : public testing::TestWithParam<const char*> {};

TEST_P(UniformDamage, FollowsTheClosedForm) {
  const double ell = 2e-3;
  for (const bool is_held : {false, true}) {
    const double modulus = is_held ? E / (1.0 - nu * nu) : E;
    const double end = 3.0 * std::sqrt(Gc / (3.0 * ell * modulus));  // three times the strain at the peak
    MeanPath path = strains({{2, {end}}});
    if (is_held) path.by_stress[0] = false;
    const Mesh mesh = block(2, 1e-3, 3);
    FractureModel model = breakable("AT2", ell);
    load(model, mesh, path, GetParam());
    FractureRun run(mesh, model, tight(), in_steps(12));
    double worst = 0.0, peak = 0.0, sideways = 0.0, damage = 0.0;
    for (const StepReport& report : follow(run)) {
      const double e = report.load * end, k = model.residual_stiffness;
      const double psi = 0.5 * modulus * e * e, d = 2.0 * (1.0 - k) * psi / (Gc / ell + 2.0 * (1.0 - k) * psi);
      const double due = ((1.0 - k) * (1.0 - d) * (1.0 - d) + k) * modulus * e;
      peak = std::max(peak, due);
      worst = std::max(worst, std::abs(report.means->stress(2, 2) - due));
      sideways = std::max(sideways, std::abs(report.means->stress(1, 1)));
      damage = std::max(damage, std::abs(report.max_damage - d));
    }
    report_row(GetParam(), {{"stress", worst / peak}, {"damage", damage}, {"stress sideways", sideways / peak}});
    EXPECT_LE(worst, 1e-6 * peak);
    EXPECT_LE(damage, 1e-6);
    EXPECT_LE(sideways, 1e-6 * peak);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, UniformDamage, testing::Values("periodic", "uniform displacement"),
                         [](const auto& input) { return std::string(input.param).substr(0, 7); });

// A band across a periodic box, in its weak middle, without strain sideways: that of a bar between its ends, whose
// sides are planes of symmetry.
TEST(BandAcrossABox, IsThatOfABarBetweenItsEnds) {
  const double ell = 1e-4, length = 1e-3, end = 1.3 * std::sqrt(3.0 * Gc / (8.0 * ell * E));
  Mesh mesh = block(2, length, 41);
  mesh.region_names.emplace_back("weak");
  for (Index c = 0; c < mesh.n_cells(); ++c) mesh.region[c] = std::abs(mesh.cell_centre[c].z() - 5e-4) < 1e-5 ? 1 : 0;
  FractureModel bar = breakable("AT1", ell, 2);
  bar.regions[1].Gc = 0.9 * Gc;
  FractureModel box = bar;
  MeanPath path{.points = {{0.0, 0.0, end, 0.0, 0.0, 0.0}}};
  load(box, mesh, path, "periodic");
  const auto at_end = [&](const Vector&, double t) -> Vector { return t * end * length * Vector::UnitZ(); };
  bar.boundary = {symmetry_on("xmin"), symmetry_on("xmax"), symmetry_on("ymin"),
                  symmetry_on("ymax"), symmetry_on("zmin"), moved("zmax", {false, false, true}, at_end)};
  FractureRun of_bar(mesh, bar, tight(), in_steps(20)), of_box(mesh, box, tight(), in_steps(20));
  const std::vector<StepReport> pulled = follow(of_bar), moved_box = follow(of_box);
  ASSERT_EQ(pulled.size(), moved_box.size());
  const auto zmax = mesh.patch_index("zmax");
  double peak = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < pulled.size(); ++i) {
    const double due = pulled[i].reaction[zmax].z() / 1e-6;
    peak = std::max(peak, due);
    worst = std::max(worst, std::abs(moved_box[i].means->stress(2, 2) - due));
  }
  const double released = moved_box.back().energy.fracture / (Gc * 1e-6);
  report_row("band", {{"stress", worst / peak},
                      {"last stress over peak", pulled.back().reaction[zmax].z() / 1e-6 / peak},
                      {"fracture energy over Gc", released}});
  EXPECT_LE(worst, 1e-5 * peak);
  EXPECT_NEAR(moved_box.back().energy.fracture, pulled.back().energy.fracture, 1e-5 * Gc * 1e-6);
  EXPECT_LE(pulled.back().reaction[zmax].z() / 1e-6, 0.01 * peak);
}

// A binder cracks around a stiff sphere: mean strains of the sides against displacements of the patches, which are the
// same problem; and the work is what is stored and broken, but for what a snap within a step leaves.
TEST(CrackedBinder, IsThatOfDisplacedPatches) {
  const Mesh mesh = sphere_in_cube(2, 1, 2.0, 0.6);
  const double ell = 0.4, end = 1.5 * std::sqrt(3.0 * Gc / (8.0 * ell * E));
  FractureModel by_patches = breakable("AT1", ell, mesh.region_names.size());
  RegionModel& bead = by_patches.regions[mesh.region_index("bead")];
  bead.elasticity = from_young_poisson(70e9, 0.22);
  bead.damageable = false;
  FractureModel by_strains = by_patches;
  load(by_strains, mesh, MeanPath{.points = {{0.0, 0.0, end, 0.0, 0.3 * end, 0.0}}}, "uniform displacement");
  Tensor strain = Tensor::Zero();
  strain(2, 2) = end;
  strain(0, 2) = strain(2, 0) = 0.3 * end;
  for (const Patch& patch : mesh.patches)
    by_patches.boundary.push_back(moved(patch.name, {true, true, true},
                                        [strain](const Vector& x, double t) -> Vector { return t * strain * x; }));
  FractureRun first(mesh, by_patches, tight(), in_steps(10)), second(mesh, by_strains, tight(), in_steps(10));
  const std::vector<StepReport> patches = follow(first), sides = follow(second);
  ASSERT_EQ(patches.size(), sides.size());
  double worst = 0.0, peak = 0.0, left = 0.0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    peak = std::max(peak, sides[i].means->stress(2, 2));
    const EnergyAccount &a = patches[i].energy, &b = sides[i].energy;
    worst = std::max({worst, std::abs(a.elastic - b.elastic), std::abs(a.fracture - b.fracture)});
    left = std::max(left, std::abs(b.external_work - b.elastic - b.fracture));
  }
  const EnergyAccount& last = sides.back().energy;
  const double size = last.external_work;
  report_row("sphere", {{"energies", worst / size},
                        {"largest damage", sides.back().max_damage},
                        {"last stress over peak", sides.back().means->stress(2, 2) / peak},
                        {"left over", left / size}});
  EXPECT_LE(worst, 1e-4 * size);
  EXPECT_LE(left, 0.03 * size);
  EXPECT_GE(sides.back().max_damage, 0.9);
}

}  // namespace
}  // namespace pfdm::verification::this_file
