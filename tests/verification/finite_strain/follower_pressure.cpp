// Pressures on patches: at finite strain they follow the body.

#include "tests/verification/finite.h"

#include "mesh/generators/sphere_sector.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/momentum/body/rigid_motion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double nu = 0.4999, mu = 0.5e6;
const IsotropicElasticity rubber{.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu};

BoundaryCondition pressed(const char* patch, double pressure) {
  BoundaryCondition condition{.patch = patch, .value = {}};
  condition.pressure = [pressure](const Vector&, double t) { return t * pressure; };
  return condition;
}

// The mean of the displacement over the distance from an axis, or from the origin, of the faces of a patch.
double radial_strain(const Mesh& mesh, const FractureModel& model, const Drawn& drawn, const char* name,
                     const Vector& off_axis = Vector::Ones()) {
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const Patch& patch = mesh.patch(name);
  double moved = 0.0, area = 0.0;
  for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
    const Vector x = off_axis.cwiseProduct(mesh.face_centre[f]);
    const double A = mesh.face_area[f].norm();
    moved += A * drawn.state.displacement[unknowns.node_of_face[f]].dot(x) / x.squaredNorm();
    area += A;
  }
  return moved / area;
}

// p = mu ((2/b + 1/(2 b^4)) - (2/a + 1/(2 a^4))), a and b the stretches inside and outside. At B = 4 A the pressure
// grows up to a = 2 and beyond; at B = 2 A it would fall again from a = 1.8 on.
TEST(FollowerPressure, InflatesAThickSphereToTwiceItsRadius) {
  constexpr double A = 1.0, B = 4.0;
  const auto pressure_at = [](double a) {
    const double b = std::cbrt(1.0 + (a * a * a - 1.0) * std::pow(A / B, 3));
    const auto part = [](double l) { return 2.0 / l + 0.5 / std::pow(l, 4); };
    return mu * (part(b) - part(a));
  };
  std::vector<double> errors;
  for (const Index n : {16, 32}) {
    const Mesh mesh =
        make_sphere_sector({.azimuth = 0.1,
                            .inner_radius = A,
                            .shells = {{.radial = {.length = B - A, .n = n, .ratio = 6.0}, .region = "body"}},
                            .polar = {{.length = 0.5 * std::numbers::pi, .n = n}}});
    const FractureModel model = finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}),
                                            {axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("equator"),
                                             pressed("inner", pressure_at(2.0))});
    const Drawn drawn = draw(mesh, model, 12);
    const double a = 1.0 + radial_strain(mesh, model, drawn, "inner");
    errors.push_back(pressure_at(a) / pressure_at(2.0) - 1.0);
    report_row(fmt::format("sphere under a follower pressure, {} cells", mesh.n_cells()),
               {{"stretch inside", a}, {"error of p", errors.back()}, {"Krylov", double(drawn.krylov_iterations)}});
  }
  EXPECT_LE(std::abs(errors[1]), 0.01);
  EXPECT_LE(std::abs(errors[1]), 0.35 * std::abs(errors[0]));
}

