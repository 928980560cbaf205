// A sphere with cohesive faces under hydrostatic tension, against Lame's shells.

#include "mesh/dual.h"
#include "mesh/generators/sphere_sector.h"
#include "mesh/geometry.h"
#include "tests/verification/cohesive_blocks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

// A bead in a shell of matrix, pulled outwards: separation and load of the closed form for a linear law, rigid at
// first. u = A r + B/r^2, stress = 3 K A - 4 mu B/r^3.
struct Radial {
  double u, stress;  // [m], [Pa]
};

Radial carried(const Radial& at, double from, double to, const IsotropicElasticity& elasticity) {
  const double three_K = 3.0 * elasticity.lambda + 2.0 * elasticity.mu, four_mu = 4.0 * elasticity.mu;
  const double A = (at.stress + four_mu * at.u / from) / (three_K + four_mu);
  const double B = (at.u - A * from) * from * from;
  return {A * to + B / (to * to), three_K * A - four_mu * B / (to * to * to)};
}

struct Sphere {
  static constexpr double core = 100e-6, radius = 200e-6, outer = 800e-6, half_angle = 0.005;
  static constexpr double ft = 2e6, Gc = 10.0;
  IsotropicElasticity bead = from_young_poisson(70e9, 0.3), matrix = from_young_poisson(75e6, 0.44);

  // Of the outside at a separation and its traction.
  Radial outside(double separation) const {
    const double traction = ft * std::max(0.0, 1.0 - separation * ft / (2.0 * Gc));
    const Radial unit = carried({0.0, 1.0}, core, radius, bead);
    return carried({unit.u / unit.stress * traction + separation, traction}, radius, outer, matrix);
  }
};

Mesh cone(Index n) {
  BoxHexesSettings box;
  box.origin = {Sphere::core, -1.0, -1.0};
  box.axes[0] = {{Sphere::radius - Sphere::core, n, 0.2}, {Sphere::outer - Sphere::radius, 4 * n, 10.0}};
  box.axes[1] = {{2.0, 2, 1.0}};
  box.axes[2] = {{2.0, 1, 1.0}};
  box.base_region = "matrix";
  box.regions = {{.name = "bead", .lower = {0.0, -2.0, -2.0}, .upper = {Sphere::radius, 2.0, 2.0}}};
  Mesh mesh = make_box_hexes(box);
  for (Vector& x : mesh.points) x = x[0] * Vector(1.0, Sphere::half_angle * x[1], Sphere::half_angle * x[2]);
  compute_geometry(mesh);
  return mesh;
}

// A part of the sphere: patches on its inside and outside, and what holds its other sides.
struct PartOfSphere {
  Mesh mesh;
  std::string inside, outside;
  std::vector<BoundaryCondition> sides;
};

PartOfSphere narrow_cone() {
  PartOfSphere part{.mesh = cone(10), .inside = "xmin", .outside = "xmax", .sides = {}};
  for (const char* side : {"ymin", "ymax", "zmin", "zmax"}) part.sides.push_back(symmetry_on(side));
  return part;
}

PartOfSphere sector() {
  Mesh mesh = make_sphere_sector({.azimuth = std::numbers::pi / 36.0,
                                  .inner_radius = Sphere::core,
                                  .shells = {{{Sphere::radius - Sphere::core, 10, 0.2}, "bead"},
                                             {{Sphere::outer - Sphere::radius, 40, 10.0}, "matrix"}},
                                  .polar = {{std::numbers::pi / 2.0, 18, 1.0}}});
  return {.mesh = std::move(mesh),
          .inside = "inner",
          .outside = "outer",
          .sides = {axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("equator")}};
}

