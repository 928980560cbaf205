// Cohesive faces between two blocks of any cells and materials, against springs in series.

#include "mesh/dual.h"
#include "mesh/geometry.h"
#include "physics/materials/endochronic_material.h"
#include "physics/materials/j2_plasticity.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/pulled_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::pulled_blocks;

// Two blocks with what may stand beside a face, uniform along x: u = delta + 2 L T/modulus.
struct Beside {
  const char* name;
  double nu, modulus;
  bool has_free_sides = false;
  bool is_plate = false;  // in plane stress
  bool of_polyhedra = false;
  const char* split = nullptr;  // of a block that could be damaged
  const char* linear = "automatic";
};
void PrintTo(const Beside& beside, std::ostream* stream) { *stream << beside.name; }

// The extruded triangles of the support, two layers on each side, along x; each side a region, as the dual needs.
Mesh two_blocks_of_polyhedra() {
  Mesh mesh = extruded_triangles(2, {0.0, 0.5, 1.0, 1.5, 2.0});
  mesh.region_names = {"left", "right"};
  for (Index c = 0; c < mesh.n_cells(); ++c) mesh.region[c] = mesh.cell_centre[c].z() > 1.0 ? 1 : 0;
  mesh = barycentric_dual(mesh);
  for (Vector& x : mesh.points) x = edge * Vector(x.z(), x.x(), x.y());
  compute_geometry(mesh);
  return mesh;
}

Mesh mesh_of(const Beside& beside) {
  if (beside.of_polyhedra) return two_blocks_of_polyhedra();
  BoxHexesSettings box;
  box.axes[0] = {{2.0 * edge, 4, 1.0}};
  box.axes[1] = {{edge, 2, 1.0}};
  box.axes[2] = {{edge, beside.is_plate ? 1 : 2, 1.0}};
  return make_box_hexes(box);
}

// Sides slide, or are free but for two of them; the ends slide too. The end at 2 L is drawn along the path.
std::vector<BoundaryCondition> drawn(const Mesh& mesh, const Beside& beside, const std::vector<Vector>& path) {
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches) {
    const Vector n = mesh.face_area[patch.first_face].normalized();
    if (n.x() > 0.5)
      boundary.push_back(
          moved(patch.name, {true, false, false}, [path](const Vector&, double t) { return entry(path, t); }));
    else if (beside.is_plate && std::abs(n.z()) > 0.5)
      boundary.push_back(plane_stress_on(patch.name));
    else if (!beside.has_free_sides || n.sum() < 0.0)
      boundary.push_back(symmetry_on(patch.name));
  }
  return boundary;
}

