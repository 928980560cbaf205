// Boxes that are loaded by mean strains and stresses while their interfaces debond, against springs in series, the
// effective stiffness of the same box by six load cases, and Mori and Tanaka's estimate for spheres (Hashin's and
// Shtrikman's bound, Walpole, J. Mech. Phys. Solids 14 (1966) 151).

#include "mesh/generators/packed_spheres.h"
#include "physics/elasticity/effective_stiffness.h"
#include "tests/verification/box_paths.h"
#include "tests/verification/cohesive_blocks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

constexpr const char* both_loadings[] = {"periodic", "uniform displacement"};

// Layers of these materials normal to z, of one millimetre in all.
Mesh layers(const std::vector<double>& thicknesses, Index n_sideways = 3) {
  BoxHexesSettings settings;
  settings.axes = {{{{.length = 0.6e-3, .n = n_sideways}}, {{.length = 0.8e-3, .n = n_sideways, .ratio = 1.5}}, {}}};
  for (const double thickness : thicknesses) settings.axes[2].push_back({.length = thickness, .n = 3});
  Mesh mesh = make_box_hexes(settings);
  mesh.region_names.clear();
  for (std::size_t i = 0; i < thicknesses.size(); ++i) mesh.region_names.push_back(fmt::format("layer_{}", i));
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    double z = mesh.cell_centre[c].z();
    Index layer = 0;
    while (z > thicknesses[layer]) z -= thicknesses[layer++];
    mesh.region[c] = layer;
  }
  return mesh;
}

// One plane normal to z between two halves of a periodic box that is free sideways (uniform displacements of the sides
// would hold its edges together): the strain of the box is the sum of the
// block's and of the plane's opening over the length, sigma/E + delta/L, in the rise, on the fall, on a way back to
// half the strain, on which the plane closes along its secant, and broken.
TEST(PartedBox, CohesivePlaneIsInSeriesWithTheBlock) {
  const double E = 50e6, nu = 0.4, length = 1e-3, ft = 1e5, Gc = 10.0, K = 1e11;
  const double at_peak = ft / K, at_end = 2.0 * Gc / ft;
  const auto secant = [&](double farthest) {
    return farthest <= at_peak ? K : ft * (at_end - farthest) / (at_end - at_peak) / farthest;
  };
  const auto strain_at = [&](double opening) { return secant(opening) * opening / E + opening / length; };
  const double far = 1e-4;  // [m] on the fall
  std::vector<double> strain{strain_at(0.6 * at_peak), strain_at(far), 0.5 * strain_at(far), strain_at(far),
                             1.1 * at_end / length};
  std::vector<double> stress{0.6 * ft, secant(far) * far, 0.5 * secant(far) * far, secant(far) * far, 0.0};
  const Mesh mesh = layers({0.5e-3, 0.5e-3});
  FractureModel model = elastic_model({from_young_poisson(E, nu), from_young_poisson(E, nu)}, {});
  glue(model, mesh, law_of(linear_law()), {.strength = ft, .toughness = Gc, .stiffness = K}, Vector::UnitZ(),
       [](const Vector& x) { return std::abs(x.z() - 0.5e-3) < 1e-9; });
  const MeanPath path = strains({{zz, strain}});
  load(model, mesh, path, "periodic");
  const std::vector<StepReport> reports = follow(mesh, model, path);
  ASSERT_EQ(reports.size(), strain.size() + 1);
  double worst = 0.0, sideways = 0.0, imbalance = 0.0;
  for (std::size_t i = 0; i < strain.size(); ++i) {
    const StepReport& report = reports[i + 1];
    EXPECT_NEAR(report.means->strain(2, 2), strain[i], 1e-12);
    worst = std::max(worst, std::abs(report.means->stress(2, 2) - stress[i]) / ft);
    sideways = std::max(sideways, std::abs(report.means->strain(0, 0) + nu * stress[i] / E));
    for (const auto& [r, c] : {std::pair(0, 0), std::pair(1, 1), std::pair(1, 2), std::pair(0, 1)})
      sideways = std::max(sideways, std::abs(report.means->stress(r, c)) / E);
  }
  const EnergyAccount& end = reports.back().energy;
  const double area = 0.6e-3 * 0.8e-3;
  imbalance = std::abs(end.interface_dissipation / (Gc * area) - 1.0);
  report_row("plane", {{"stress", worst}, {"sideways", sideways}, {"dissipated", imbalance}});
  EXPECT_LE(worst, 1e-8);
  EXPECT_LE(sideways, 1e-9);
  EXPECT_LE(imbalance, 1e-8);
  EXPECT_EQ(reports[2].debonded_area.front(), 0.0);
  EXPECT_NEAR(reports.back().debonded_area.front(), area, 1e-9 * area);
}