void expect_lames_shells_and_the_law(const PartOfSphere& part, double most_of_load) {
  const Sphere sphere;
  const Mesh& mesh = part.mesh;
  const double end = sphere.outside(1.05 * 2.0 * Sphere::Gc / Sphere::ft).u;
  FractureModel model =
      elastic_model({}, {displacement_on(part.inside, [](const Vector&) -> Vector { return Vector::Zero(); })});
  for (const std::string& name : mesh.region_names)
    model.regions.push_back({.elasticity = name == "bead" ? sphere.bead : sphere.matrix, .damageable = false});
  model.boundary.push_back(moved(part.outside, {true, true, true},
                                 [&](const Vector& x, double t) -> Vector { return end * t * x.normalized(); }));
  model.boundary.insert(model.boundary.end(), part.sides.begin(), part.sides.end());
  glue(model, mesh, law_of(find_by_name(traction_separation_laws(), "linear", "law")),
       {.strength = Sphere::ft, .toughness = Sphere::Gc}, Vector::UnitX(),
       [](const Vector& x) { return std::abs(x.norm() - Sphere::radius) < 5e-3 * Sphere::radius; });
  FractureRun run(mesh, model, {}, {.end = 1.0, .initial_increment = 0.02, .maximum_increment = 0.02, .stops = {}});
  double worst_load = 0.0, worst_opening = 0.0, most = 0.0;
  const Patch& outside = mesh.patch(part.outside);
  run_to_end(run, [&](const FractureState& state, const StepReport&) {
    if (state.load == 0.0) return;
    const OutputFields fields = run.output(state);
    const double opening = fields.interfaces[0].opening[0];
    most = std::max(most, opening);
    double load = 0.0, area = 0.0;
    for (Index f = outside.first_face; f < outside.first_face + outside.n_faces; ++f) {
      area += mesh.face_area[f].norm();
      load += fields.traction[f].dot(mesh.face_area[f]);
    }
    load /= area;
    // The opening of the closed form at this displacement: none up to the strength, then by bisection.
    double low = 0.0, high = 2.0 * end;
    for (int i = 0; i < 100; ++i)
      (sphere.outside(0.5 * (low + high)).u < end * state.load ? low : high) = 0.5 * (low + high);
    const double held = sphere.outside(0.0).u;
    const Radial due = sphere.outside(low);
    const double due_load = end * state.load < held ? end * state.load / held * sphere.outside(0.0).stress : due.stress;
    worst_load = std::max(worst_load, std::abs(load / due_load - 1.0));
    worst_opening = std::max(worst_opening, std::abs(opening - (end * state.load < held ? 0.0 : low)));
  });
  const double final_opening = 2.0 * Sphere::Gc / Sphere::ft;
  report_row("sphere with cohesive faces", {{"largest error of the load", worst_load},
                                            {"of the opening/final", worst_opening / final_opening},
                                            {"opening reached/final", most / final_opening}});
  EXPECT_LE(worst_load, most_of_load);
  EXPECT_LE(worst_opening, 5e-3 * final_opening);
  EXPECT_GT(most, final_opening);
}

TEST(SphereWithCohesiveFaces, OpensAsLamesShellsAndTheLaw) { expect_lames_shells_and_the_law(narrow_cone(), 1.5e-3); }

TEST(SphereWithCohesiveFaces, OpensAlikeInAnAxisymmetricSector) { expect_lames_shells_and_the_law(sector(), 4e-3); }

// The same on tetrahedra and polyhedra: the closed form, of a separation in the law's softening part, prescribed on the
// surface of a cube.
struct OpenedInACube {
  double opening = 0.0, traction = 0.0,
         worst = 0.0;  // means over those of the closed form; largest error of an opening
};

