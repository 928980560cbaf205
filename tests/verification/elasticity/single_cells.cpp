// One cell, held by planes and by displacements, as laws are tried: with every energy split, AT1 and AT2 its stress is
// that of one point whose damage solves the local equation, in confined and uniaxial tension and compression and in
// shear.

#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double side = 1e-3, Gc = 100.0, ell = 5e-3, k = 1e-6;
const IsotropicElasticity material = from_young_poisson(100e9, 0.3);

// The damage where nothing varies: Gc/ell d = 2 (1 - k) (1 - d) psi, and 3 Gc/(8 ell) in place of the left side.
double local_damage(const std::string& model, double psi) {
  const double drive = 2.0 * (1.0 - k) * psi;
  if (drive <= 0.0) return 0.0;
  return model == "AT2" ? drive / (Gc / ell + drive) : std::max(0.0, 1.0 - 3.0 * Gc / (8.0 * ell * drive));
}

Tensor local_stress(const EnergySplit& split, const std::string& model, const Tensor& eps) {
  const double d = local_damage(model, split.energy(material, eps).psi_plus);
  return degraded_stress(split, material, (1.0 - k) * (1.0 - d) * (1.0 - d) + k, eps);
}

// The least strain along x at which nothing acts there: a bracket from below, then bisection. With `orthogonal` damage
// under compression leaves several, and a broken cell is pushed aside by many times its shortening.
Tensor relaxed(const EnergySplit& split, const std::string& model, Tensor eps) {
  const double step = 0.01 * std::abs(eps(1, 1));
  double low = -100.0 * step, high = low;
  eps(0, 0) = low;
  for (int i = 0; i < 10000 && local_stress(split, model, eps)(0, 0) < 0.0; ++i) {
    low = high;
    eps(0, 0) = high = low + step;
  }
  for (int i = 0; i < 200; ++i) {
    eps(0, 0) = 0.5 * (low + high);
    (local_stress(split, model, eps)(0, 0) < 0.0 ? low : high) = eps(0, 0);
  }
  return eps;
}

enum class Path { confined, uniaxial, shear };

struct Loaded {
  std::vector<BoundaryCondition> boundary;
  Tensor strain;  // at the end; uniaxial: without that along x
};

// In plane strain. Uniaxial: symmetry on the left and below, pulled above, the right side free.
Loaded loaded(Path path, double size) {
  Loaded on{.boundary = {plane_on("zmin"), plane_on("zmax")}, .strain = Tensor::Zero()};
  if (path == Path::shear) {
    on.strain(0, 1) = on.strain(1, 0) = 0.5 * size;
    for (const char* patch : {"xmin", "xmax", "ymin", "ymax"})
      on.boundary.push_back(moved(patch, {true, true, false}, [=](const Vector& x, double t) -> Vector {
        return {t * size * x.y(), 0.0, 0.0};
      }));
    return on;
  }
  on.strain(1, 1) = size;
  on.boundary.push_back(symmetry_on("xmin"));
  on.boundary.push_back(symmetry_on("ymin"));
  if (path == Path::confined) on.boundary.push_back(symmetry_on("xmax"));
  on.boundary.push_back(moved("ymax", {false, true, false}, [=](const Vector&, double t) -> Vector {
    return {0.0, t * size * side, 0.0};
  }));
  return on;
}