// A box that is so long that the plane, of one face, snaps back: with dissipation control the branch is followed, on
// which strain = sigma/E + delta/L falls.
TEST(PartedBox, SnapBackIsFollowed) {
  const double E = 50e6, length = 1e-3, ft = 1e6, Gc = 2.0, K = 1e13;
  const double at_peak = ft / K, at_end = 2.0 * Gc / ft;
  const Mesh mesh = layers({0.5e-3, 0.5e-3}, 1);
  FractureModel model = elastic_model({from_young_poisson(E, 0.3), from_young_poisson(E, 0.3)}, {});
  glue(model, mesh, law_of(linear_law()), {.strength = ft, .toughness = Gc, .stiffness = K}, Vector::UnitZ(),
       [](const Vector& x) { return std::abs(x.z() - 0.5e-3) < 1e-9; });
  const MeanPath path = strains({{zz, {1.2 * ft / E}}});
  load(model, mesh, path, "periodic");
  const double area = 0.6e-3 * 0.8e-3;
  LoadingSettings loading{.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}};
  loading.maximum_dissipation = 0.05 * Gc * area;
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-9}, loading);
  FractureState state = run.initial_state();
  double worst = 0.0, least = 1.0;
  bool is_falling = false;
  for (int k = 0; k < 40 && state.energy.interface_dissipation < 0.8 * Gc * area; ++k) {
    const StepReport report = run.step(state);
    const double strain = report.means->strain(2, 2), stress = report.means->stress(2, 2);
    is_falling = is_falling || report.energy.interface_dissipation > 1e-9 * Gc * area;
    const double opening = is_falling ? at_end - stress / ft * (at_end - at_peak) : stress / K;
    worst = std::max(worst, std::abs(stress / E + opening / length - strain) / (ft / E));
    if (is_falling) least = std::min(least, strain / (ft / E));
  }
  report_row("plane", {{"strain", worst}, {"least strain", least}});
  EXPECT_LE(worst, 1e-5);
  EXPECT_LE(least, 0.5);
}

// Mean stresses and strains of all kinds, prescribed together, on a laminate that is linear: C of six load cases (as
// it is, not its symmetric part).
class Boxes : public testing::TestWithParam<const char*> {};