OpenedInACube opened_in_a_cube(const Mesh& mesh, const char* what) {
  const IsotropicElasticity bead = from_young_poisson(70e9, 0.3), matrix = from_young_poisson(75e6, 0.44);
  constexpr double ft = 2e6, Gc = 1.6e5, opening = 0.5 * 2.0 * Gc / ft, traction = 0.5 * ft;  // radius 1 m
  const double bulk = bead.lambda + 2.0 / 3.0 * bead.mu, inner = traction / (3.0 * bulk) + opening;
  const double three_K = 3.0 * matrix.lambda + 2.0 * matrix.mu, four_mu = 4.0 * matrix.mu;
  const double A = (traction + four_mu * inner) / (three_K + four_mu), B = inner - A;
  FractureModel model = elastic_model({}, {});
  for (const std::string& name : mesh.region_names)
    model.regions.push_back({.elasticity = name == "bead" ? bead : matrix, .damageable = false});
  for (const Patch& patch : mesh.patches)
    model.boundary.push_back(moved(patch.name, {true, true, true}, [=](const Vector& x, double t) -> Vector {
      return t * (A + B / std::pow(x.norm(), 3)) * x;
    }));
  glue(model, mesh, law_of(find_by_name(traction_separation_laws(), "linear", "law")),
       {.strength = ft, .toughness = Gc}, Vector::Zero(), [](const Vector&) { return false; });
  CohesiveSurface& surface = model.interfaces[0];
  const Index bead_region = mesh.region_index("bead");
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const bool from = mesh.region[mesh.owner[f]] == bead_region, to = mesh.region[mesh.neighbour[f]] == bead_region;
    if (from == to) continue;
    surface.faces.push_back(f);
    surface.sign.push_back(from ? 1.0 : -1.0);
    surface.at.push_back({.strength = ft, .toughness = Gc});
  }
  FractureRun run(mesh, model, {}, {.end = 1.0, .initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
  const FractureState end = run_to_end(run, [](const FractureState&, const StepReport&) {});
  const OutputInterface interface = run.output(end).interfaces[0];
  double area = 0.0;
  OpenedInACube found;
  for (std::size_t k = 0; k < interface.faces.size(); ++k) {
    const auto i = static_cast<Index>(k);
    const double part = mesh.face_area[interface.faces[k]].norm();
    area += part;
    found.opening += part * interface.opening[i] / opening;
    found.traction += part * mesh.face_centre[interface.faces[k]].normalized().dot(interface.traction[i]) / traction;
    found.worst = std::max(found.worst, std::abs(interface.opening[i] / opening - 1.0));
  }
  found.opening /= area, found.traction /= area;
  report_row(fmt::format("sphere in a cube, {}", what), {{"cells", double(mesh.n_cells())},
                                                         {"faces", double(interface.faces.size())},
                                                         {"mean opening", found.opening},
                                                         {"mean traction", found.traction},
                                                         {"largest error of an opening", found.worst}});
  return found;
}

TEST(SphereWithCohesiveFaces, OpensEvenlyInACube) {
  const Mesh tetrahedra = sphere_in_cube(5, 0, 3.0, 0.4);
  for (const bool polyhedra : {false, true}) {
    const OpenedInACube found =
        opened_in_a_cube(polyhedra ? barycentric_dual(tetrahedra) : tetrahedra, polyhedra ? "polyhedra" : "tetrahedra");
    // The error of the stress on so coarse a mesh is 2 to 3 %.
    EXPECT_NEAR(found.opening, 1.0, 0.035);
    EXPECT_NEAR(found.traction, 1.0, 0.035);
  }
}

// Half the edges on the surface and, by the grading from it, beside it.
TEST(SphereWithCohesiveFaces, OpensMoreExactlyInAFinerCube) {
  const OpenedInACube coarse = opened_in_a_cube(sphere_in_cube(2, 0, 2.0, 0.5), "coarse"),
                      fine = opened_in_a_cube(sphere_in_cube(4, 0, 2.0, 0.25), "fine");
  EXPECT_NEAR(coarse.opening, 1.0, 0.2);
  EXPECT_NEAR(coarse.traction, 1.0, 0.2);
  EXPECT_LT(std::abs(fine.opening - 1.0), 0.3 * std::abs(coarse.opening - 1.0));
  EXPECT_LT(std::abs(fine.traction - 1.0), 0.3 * std::abs(coarse.traction - 1.0));
  EXPECT_LT(fine.worst, 0.1);
  EXPECT_LT(fine.worst, 0.3 * coarse.worst);
}

}  // namespace
}  // namespace pfdm::verification::this_file
