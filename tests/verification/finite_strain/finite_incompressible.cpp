// Nearly incompressible bodies at finite strain: a manufactured solution with a pressure, and Cook's membrane.

#include "tests/verification/finite.h"

#include "solver/fracture/equilibrium/finite_newton.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

// x = X + (a sin pi Y, b sin pi Z, e sin pi X): J - 1 = A B E, the product of the three slopes. e goes with 1/lambda,
// so that the pressure lambda (J - 1) is the same for every nu.
struct Pressed {
  static constexpr double a = 0.3, b = 0.2, mu = 0.5e6;
  double lambda = 0.0, e = 0.0;

  explicit Pressed(double nu)
      : lambda(2.0 * mu * nu / (1.0 - 2.0 * nu)), e(0.1 * (2.0 * mu * 0.3 / (1.0 - 2.0 * 0.3)) / lambda) {}

  Vector displacement(const Vector& X) const {
    constexpr double pi = std::numbers::pi;
    return {a * std::sin(pi * X.y()), b * std::sin(pi * X.z()), e * std::sin(pi * X.x())};
  }
  Tensor gradient(const Vector& X) const {
    constexpr double pi = std::numbers::pi;
    Tensor H = Tensor::Zero();
    H(0, 1) = a * pi * std::cos(pi * X.y());
    H(1, 2) = b * pi * std::cos(pi * X.z());
    H(2, 0) = e * pi * std::cos(pi * X.x());
    return H;
  }
  Tensor stress(const Vector& X) const {
    const Tensor H = gradient(X), F = Tensor::Identity() + H, inverse = F.inverse().transpose();
    const double change = H(0, 1) * H(1, 2) * H(2, 0);
    return mu * (F - inverse) + lambda * change * (1.0 + change) * inverse;
  }
  Vector body_force(const Vector& X) const {
    constexpr double step = 1e-4;
    Vector force = Vector::Zero();
    for (Index k = 0; k < 3; ++k) {
      const Vector by = step * Vector::Unit(k);
      force -= (stress(X + by) - stress(X - by)).col(k) / (2.0 * step);
    }
    return force;
  }
};

struct Errors {
  double u = 0.0, stress = 0.0;
  Index krylov_iterations = 0;
};

// Moved as the exact solution has it; the top is free along its normal, which fixes the pressure. Keeps a reference.
std::vector<BoundaryCondition> boundary_of(const Mesh& mesh, const Pressed& exact) {
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, patch.name != "zmax"},
                             [&](const Vector& x, double t) -> Vector { return t * exact.displacement(x); }));
  for (BoundaryCondition& condition : boundary)
    if (condition.patch == "zmax")
      condition.value = [&](const Vector& x, double t) -> Vector {
        const Vector u = t * exact.displacement(x);
        return {u.x(), u.y(), 0.0};
      };
  return boundary;
}

// On the cells and on the top [N], at a part of the load.
std::vector<Vector> forces_of(const Mesh& mesh, const Unknowns& unknowns, const Pressed& exact, double load) {
  std::vector<Vector> force(unknowns.n_nodes(), Vector::Zero());
  for (Index c = 0; c < mesh.n_cells(); ++c)
    force[c] = load * mesh.cell_volume[c] * exact.body_force(mesh.cell_centre[c]);
  const Patch& top = mesh.patch("zmax");
  for (Index f = top.first_face; f < top.first_face + top.n_faces; ++f)
    force[unknowns.node_of_face[f]] =
        load * mesh.face_area[f].norm() * exact.stress(mesh.face_centre[f])(2, 2) * Vector::UnitZ();
  return force;
}

// Of all of the stress, the mean included.
double stress_error(const Mesh& mesh, const CellMechanics& cells, const Pressed& exact) {
  double wrong = 0.0, whole = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Tensor P = exact.stress(mesh.cell_centre[c]);
    wrong += mesh.cell_volume[c] * (cells.stress[c] - P).squaredNorm();
    whole += mesh.cell_volume[c] * P.squaredNorm();
  }
  return std::sqrt(wrong / whole);
}

