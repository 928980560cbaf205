// Closed forms of incompressible elasticity (Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379; 242 (1949) 173) at nu =
// 0.4999: torsion of a cylinder, a thick cylinder and a thick sphere under pressure, a long wall.

#include "tests/verification/finite.h"

#include "mesh/generators/sphere_sector.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double nu = 0.4999, mu = 0.5e6;
const IsotropicElasticity rubber{.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu};

// A cylinder of radius 1 along z: rings of triangles, extruded. The top is turned.
Mesh cylinder(Index rings, Index layers, double length) {
  CellSoup soup;
  soup.region_names = {"body"};
  const auto first = [](Index ring) { return ring == 0 ? Index{0} : 1 + 3 * ring * (ring - 1); };
  const Index in_plane = first(rings + 1);
  for (Index k = 0; k <= layers; ++k) {
    soup.points.emplace_back(0.0, 0.0, length * double(k) / double(layers));
    for (Index ring = 1; ring <= rings; ++ring)
      for (Index i = 0; i < 6 * ring; ++i) {
        const double r = double(ring) / double(rings), angle = std::numbers::pi / 3.0 * double(i) / double(ring);
        soup.points.emplace_back(r * std::cos(angle), r * std::sin(angle), length * double(k) / double(layers));
      }
  }
  const auto point = [&](Index ring, Index i) { return ring == 0 ? Index{0} : first(ring) + i % (6 * ring); };
  const auto add = [&](Index a, Index b, Index c) {
    for (Index k = 0; k < layers; ++k) {
      const Index low = k * in_plane, high = low + in_plane;
      const std::array<Index, 6> wedge{low + a, low + c, low + b, high + a, high + c, high + b};
      soup.add_cell(CellShape::wedge, wedge, 0);
    }
  };
  for (Index ring = 1; ring <= rings; ++ring)
    for (Index sector = 0; sector < 6; ++sector)
      for (Index i = 0; i < ring; ++i) {
        const Index outer = sector * ring + i, inner = sector * (ring - 1) + i;
        add(point(ring - 1, inner), point(ring, outer), point(ring, outer + 1));
        if (i + 1 < ring) add(point(ring - 1, inner), point(ring, outer + 1), point(ring - 1, inner + 1));
      }
  const auto normal_is = [](double z) {
    return [z](const Vector&, const Vector& n, std::span<const Index>) { return n.z() * z > 0.9; };
  };
  return assemble_mesh(std::move(soup),
                       {{"bottom", normal_is(-1.0)},
                        {"top", normal_is(1.0)},
                        {"side", [](const Vector&, const Vector&, std::span<const Index>) { return true; }}});
}

// Couple pi mu psi r^4/2 and axial force -pi mu psi^2 r^4/4, at the same length.
TEST(FiniteClosedForms, TorsionOfACylinder) {
  constexpr double length = 1.0, twist = 0.8;  // psi, per length
  std::vector<std::array<double, 2>> errors;
  for (const Index rings : {4, 8}) {
    const Mesh mesh = cylinder(rings, rings, length);
    const auto turned = [](const Vector& x, double t) -> Vector {
      return Eigen::AngleAxisd(t * twist * x.z(), Vector::UnitZ()).toRotationMatrix() * x - x;
    };
    const FractureModel model =
        finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}),
                    {moved("bottom", {true, true, true}, turned), moved("top", {true, true, true}, turned)});
    const Drawn drawn = draw(mesh, model, 4);
    double couple = 0.0;
    const Patch& top = mesh.patch("top");
    for (Index f = top.first_face; f < top.first_face + top.n_faces; ++f) {
      const Vector place = mesh.face_centre[f] + turned(mesh.face_centre[f], 1.0);
      couple += place.cross(drawn.state.boundary_force[f - mesh.n_interior_faces()]).z();
    }
    const double axial = drawn.force(mesh, "top").z();
    errors.push_back({couple / (0.5 * std::numbers::pi * mu * twist) - 1.0,
                      axial / (-0.25 * std::numbers::pi * mu * twist * twist) - 1.0});
    report_row(fmt::format("torsion, {} cells", mesh.n_cells()), {{"couple error", errors.back()[0]},
                                                                  {"axial force error", errors.back()[1]},
                                                                  {"Krylov", double(drawn.krylov_iterations)}});
  }
  for (const std::size_t k : {0U, 1U}) {  // of second order, and the limit
    EXPECT_LE(std::abs(errors[1][k]), 0.35 * std::abs(errors[0][k]));
    EXPECT_LE(std::abs(4.0 * errors[1][k] - errors[0][k]) / 3.0, 0.01);
  }
}