// Plane strain, r^2 = R^2 + a^2 - A^2: p = mu (ln(B/A) - ln(b/a) + (a^2 - A^2)/2 (1/a^2 - 1/b^2)), to a = 2 A.
TEST(FollowerPressure, InflatesAMooneyRivlinCylinderToTwiceItsRadius) {
  constexpr double A = 1.0, B = 2.0;
  const auto pressure_at = [](double a) {
    const double k = a * a - A * A, b = std::sqrt(B * B + k);
    return mu * (std::log(B / A) - std::log(b / a) + 0.5 * k * (1.0 / (a * a) - 1.0 / (b * b)));
  };
  for (const BoxCells cells : {BoxCells::hexahedra, BoxCells::tetrahedra}) {
    std::vector<double> errors;
    for (const Index n : {8, 16}) {
      const auto bent = [&](const Vector& s) {
        const double r = A + (B - A) * s.x(), angle = 0.5 * std::numbers::pi * s.y();
        return Vector(r * std::cos(angle), r * std::sin(angle), 0.1 * s.z());
      };
      const Mesh mesh = mapped_box({n, 2 * n, 1}, bent, cells);
      const FractureModel model =
          finite_body(mesh, make_hyperelastic("mooney_rivlin", {.elasticity = rubber, .second_invariant = 0.2}),
                      {symmetry_on("zmin"), symmetry_on("zmax"), symmetry_on("ymin"), symmetry_on("ymax"),
                       pressed("xmin", pressure_at(2.0))});
      const Drawn drawn = draw(mesh, model, 8);
      const double a = 1.0 + radial_strain(mesh, model, drawn, "xmin", Vector(1.0, 1.0, 0.0));
      errors.push_back(pressure_at(a) / pressure_at(2.0) - 1.0);
      report_row(fmt::format("cylinder under a follower pressure, {} cells", mesh.n_cells()),
                 {{"stretch inside", a}, {"error of p", errors.back()}, {"Krylov", double(drawn.krylov_iterations)}});
    }
    for (const double error : errors) EXPECT_LE(std::abs(error), 0.01);
    EXPECT_LE(std::abs(errors[1]), 0.0025);
  }
}

// The wall of finite_closed_forms.cpp, whose tractions are true stresses: on the current areas nothing of the solution
// has to be known.
TEST(FollowerPressure, StretchesALongWallAsItsTrueStressesSay) {
  constexpr double modulus = 200e6, side = 50e6, top = -100e6;
  const IsotropicElasticity wall{.lambda = 2.0 * modulus * nu / (1.0 - 2.0 * nu), .mu = modulus};
  const Mesh mesh = mapped_box({4, 8, 1}, [](const Vector& s) { return Vector(s.x(), 2.0 * s.y(), 0.1 * s.z()); });
  const FractureModel model =
      finite_body(mesh, make_hyperelastic("mooney_rivlin", {.elasticity = wall, .second_invariant = 0.2}),
                  {plane_on("zmin"), plane_on("zmax"), symmetry_on("xmin"), symmetry_on("ymin"), pressed("xmax", side),
                   pressed("ymax", top)});
  const Drawn drawn = draw(mesh, model, 4);
  const auto moved_by = [&](const char* patch) { return drawn.report.patch_displacement[mesh.patch_index(patch)]; };
  EXPECT_NEAR(moved_by("xmax").x(), -0.1675, 0.01 * 0.1675);
  EXPECT_NEAR(moved_by("ymax").y(), 0.4025, 0.01 * 0.4025);
}

// Of a cube on sliding planes that is bent and turned, and its pressures.
struct BentCube {
  Mesh mesh = mapped_box({3, 3, 3}, [](const Vector& x) -> Vector {
    const Vector s = (std::numbers::pi * x).array().sin();
    return x + Vector(0.1 * s.x() * s.y(), -0.1 * s.y() * s.z(), 0.1 * s.z() * s.x());
  });
  FractureModel model;
  Unknowns unknowns;
  FractureState state;

  explicit BentCube(const std::vector<BoundaryCondition>& boundary)
      : model(finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = {.lambda = 2.0 * mu, .mu = mu}}),
                          boundary)),
        unknowns(place_floating_unknowns(mesh, elastic_body(model))) {
    state.load = 1.0;
    state.damage = state.closure = CellField<double>(mesh.n_cells(), 0.0);
    for (Index i = 0; i < unknowns.n_nodes(); ++i) {
      const Vector x = unknowns.place(mesh, i);
      state.displacement.emplace_back(0.3 * x.y() + 0.1 * x.z() * x.z(), -0.2 * x.x() * x.y(),
                                      0.25 * x.z() + 0.1 * x.x());
    }
  }
};