FractureModel model_of(const Beside& beside, const Mesh& mesh, const InterfaceLaw& law) {
  const IsotropicElasticity elasticity = from_young_poisson(1e9, beside.nu);
  FractureModel model = elastic_model(std::vector(mesh.region_names.size(), elasticity), {});
  if (beside.split != nullptr) {
    model.crack = &crack_geometry("AT1");  // strength 13.7 MPa
    model.split = energy_split(beside.split);
    for (RegionModel& region : model.regions)
      region = {.elasticity = elasticity, .Gc = 100.0, .ell = 0.2 * edge, .damageable = true};
  }
  glue(model, mesh, law, glued, Vector::UnitX(), [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
  return model;
}

// Opened beyond its strength, unloaded, closed.
std::vector<double> openings(const InterfaceLaw& law) {
  const double length = toughness / strength;
  return {0.0, 0.001 * length, 0.3 * length, 0.8 * length, 0.4 * length, -1e5 / law.initial_stiffness(glued)};
}

std::vector<double> tractions(const InterfaceLaw& law, const std::vector<double>& opening) {
  std::vector<double> traction;
  InterfaceHistory history;
  for (const double delta : opening) {
    const InterfaceResponse response = law.respond(glued, Vector::UnitX(), delta * Vector::UnitX(), history);
    traction.push_back(response.traction.x());
    history = response.history;
  }
  return traction;
}

void expect_along(const std::vector<Point>& points, const std::vector<double>& opening,
                  const std::vector<double>& traction) {
  ASSERT_EQ(points.size(), opening.size());
  double of_traction = 0.0, of_separation = 0.0;  // largest errors
  for (std::size_t i = 0; i < opening.size(); ++i) {
    const double wrong = (points[i].traction - traction[i] * Vector::UnitX()).norm() / strength;
    const double aside = (points[i].separation - opening[i] * Vector::UnitX()).norm() / (toughness / strength);
    EXPECT_LT(wrong, 1e-11) << i;
    EXPECT_LT(aside, 1e-11) << i;
    of_traction = std::max(of_traction, wrong), of_separation = std::max(of_separation, aside);
  }
  report_row("in series", {{"traction", of_traction}, {"separation", of_separation}});
}

class BlocksBeside : public testing::TestWithParam<Beside> {};

TEST_P(BlocksBeside, AreInSeriesWithTheFace) {
  const Beside& beside = GetParam();
  const Mesh mesh = mesh_of(beside);
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  const std::vector<double> opening = openings(law), traction = tractions(law, opening);
  std::vector<Vector> path;
  for (std::size_t i = 0; i < opening.size(); ++i)
    path.emplace_back((opening[i] + 2.0 * edge * traction[i] / beside.modulus) * Vector::UnitX());
  FractureModel model = model_of(beside, mesh, law);
  model.boundary = drawn(mesh, beside, path);
  ASSERT_FALSE(model.interfaces[0].faces.empty());
  expect_along(step_through(mesh, model, path.size() - 1,
                            {.equilibrium_tolerance = 1e-12, .linear = &linear_solver(beside.linear)}),
               opening, traction);
}

const double squeezed = from_young_poisson(1e9, 0.49).constrained_modulus(),
             confined = from_young_poisson(1e9, 0.3).constrained_modulus();
const Beside beside[] = {
    {.name = "plane_stress", .nu = 0.3, .modulus = 1e9 / (1.0 - 0.09), .is_plate = true},
    {.name = "plane_stress_direct", .nu = 0.3, .modulus = 1e9 / (1.0 - 0.09), .is_plate = true, .linear = "direct"},
    {.name = "nearly_incompressible_confined", .nu = 0.49, .modulus = squeezed},
    {.name = "nearly_incompressible_free", .nu = 0.49, .modulus = 1e9, .has_free_sides = true},
    {.name = "nearly_incompressible_direct", .nu = 0.49, .modulus = 1e9, .has_free_sides = true, .linear = "direct"},
    {.name = "spectral", .nu = 0.3, .modulus = 1e9, .has_free_sides = true, .split = "spectral"},
    {.name = "no_tension", .nu = 0.3, .modulus = 1e9, .has_free_sides = true, .split = "no_tension"},
    {.name = "spectral_plane_stress", .nu = 0.3, .modulus = 1e9 / (1.0 - 0.09), .is_plate = true, .split = "spectral"},
    {.name = "no_tension_direct", .nu = 0.3, .modulus = confined, .split = "no_tension", .linear = "direct"},
    {.name = "spectral_polyhedra",
     .nu = 0.3,
     .modulus = 1e9,
     .has_free_sides = true,
     .of_polyhedra = true,
     .split = "spectral"},
    {.name = "polyhedra", .nu = 0.3, .modulus = 1e9, .has_free_sides = true, .of_polyhedra = true},
    {.name = "nearly_incompressible_polyhedra",
     .nu = 0.49,
     .modulus = 1e9,
     .has_free_sides = true,
     .of_polyhedra = true},
    {.name = "direct", .nu = 0.3, .modulus = confined, .linear = "direct"},
    {.name = "multigrid", .nu = 0.3, .modulus = confined, .linear = "multigrid"},
};

INSTANTIATE_TEST_SUITE_P(All, BlocksBeside, testing::ValuesIn(beside),
                         [](const auto& test) { return std::string(test.param.name); });

// Strains of a material point held at its sides, at which it has these stresses along x, by bisection.
std::vector<double> strains_of(const Material& material, const std::vector<double>& stress) {
  std::vector<double> strains, history(material.history_size()), after(history);
  material.start(history);
  Tensor from = Tensor::Zero();
  for (const double due : stress) {
    double low = -0.1, high = 0.1;
    Tensor to = Tensor::Zero();
    for (int i = 0; i < 100; ++i) {
      to(0, 0) = 0.5 * (low + high);
      (material.update({from, to, 1.0, history}, after).stress(0, 0) < due ? low : high) = to(0, 0);
    }
    strains.push_back(to(0, 0));
    from = to;
    history = after;
  }
  return strains;
}

class BlocksWithAHistory : public testing::TestWithParam<Beside> {};

TEST_P(BlocksWithAHistory, AreInSeriesWithTheFace) {
  const IsotropicElasticity elasticity = from_young_poisson(1e9, GetParam().nu);
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  std::vector<double> opening = openings(law);
  opening.insert(opening.begin() + 1, {0.25 * strength / stiffness, 0.999 * strength / stiffness});
  const std::vector<double> traction = tractions(law, opening);
  const Mesh mesh = mesh_of(GetParam());
  for (const auto& material :
       {make_j2_plasticity(elasticity, {.yield_stress = 5e5, .isotropic_hardening = 1e8, .kinematic_hardening = 5e7}),
        make_endochronic_material({.elasticity = elasticity, .kernel = {{5e8, 1000.0}}, .hardening = {}})}) {
    const std::vector<double> strain = strains_of(*material, traction);
    EXPECT_GT(strain[2], 1.05 * traction[2] / elasticity.constrained_modulus());
    std::vector<Vector> path;
    for (std::size_t i = 0; i < opening.size(); ++i)
      path.emplace_back((opening[i] + 2.0 * edge * strain[i]) * Vector::UnitX());
    FractureModel model = model_of(GetParam(), mesh, law);
    for (RegionModel& region : model.regions) region.material = material;
    model.boundary = drawn(mesh, GetParam(), path);
    expect_along(
        step_through(mesh, model, path.size() - 1, {.energy_tolerance = 1e-14, .equilibrium_tolerance = 1e-13}),
        opening, traction);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BlocksWithAHistory,
                         testing::Values(Beside{.name = "hexahedra", .nu = 0.3, .modulus = 0.0},
                                         Beside{.name = "polyhedra", .nu = 0.3, .modulus = 0.0, .of_polyhedra = true}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::verification::this_file