Errors solve_pressed(const Mesh& mesh, double nu) {
  const Pressed exact(nu);
  const auto material = make_hyperelastic("neo_hookean", {.elasticity = {.lambda = exact.lambda, .mu = Pressed::mu}});
  const FractureModel model = finite_body(mesh, material, boundary_of(mesh, exact));
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const auto stiffness = make_cell_stiffness(mesh, model);
  MomentumSolver momentum(mesh, unknowns);
  FractureState state;
  state.displacement.assign(unknowns.n_unknowns(), Vector::Zero());
  state.damage = state.closure = CellField<double>(mesh.n_cells(), 0.0);
  Errors errors;
  constexpr int steps = 4;
  for (int step = 1; step <= steps; ++step) {
    state.load = double(step) / steps;
    momentum.set_body_force(forces_of(mesh, unknowns, exact, state.load));
    stiffness->set(state, momentum);
    const Equilibrium end =
        solve_finite(*stiffness, {.ceiling = 1e-7, .floor = 1e-7, .most_iterations = 3000}, momentum, state);
    EXPECT_TRUE(end.converged) << end.residual;
    errors.krylov_iterations += end.iterations;
  }
  const CellMechanics cells = momentum.balance().mechanics(state.displacement);
  const auto everywhere = [](Index) { return true; };
  errors.u = relative_error(
      mesh, [&](Index c) { return state.displacement[c]; },
      [&](Index c) { return exact.displacement(mesh.cell_centre[c]); }, everywhere);
  errors.stress = stress_error(mesh, cells, exact);
  return errors;
}

TEST(FiniteIncompressible, ManufacturedPressureConverges) {
  const auto box = [](double size) {
    ParticlesInBoxSettings settings;
    settings.upper = Vector::Ones(), settings.size_far = size, settings.particles = {};
    return make_particles_in_box(settings);
  };
  const Mesh coarse = box(0.22), fine = box(0.11);
  for (const bool polyhedra : {false, true}) {
    const Mesh first = polyhedra ? barycentric_dual(coarse) : coarse,
               second = polyhedra ? barycentric_dual(fine) : fine;
    Index krylov = 0;
    for (const double nu : {0.3, 0.49, 0.4999}) {
      const Errors a = solve_pressed(first, nu), b = solve_pressed(second, nu);
      const double u_order = observed_order(a.u, first.n_cells(), b.u, second.n_cells());
      const double stress_order = observed_order(a.stress, first.n_cells(), b.stress, second.n_cells());
      report_row(fmt::format("{}, nu {}, {} and {} cells", polyhedra ? "polyhedra" : "tetrahedra", nu, first.n_cells(),
                             second.n_cells()),
                 {{"u", b.u},
                  {"order", u_order},
                  {"stress", b.stress},
                  {"order ", stress_order},
                  {"Krylov", double(a.krylov_iterations)},
                  {"Krylov ", double(b.krylov_iterations)}});
      EXPECT_GE(u_order, 1.7);
      EXPECT_GE(stress_order, 0.9);
      if (krylov == 0) krylov = b.krylov_iterations;
      EXPECT_LE(b.krylov_iterations, 3 * krylov);
    }
  }
}

// Plane strain, mu = 80.194, 6.25 of dead shear on the right edge (Simo, Armero, Int. J. Numer. Meth. Engng 33 (1992)
// 1413), nu = 0.4999, with the neo-Hookean law of here. Reference: quadratic displacements and linear pressures
// (dolfinx 0.5) on 8 to 64 squares a side, cook_membrane.py: mean of the edge's vertical
// displacement 6.806, 6.887, 6.921, 6.937; its limit 6.95 to within 0.01.
TEST(FiniteIncompressible, CooksMembrane) {
  constexpr double mu = 80.194, nu = 0.4999, reference = 6.95;
  const IsotropicElasticity rubber{.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu};
  std::vector<double> errors;
  for (const Index n : {16, 32, 64}) {
    const Mesh mesh = mapped_box({n, n, 1}, [](const Vector& s) {
      return Vector(48.0 * s.x(), 44.0 * s.x() + s.y() * (44.0 - 28.0 * s.x()), s.z());
    });
    BoundaryCondition sheared{.patch = "xmax", .value = {}};
    sheared.value = [](const Vector&, double t) -> Vector { return 6.25 * t * Vector::UnitY(); };
    const FractureModel model =
        finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}),
                    {plane_on("zmin"), plane_on("zmax"),
                     displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }), sheared});
    const std::clock_t start = std::clock();
    const Drawn drawn = draw(mesh, model, 5, 1e-7);
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    const auto edge = mesh.patch_index("xmax");
    const double rise = drawn.report.patch_displacement[edge].y();
    errors.push_back(std::abs(rise / reference - 1.0));
    report_row(
        fmt::format("Cook's membrane, {} cells", mesh.n_cells()),
        {{"rise", rise}, {"error", errors.back()}, {"Krylov", double(drawn.krylov_iterations)}, {"CPU s", seconds}});
  }
  EXPECT_LE(errors.back(), 0.01);
}

}  // namespace
}  // namespace pfdm::verification::this_file
