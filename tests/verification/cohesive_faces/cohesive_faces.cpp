// Cohesive faces without thickness, between two blocks: each law, loaded, unloaded and closed, against springs in
// series; what may stand beside the face; mixed modes; sliding with friction.

#include "mesh/dual.h"
#include "mesh/geometry.h"
#include "physics/materials/endochronic_material.h"
#include "physics/materials/j2_plasticity.h"
#include "tests/verification/cohesive_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

struct Point {
  Vector traction, separation;
  EnergyAccount energy;
};

// Steps through the values 1, 2 ... of the load parameter.
std::vector<Point> step_through(const Mesh& mesh, const FractureModel& model, std::size_t n_steps,
                                const StaggeredSettings& settings = {.equilibrium_tolerance = 1e-12}) {
  FractureRun run(mesh, model, settings,
                  {.end = double(n_steps),
                   .initial_increment = 1.0,
                   .minimum_increment = 1.0,
                   .maximum_increment = 1.0,
                   .stops = {}});
  std::vector<Point> points;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    const OutputFields fields = run.output(state);
    const OutputInterface& interface = fields.interfaces[0];
    Point point{.traction = Vector::Zero(), .separation = Vector::Zero(), .energy = report.energy};
    for (Index i = 0; i < interface.separation.size(); ++i) {
      point.traction += interface.traction[i] / double(interface.separation.size());
      point.separation += interface.separation[i] / double(interface.separation.size());
    }
    points.push_back(point);
  });
  return points;
}

const Vector& entry(const std::vector<Vector>& path, double t) {
  return path[std::min(static_cast<std::size_t>(std::lround(t)), path.size() - 1)];
}

// The left end is held, the right one moved along a path of displacements, one step each.
std::vector<Point> pull(const InterfaceLaw& law, const std::vector<Vector>& path) {
  const Mesh mesh = two_blocks(2);
  FractureModel model = glued_blocks(mesh, law);
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {true, true, true}, [&](const Vector&, double t) { return entry(path, t); })};
  return step_through(mesh, model, path.size() - 1);
}

// The whole surface moves as it does where the separations and tractions across x = edge are these: uniform strains.
std::vector<Point> lead(const InterfaceLaw& law, const std::vector<Vector>& separation,
                        const std::vector<Vector>& traction) {
  const Mesh mesh = two_blocks(3);
  FractureModel model = glued_blocks(mesh, law);
  const auto displacement = [&](const Vector& x, double t) -> Vector {
    const Vector& T = entry(traction, t);
    const Vector strain(T.x() / block.constrained_modulus(), T.y() / block.mu, T.z() / block.mu);
    return x.x() * strain + (x.x() > edge ? entry(separation, t) : Vector::Zero());
  };
  for (const Patch& patch : mesh.patches) model.boundary.push_back(moved(patch.name, {true, true, true}, displacement));
  return step_through(mesh, model, separation.size() - 1);
}

class TwoBlocks : public testing::TestWithParam<TractionSeparationLaw> {};

// Displacement and traction of blocks and law in series: u = delta + 2 L T / E.
TEST_P(TwoBlocks, AreTheLawInSeriesWithThem) {
  const InterfaceLaw law = law_of(GetParam());
  const double length = toughness / strength, compliance = 2.0 * edge / 1e9;
  const auto traction = [&](double opening) {
    return law.respond(glued, Vector::UnitX(), opening * Vector::UnitX(), {}).traction.x();
  };
  std::vector<Vector> path{Vector::Zero()};
  std::vector<double> opening{0.0}, expected{0.0};
  for (const double x : {0.001, 0.05, 0.3, 0.8, 1.5}) {
    opening.push_back(x * length), expected.push_back(traction(x * length));
    path.emplace_back((x * length + compliance * expected.back()) * Vector::UnitX());
  }
  for (const double part : {0.5, 1e-9}) {  // unload to the origin
    opening.push_back(part * opening[5]), expected.push_back(part * expected[5]);
    path.emplace_back(part * path[5]);
  }
  const double pressure = 1e5;  // close
  opening.push_back(-pressure / law.initial_stiffness(glued)), expected.push_back(-pressure);
  path.emplace_back((opening.back() - compliance * pressure) * Vector::UnitX());
  const std::vector<Point> points = pull(law, path);
  ASSERT_EQ(points.size(), path.size());
  double of_traction = 0.0, of_separation = 0.0;  // largest errors
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(points[i].traction.x(), expected[i], 1e-12 * strength) << i;
    EXPECT_NEAR(points[i].separation.x(), opening[i], 1e-12 * length) << i;
    of_traction = std::max(of_traction, std::abs(points[i].traction.x() - expected[i]) / strength);
    of_separation = std::max(of_separation, std::abs(points[i].separation.x() - opening[i]) / length);
  }
  report_row("two blocks", {{"traction", of_traction}, {"separation", of_separation}});
  const double dissipated = law.respond(glued, Vector::UnitX(), opening[5] * Vector::UnitX(), {}).history.dissipated;
  EXPECT_NEAR(points.back().energy.interface_dissipation, dissipated * edge * edge, 1e-10 * toughness * edge * edge);
}

INSTANTIATE_TEST_SUITE_P(Laws, TwoBlocks, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

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

// Opened and sheared in changing proportion, unloaded, closed and slid to and fro.
class MixedPath : public testing::TestWithParam<std::string_view> {};

TEST_P(MixedPath, IsTheLaws) {
  InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"), GetParam());
  law.friction = 0.4;
  law.exponent = law.depends_on_mode() ? 1.8 : 1.0;
  law.shear_ratio = law.depends_on_mode() ? 1.0 : 0.7;
  const double length = toughness / strength, K = law.initial_stiffness(glued);
  const std::vector<Vector> separation{Vector::Zero(),
                                       length * Vector(0.1, 0.05, 0.0),
                                       length * Vector(0.3, 0.4, 0.1),
                                       length * Vector(0.05, 0.1, 0.05),
                                       length * Vector(0.2, 0.7, -0.1),
                                       Vector(-1e5 / K, 0.8 * length, 0.0),
                                       Vector(-1e5 / K, 0.9 * length, 0.1 * length),
                                       Vector(-2e5 / K, 0.5 * length, 0.0)};
  std::vector<Vector> traction;
  InterfaceHistory history;
  for (const Vector& delta : separation) {
    const InterfaceResponse response = law.respond(glued, Vector::UnitX(), delta, history);
    traction.push_back(response.traction);
    history = response.history;
  }
  const std::vector<Point> points = lead(law, separation, traction);
  ASSERT_EQ(points.size(), separation.size());
  double of_traction = 0.0, of_separation = 0.0;  // largest errors
  for (std::size_t i = 0; i < separation.size(); ++i) {
    const double wrong = (points[i].traction - traction[i]).norm() / strength;
    const double aside = (points[i].separation - separation[i]).norm() / length;
    EXPECT_LT(wrong, 3e-12) << i;
    EXPECT_LT(aside, 1e-12) << i;
    of_traction = std::max(of_traction, wrong), of_separation = std::max(of_separation, aside);
  }
  report_row("mixed path", {{"traction", of_traction}, {"separation", of_separation}});
  EXPECT_NEAR(points.back().energy.interface_dissipation, (history.dissipated + history.rubbed) * edge * edge,
              1e-10 * toughness * edge * edge);
}

INSTANTIATE_TEST_SUITE_P(Rules, MixedPath,
                         testing::Values("camacho_ortiz", "equal_stiffness", "benzeggagh_kenane", "power_law"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace pfdm::verification::this_file