TEST_P(Boxes, StressesAndStrainsMixAsTheStiffnessSays) {
  const Mesh mesh = layers({0.3e-3, 0.5e-3, 0.2e-3});
  const std::vector<IsotropicElasticity> materials{from_young_poisson(1e6, 0.4), from_young_poisson(1e8, 0.2),
                                                   from_young_poisson(3e6, 0.45)};
  const Homogenized whole = homogenize(mesh, {.elasticity = materials, .zone = {0, 1, 2}},
                                       {.loading = &homogenization_loading(GetParam()), .tolerance = 1e-12});
  MandelMatrix stresses, strains_of_cases;
  for (Index k = 0; k < n_components; ++k) {
    stresses.col(k) = whole.cases[k].stress;
    strains_of_cases.col(k) = whole.cases[k].strain;
  }
  const MandelMatrix C = stresses * strains_of_cases.inverse();
  MeanPath path;
  path.by_stress = {false, true, true, false, true, true};
  path.points = {{0.01, 2e4, -3e4, 0.02, 0.0, 1e4}, {-0.02, 0.0, 5e4, 0.01, 2e4, 0.0}};
  FractureModel model = elastic_model(materials, {});
  load(model, mesh, path, GetParam());
  const std::vector<StepReport> reports = follow(mesh, model, path);
  ASSERT_EQ(reports.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Mandel stress = to_mandel(reports[i + 1].means->stress), strain = to_mandel(reports[i + 1].means->strain);
    const double apart = (C * strain - stress).norm() / stress.norm();
    report_row(fmt::format("{}, point {}", GetParam(), i), {{"apart", apart}});
    EXPECT_LE(apart, 1e-7);
    for (int k = 0; k < n_components; ++k) {
      const double due = path.points[i][k] * mandel_factor(k);
      if (path.by_stress[k])
        EXPECT_NEAR(stress[k], due, 1e-7 * stress.norm());
      else
        EXPECT_NEAR(strain[k], due, 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Boxes, testing::ValuesIn(both_loadings),
                         [](const auto& input) { return std::string(input.param).substr(0, 7); });

// A glass sphere of 2 % in a box of six radii; the bond is rigid at first. Its radius is 1 m.
struct BondedSphere {
  IsotropicElasticity glass = from_young_poisson(70e9, 0.22), binder = from_young_poisson(75e6, 0.3);

  FractureModel model(const Mesh& mesh, const MeanPath& path) const {
    std::vector<IsotropicElasticity> materials;
    for (const std::string& name : mesh.region_names) materials.push_back(name == "bead" ? glass : binder);
    FractureModel model = elastic_model(materials, {});
    const Index bead = mesh.region_index("bead");
    CohesiveSurface bond{.name = "bond", .law = law_of(linear_law()), .faces = {}};
    for (Index f = 0; f < mesh.n_interior_faces(); ++f)
      if ((mesh.region[mesh.owner[f]] == bead) != (mesh.region[mesh.neighbour[f]] == bead)) {
        bond.faces.push_back(f);
        bond.at.push_back({.strength = 2e6, .toughness = 3e4});
      }
    model.interfaces.push_back(std::move(bond));
    load(model, mesh, path, "periodic");
    return model;
  }
};

// Young's modulus of the box over what Mori and Tanaka have for this fraction, which differs from the dilute one,
// Eshelby's, by the second order.
TEST(DebondingSphere, BeginsAsEshelbySays) {
  const BondedSphere sphere;
  const Mesh mesh = barycentric_dual(sphere_in_cube(8, 6, 3.0, 0.35));
  const MeanPath path = strains({{zz, {1e-4}}});
  const StepReport report = follow(mesh, sphere.model(mesh, path), path, 1e-6).back();
  double fraction = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.region[c] == mesh.region_index("bead")) fraction += mesh.cell_volume[c] / 216.0;
  const Phase phases[] = {{1.0 - fraction, sphere.binder}, {fraction, sphere.glass}};
  const ModulusBounds estimate = hashin_shtrikman(phases);
  const double K = estimate.bulk_lower, G = estimate.shear_lower, E = 9.0 * K * G / (3.0 * K + G);
  const double growth = (report.means->stress(2, 2) / report.means->strain(2, 2) - 75e6) / (E - 75e6);
  report_row(fmt::format("fraction {:.4f}, {} cells", fraction, mesh.n_cells()), {{"growth over estimate", growth}});
  EXPECT_NEAR(growth, 1.0, 0.03);
}

// Half-way to its strength nothing softens. What the first linear solution left took faces beyond it: 465 iterations of
// FGMRES here, and in a box of sharp tetrahedra a minute.
TEST(DebondingSphere, HoldsInFewIterationsWhileItsRigidBondDoes) {
  const BondedSphere sphere;
  const Mesh mesh = sphere_in_cube(6, 4, 3.0, 0.3);
  const MeanPath path = strains({{zz, {0.01}}});
  const StepReport report = follow(mesh, sphere.model(mesh, path), path, 1e-6).back();
  report_row(fmt::format("bonded, {} cells", mesh.n_cells()),
             {{"iterations", static_cast<double>(report.krylov_iterations)},
              {"dissipated", report.energy.interface_dissipation / report.energy.external_work}});
  EXPECT_LT(report.energy.interface_dissipation, 1e-9 * report.energy.external_work);
  EXPECT_LT(report.krylov_iterations, 200);
}

// The work is what is stored and dissipated, and the mean stress by the sides' forces that of the cells.
TEST(DebondingSphere, ClosesTheAccountOnItsWay) {
  const BondedSphere sphere;
  const Mesh mesh = sphere_in_cube(3, 2, 3.0, 0.5);
  const MeanPath path = strains({{zz, {0.06}}});
  double worst = 0.0;
  Tensor of_cells;
  const std::vector<StepReport> reports = follow(mesh, sphere.model(mesh, path), path, 1e-6, 0.05, &of_cells);
  for (const StepReport& report : reports)
    if (report.energy.external_work > 0.0)
      worst = std::max(worst, std::abs(left_over({}, report.energy)) / report.energy.external_work);
  const StepReport& last = reports.back();
  report_row(fmt::format("{} cells", mesh.n_cells()),
             {{"stress over strain over the binder's E", last.means->stress(2, 2) / last.means->strain(2, 2) / 75e6},
              {"debonded over the sphere", last.debonded_area.front() / (4.0 * std::numbers::pi)},
              {"left over", worst},
              {"mean stress of the cells", of_cells(2, 2) / last.means->stress(2, 2) - 1.0}});
  EXPECT_LE((of_cells - last.means->stress).norm(), 1e-5 * last.means->stress.norm());
  EXPECT_LT(last.means->stress(2, 2) / last.means->strain(2, 2), 75e6);
  EXPECT_GT(last.debonded_area.front(), 0.0);
  EXPECT_LE(worst, 0.01);
}

void move(const Vector& by, Mesh& mesh) {
  for (Vector& x : mesh.points) x += by;
  for (Vector& x : mesh.face_centre) x += by;
  for (Vector& x : mesh.cell_centre) x += by;
}

// Where the box lies changes neither what is found nor how fast: moments and moves are about its centre.
TEST_P(Boxes, MayLieFarFromTheOrigin) {
  const std::vector<IsotropicElasticity> materials{from_young_poisson(1e6, 0.4), from_young_poisson(1e8, 0.2)};
  Mesh mesh = layers({0.4e-3, 0.6e-3});
  MeanPath path;
  path.by_stress = {false, true, true, false, true, true};
  path.points = {{0.01, 2e4, -3e4, 0.02, 0.0, 1e4}};
  const auto end_of = [&] {
    FractureModel model = elastic_model(materials, {});
    load(model, mesh, path, GetParam());
    return follow(mesh, model, path, 1e-8).back();
  };
  const auto six_of = [&] {
    return homogenize(mesh, {.elasticity = materials, .zone = {0, 1}},
                      {.loading = &homogenization_loading(GetParam()), .tolerance = 1e-8});
  };
  const StepReport near = end_of();
  const Homogenized near_six = six_of();
  move({1.0, -2.0, 3.0}, mesh);
  const StepReport far = end_of();
  const Homogenized far_six = six_of();
  const double stress = (far.means->stress - near.means->stress).norm() / near.means->stress.norm();
  const double strain = (far.means->strain - near.means->strain).norm() / near.means->strain.norm();
  const double stiffness = (far_six.stiffness - near_six.stiffness).norm() / near_six.stiffness.norm();
  report_row(GetParam(), {{"stress", stress},
                          {"strain", strain},
                          {"stiffness", stiffness},
                          {"iterations near", static_cast<double>(near.krylov_iterations)},
                          {"far", static_cast<double>(far.krylov_iterations)}});
  EXPECT_LE(stress, 1e-6);
  EXPECT_LE(strain, 1e-6);
  EXPECT_LE(stiffness, 1e-6);
  EXPECT_LE(static_cast<double>(far.krylov_iterations), 1.2 * static_cast<double>(near.krylov_iterations));
}

TEST(MeanPaths, AreRefusedWithForcesOnTheSides) {
  const Mesh mesh = layers({1e-3});
  EXPECT_THROW(motion_along(strains({{zz, {0.1}}}), mesh, homogenization_loading("uniform traction"),
                            from_young_poisson(1e6, 0.3)),
               InputError);
}

}  // namespace
}  // namespace pfdm::verification::this_file