// Stress of the cell over that of the point, its largest component 1.
double error_of(const EnergySplit& split, const std::string& model, Path path, double size) {
  const Mesh mesh =
      make_box_hexes({.axes = {{{{side, 1, 1.0}}, {{side, 1, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  const Loaded on = loaded(path, size);
  FractureModel fracture = elastic_model({material}, on.boundary);
  fracture.regions[0] = {.elasticity = material, .Gc = Gc, .ell = ell};
  fracture.crack = &crack_geometry(model);
  fracture.split = split;
  fracture.residual_stiffness = k;
  FractureRun run(mesh, fracture, {.damage_tolerance = 1e-9, .energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-9},
                  {.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
  const FractureState end = run_to_end(run, [](const FractureState&, const StepReport&) {});
  const Tensor strain = path == Path::uniaxial ? relaxed(split, model, on.strain) : on.strain;
  const Tensor due = local_stress(split, model, strain);
  EXPECT_NEAR(end.damage[0], local_damage(model, split.energy(material, strain).psi_plus), 1e-6);
  return (run.output(end).stress[0] - due).norm() / stress(material, strain).norm();
}

class SingleCell : public ::testing::TestWithParam<const char*> {};

TEST_P(SingleCell, FollowsTheLawOfAPoint) {
  const bool is_star_convex = std::string(GetParam()) == "star_convex";
  const EnergySplit split(split_law(GetParam()), {is_star_convex ? 5.0 : 0.5});
  double worst = 0.0;
  for (const char* model : {"AT2", "AT1"})
    for (const Path path : {Path::confined, Path::uniaxial, Path::shear})
      for (const double size : {1e-3, -1e-3}) {
        SCOPED_TRACE(std::string(model) + ", path " + std::to_string(static_cast<int>(path)) + ", " +
                     std::to_string(size));
        const double error = error_of(split, model, path, size);
        EXPECT_LE(error, 1e-5);
        worst = std::max(worst, error);
      }
  report_row(GetParam(), {{"error of the stress", worst}});
}

INSTANTIATE_TEST_SUITE_P(Splits, SingleCell,
                         ::testing::Values("none", "volumetric_deviatoric", "star_convex", "spectral", "no_tension",
                                           "orthogonal", "drucker_prager", "rankine", "hybrid"),
                         [](const auto& which) { return std::string(which.param); });

// Columns one cell wide: the cells may turn about their line without moving the centre of a face.
double column_force(const std::vector<BoundaryCondition>& sides, Index n) {
  const Mesh mesh = make_box_hexes(
      {.axes = {{{{side, 1, 1.0}}, {{2.0 * side, n, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  std::vector<BoundaryCondition> boundary = sides;
  boundary.push_back(displacement_on("ymin", [](const Vector&) -> Vector { return Vector::Zero(); }));
  boundary.push_back(displacement_on("ymax", [](const Vector&) -> Vector { return {0.0, 1e-6, 0.0}; }));
  FractureRun run(mesh, elastic_model({material}, boundary), {.equilibrium_tolerance = 1e-9},
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  double force = 0.0;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
    force = report.reaction[mesh.patch_index("ymax")][1];
  });
  for (const Tensor& G : run.output(end).gradient)
    EXPECT_LE((G - G.transpose()).norm(), 1e-6 * G.norm());  // not turned
  return force;
}

// The ends' centres do not see that the ends are clamped: free sides give the force of uniaxial tension, a lower bound.
TEST(Columns, OneCellWideAreHeldByTheirEnds) {
  const double uniaxial = 50.0, confined = uniaxial * material.constrained_modulus() / material.young_modulus();
  for (const Index n : {2, 5, 10}) {
    EXPECT_NEAR(column_force({}, n), uniaxial, 1e-6 * uniaxial);
    EXPECT_NEAR(column_force({symmetry_on("xmin"), symmetry_on("xmax"), symmetry_on("zmin"), symmetry_on("zmax")}, n),
                confined, 1e-6 * confined);
  }
}

// Turned at one end: the torque of a bar, to what one cell across can tell (torsion constant 0.1406 a^4).
TEST(Columns, OneCellWideResistTorsion) {
  constexpr Index n = 10;
  constexpr double turn = 1e-3;
  const Mesh mesh = make_box_hexes(
      {.axes = {{{{side, 1, 1.0}}, {{10.0 * side, n, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  const std::vector<BoundaryCondition> boundary{
      displacement_on("ymin", [](const Vector&) -> Vector { return Vector::Zero(); }),
      displacement_on("ymax", [=](const Vector& x) -> Vector {
        return turn * Vector(x.z() - 0.5 * side, 0.0, -(x.x() - 0.5 * side));
      })};
  FractureRun run(mesh, elastic_model({material}, boundary), {.equilibrium_tolerance = 1e-9},
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  const FractureState end = run_to_end(run, [](const FractureState&, const StepReport&) {});
  const OutputFields fields = run.output(end);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double spin = 0.5 * (fields.gradient[c](0, 2) - fields.gradient[c](2, 0));
    EXPECT_NEAR(spin, turn * mesh.cell_centre[c].y() / (10.0 * side), 0.03 * turn);
  }
}

// A run that is given a mesh away keeps it.
TEST(Columns, KeepAMeshThatIsGivenAway) {
  const auto make = [] {
    return make_box_hexes(
        {.axes = {{{{side, 1, 1.0}}, {{2.0 * side, 3, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  };
  const FractureModel model = elastic_model({material}, {symmetry_on("xmin"), symmetry_on("zmin"), symmetry_on("ymin"),
                                                         displacement_on("ymax", [](const Vector&) -> Vector {
                                                           return {0.0, 1e-6, 0.0};
                                                         })});
  const LoadingSettings loading{.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}};
  const Mesh kept = make();
  FractureRun by_reference(kept, model, {.equilibrium_tolerance = 1e-9}, loading);
  FractureRun owner(make(), model, {.equilibrium_tolerance = 1e-9}, loading);
  const auto stress_of = [](FractureRun& run) {
    return run.output(run_to_end(run, [](const FractureState&, const StepReport&) {})).stress.values();
  };
  EXPECT_EQ(stress_of(owner), stress_of(by_reference));
}

}  // namespace
}  // namespace pfdm::verification::this_file