// Plane strain, r^2 = R^2 + a^2 - A^2: p = mu (ln(B/A) - ln(b/a) + (a^2 - A^2)/2 (1/a^2 - 1/b^2)), to a = 2 A.
TEST(FiniteClosedForms, PressurisedMooneyRivlinCylinder) {
  constexpr double A = 1.0, B = 2.0, a = 2.0, k = a * a - A * A;
  const double b = std::sqrt(B * B + k);
  const double exact = mu * (std::log(B / A) - std::log(b / a) + 0.5 * k * (1.0 / (a * a) - 1.0 / (b * b)));
  std::vector<double> errors;
  for (const Index n : {8, 16}) {
    const Mesh mesh = mapped_box({n, 2 * n, 1}, [&](const Vector& s) {
      const double r = A + (B - A) * s.x(), angle = 0.5 * std::numbers::pi * s.y();
      return Vector(r * std::cos(angle), r * std::sin(angle), 0.1 * s.z());
    });
    const FractureModel model = finite_body(
        mesh, make_hyperelastic("mooney_rivlin", {.elasticity = rubber, .second_invariant = 0.2}),
        {plane_on("zmin"), plane_on("zmax"), symmetry_on("ymin"), symmetry_on("ymax"),
         moved("xmin", {true, true, true},
               [](const Vector& x, double t) -> Vector { return t * (a / A - 1.0) * Vector(x.x(), x.y(), 0.0); })});
    const Drawn drawn = draw(mesh, model, 8);
    const double pressure = -drawn.force(mesh, "xmin").x() / (0.1 * a);
    errors.push_back(std::abs(std::abs(pressure) / exact - 1.0));
    report_row(
        fmt::format("cylinder, {} cells", mesh.n_cells()),
        {{"pressure / mu", pressure / mu}, {"error", errors.back()}, {"Krylov", double(drawn.krylov_iterations)}});
  }
  EXPECT_LE(errors[1], 0.01);
  EXPECT_LE(errors[1], 0.5 * errors[0]);
}

// p = mu ((2/b + 1/(2 b^4)) - (2/a + 1/(2 a^4))), a and b the stretches inside and outside, to a = 2.
TEST(FiniteClosedForms, ThickSphere) {
  constexpr double a = 2.0, A = 1.0, B = 2.0;
  const double b = std::cbrt(B * B * B + (a * a * a - 1.0) * A * A * A) / B;
  const auto part = [](double l) { return 2.0 / l + 0.5 / std::pow(l, 4); };
  const double exact = mu * (part(b) - part(a));
  std::vector<double> errors;
  for (const Index n : {12, 24}) {
    const Mesh mesh = make_sphere_sector({.azimuth = 0.1,
                                          .inner_radius = A,
                                          .shells = {{.radial = {.length = B - A, .n = n}, .region = "body"}},
                                          .polar = {{.length = 0.5 * std::numbers::pi, .n = 2 * n}}});
    const FractureModel model = finite_body(
        mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}),
        {axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("equator"),
         moved("inner", {true, true, true}, [](const Vector& x, double t) -> Vector { return t * (a - 1.0) * x; })});
    const Drawn drawn = draw(mesh, model, 10);
    double area = 0.0;
    for (Index f = 0; f < mesh.patch("inner").n_faces; ++f)
      area += mesh.face_area[mesh.patch("inner").first_face + f].z();
    const double pressure = std::abs(drawn.force(mesh, "inner").z() / area) / (a * a);
    errors.push_back(std::abs(pressure / exact - 1.0));
    report_row(
        fmt::format("sphere, {} cells", mesh.n_cells()),
        {{"pressure / mu", pressure / mu}, {"error", errors.back()}, {"Krylov", double(drawn.krylov_iterations)}});
  }
  EXPECT_LE(errors[1], 0.01);
  EXPECT_LE(errors[1], 0.5 * errors[0]);
}

// The long wall of Bijelonja, Demirdzic, Muzaferija (Int. J. Numer. Meth. Engng 64 (2005) 1594): 1 x 2 m in plane
// strain, W = 80 MPa (I1 - 3) + 20 MPa (I2 - 3), 100 MPa of tension on the top, 50 MPa of pressure on the side, true
// stresses; the stretches are l and 1/l with 2 (80 + 20) MPa (l^2 - 1/l^2) = 150 MPa.
TEST(FiniteClosedForms, LongMooneyRivlinWall) {
  constexpr double modulus = 200e6, side = -50e6, top = 100e6;
  const double step = (top - side) / modulus, l = std::sqrt(0.5 * (step + std::sqrt(step * step + 4.0)));
  const IsotropicElasticity wall{.lambda = 2.0 * modulus * nu / (1.0 - 2.0 * nu), .mu = modulus};
  const Mesh mesh = mapped_box({4, 8, 1}, [](const Vector& s) { return Vector(s.x(), 2.0 * s.y(), 0.1 * s.z()); });
  const auto pressed = [](const char* patch, const Vector& nominal) {
    BoundaryCondition condition{.patch = patch, .value = {}};
    condition.value = [nominal](const Vector&, double t) -> Vector { return t * nominal; };
    return condition;
  };
  const FractureModel model =
      finite_body(mesh, make_hyperelastic("mooney_rivlin", {.elasticity = wall, .second_invariant = 0.2}),
                  {plane_on("zmin"), plane_on("zmax"), symmetry_on("xmin"), symmetry_on("ymin"),
                   pressed("xmax", Vector(side * l, 0.0, 0.0)), pressed("ymax", Vector(0.0, top / l, 0.0))});
  const Drawn drawn = draw(mesh, model, 4);
  const auto moved_by = [&](const char* patch) { return drawn.report.patch_displacement[mesh.patch_index(patch)]; };
  const double u_x = moved_by("xmax").x(), u_y = moved_by("ymax").y();
  report_row(
      "long wall",
      {{"u_x [m]", u_x}, {"u_y [m]", u_y}, {"exact, incompressible u_x", 1.0 / l - 1.0}, {"u_y", 2.0 * (l - 1.0)}});
  EXPECT_NEAR(u_x, -0.1675, 0.01 * 0.1675);
  EXPECT_NEAR(u_y, 0.4025, 0.01 * 0.4025);
}

}  // namespace
}  // namespace pfdm::verification::this_file