TEST(FollowerPressure, HasNoResultantOnAClosedSurface) {
  std::vector<BoundaryCondition> all;
  for (const char* patch : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}) all.push_back(pressed(patch, mu));
  const BentCube cube(all);
  MomentumSolver momentum(cube.mesh, cube.unknowns);
  make_cell_stiffness(cube.mesh, cube.model)->set(cube.state, momentum);
  Vector sum = Vector::Zero();
  double size = 0.0;
  for (const Vector& force : momentum.balance().traction_forces(1.0)) {
    sum += force;
    size = std::max(size, force.norm());
  }
  EXPECT_GE(size, 0.1 * mu / 9.0);
  EXPECT_LE(sum.norm(), 1e-13 * size * 54.0);
}

// Against differences of the unbalanced forces.
TEST(FollowerPressure, HasItsTangent) {
  const BentCube cube({symmetry_on("zmin"), symmetry_on("xmin"), symmetry_on("ymin"), pressed("xmax", 0.6 * mu),
                       pressed("zmax", -0.8 * mu), pressed("ymax", 0.3 * mu)});
  MomentumSolver momentum(cube.mesh, cube.unknowns);
  const auto stiffness = make_cell_stiffness(cube.mesh, cube.model);
  std::vector<Vector> along(cube.unknowns.n_unknowns(), Vector::Zero());
  for (Index i = 0; i < cube.unknowns.n_nodes(); ++i) {
    const Vector x = cube.unknowns.place(cube.mesh, i);
    along[i] = Vector(std::sin(3.0 * x.y()), std::cos(2.0 * x.z() + x.x()), x.x() * x.y());
  }
  const auto unbalanced = [&](double part) {
    FractureState moved = cube.state;
    for (std::size_t i = 0; i < along.size(); ++i) moved.displacement[i] += part * along[i];
    stiffness->set(moved, momentum);
    return momentum.unbalanced_forces(moved.load, moved.displacement);
  };
  constexpr double step = 1e-5;
  const std::vector<Vector> after = unbalanced(step), before = unbalanced(-step);
  std::vector<Vector> turn(along.size());
  unbalanced(0.0);
  momentum.balance().apply(along, turn);
  double wrong = 0.0, size = 0.0;
  for (std::size_t i = cube.unknowns.n_cells; i < along.size(); ++i) {
    const Vector difference = (before[i] - after[i]) / (2.0 * step);
    wrong = std::max(wrong, (difference - turn[i]).norm());
    size = std::max(size, turn[i].norm());
  }
  EXPECT_LE(wrong, 1e-7 * size);
}

// A pressure on a skew face of a body of small strain is the traction against its normal.
TEST(FollowerPressure, IsATractionAtSmallStrain) {
  const Mesh mesh =
      mapped_box({3, 3, 3}, [](const Vector& x) -> Vector { return x + 0.4 * x.x() * x.z() * Vector::UnitX(); });
  const IsotropicElasticity soft{.lambda = 2.0 * mu, .mu = mu};
  const Patch& top = mesh.patch("xmax");
  const Vector normal = mesh.face_area[top.first_face].normalized();
  BoundaryCondition pulled{.patch = "xmax", .value = {}};
  pulled.value = [normal](const Vector&, double t) -> Vector { return -t * 1e3 * normal; };
  std::vector<FractureState> states;
  for (const BoundaryCondition& condition : {pulled, pressed("xmax", 1e3)}) {
    const FractureModel model =
        elastic_model({soft}, {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"), condition});
    states.push_back(draw(mesh, model, 1).state);
  }
  for (std::size_t i = 0; i < states[0].displacement.size(); ++i)
    EXPECT_LE((states[0].displacement[i] - states[1].displacement[i]).norm(), 1e-9 * 1e3 / mu);
  EXPECT_GT(states[1].displacement.back().norm(), 0.0);
}

}  // namespace
}  // namespace pfdm::verification::this_file
