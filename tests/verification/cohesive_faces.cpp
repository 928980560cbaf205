// Cohesive faces without thickness. Two blocks and one face: each law, loaded, unloaded and closed, against springs in
// series; what may stand beside the face; mixed modes; sliding with friction. A sphere under hydrostatic tension
// against Lame's shells. A double cantilever beam against the corrected beam.

#include "mesh/dual.h"
#include "mesh/geometry.h"
#include "mesh/sphere_sector.h"
#include "physics/materials/endochronic_material.h"
#include "physics/materials/j2_plasticity.h"
#include "physics/registry.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::verification {
namespace {

constexpr double edge = 1e-3;                        // of a block [m]
constexpr double strength = 2e6, toughness = 400.0;  // [Pa], [J/m^2]
constexpr double stiffness = 5e12;                   // of the straight rise [Pa/m]
const IsotropicElasticity block = from_young_poisson(1e9, 0.0);

InterfaceLaw law_of(const TractionSeparationLaw& law, std::string_view mode = "camacho_ortiz") {
  InterfaceLaw interface { .law = &law, .mixed_mode = &find_by_name(mixed_modes(), mode, "mixed mode") };
  for (std::size_t i = law.has_rise() ? 1 : 0; i < law.shape.size(); ++i) interface.shape.push_back(law.shape[i].first);
  return interface;
}

std::vector<Index> faces_between(const Mesh& mesh, const std::function<bool(const Vector&)>& counts) {
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f)
    if (counts(mesh.face_centre[f])) faces.push_back(f);
  return faces;
}

void glue(FractureModel& model, const Mesh& mesh, const InterfaceLaw& law, const InterfaceStrength& at,
          const Vector& along, const std::function<bool(const Vector&)>& counts) {
  CohesiveSurface surface{.name = "glue", .law = law, .faces = faces_between(mesh, counts)};
  for (const Index f : surface.faces) {
    surface.sign.push_back(mesh.face_area[f].dot(along) > 0.0 ? 1.0 : -1.0);
    surface.at.push_back(at);
  }
  model.interfaces.push_back(std::move(surface));
}

// Two blocks side by side along x, of n cells each, glued at x = edge.
Mesh two_blocks(Index n) {
  BoxHexesSettings box;
  box.axes[0] = {{2.0 * edge, 2 * n, 1.0}};
  box.axes[1] = {{edge, n, 1.0}};
  box.axes[2] = {{edge, n, 1.0}};
  return make_box_hexes(box);
}

std::size_t mesh_patch(const Mesh& mesh, const std::string& name) {
  return static_cast<std::size_t>(&mesh.patch(name) - mesh.patches.data());
}

constexpr InterfaceStrength glued{.strength = strength,
                                  .toughness = toughness,
                                  .shear_strength = 3e6,
                                  .shear_toughness = 700.0,
                                  .stiffness = stiffness};

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

FractureModel glued_blocks(const Mesh& mesh, const InterfaceLaw& law) {
  FractureModel model = elastic_model({block}, {});
  glue(model, mesh, law, glued, Vector::UnitX(), [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
  return model;
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
    path.push_back((x * length + compliance * expected.back()) * Vector::UnitX());
  }
  for (const double part : {0.5, 1e-9}) {  // unload to the origin
    opening.push_back(part * opening[5]), expected.push_back(part * expected[5]);
    path.push_back(part * path[5]);
  }
  const double pressure = 1e5;  // close
  opening.push_back(-pressure / law.initial_stiffness(glued)), expected.push_back(-pressure);
  path.push_back((opening.back() - compliance * pressure) * Vector::UnitX());
  const std::vector<Point> points = pull(law, path);
  ASSERT_EQ(points.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(points[i].traction.x(), expected[i], 1e-10 * strength) << i;
    EXPECT_NEAR(points[i].separation.x(), opening[i], 1e-10 * length) << i;
  }
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
  for (std::size_t i = 0; i < opening.size(); ++i) {
    EXPECT_LT((points[i].traction - traction[i] * Vector::UnitX()).norm(), 1e-8 * strength) << i;
    EXPECT_LT((points[i].separation - opening[i] * Vector::UnitX()).norm(), 1e-8 * toughness / strength) << i;
  }
}

class BlocksBeside : public testing::TestWithParam<Beside> {};

TEST_P(BlocksBeside, AreInSeriesWithTheFace) {
  const Beside& beside = GetParam();
  const Mesh mesh = mesh_of(beside);
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  const std::vector<double> opening = openings(law), traction = tractions(law, opening);
  std::vector<Vector> path;
  for (std::size_t i = 0; i < opening.size(); ++i)
    path.push_back((opening[i] + 2.0 * edge * traction[i] / beside.modulus) * Vector::UnitX());
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
      path.push_back((opening[i] + 2.0 * edge * strain[i]) * Vector::UnitX());
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

Mesh long_blocks(double length) {
  BoxHexesSettings box;
  box.axes[0] = {{2.0 * length, 8, 1.0}};
  box.axes[1] = box.axes[2] = {{0.2 * length, 2, 1.0}};
  return make_box_hexes(box);
}

FractureModel long_model(const Mesh& mesh, const InterfaceLaw& law, double length, double end) {
  FractureModel model = elastic_model({block}, {});
  glue(model, mesh, law, glued, Vector::UnitX(),
       [&](const Vector& x) { return std::abs(x.x() - length) < 1e-9 * length; });
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {true, true, true},
                          [end](const Vector&, double t) -> Vector { return t * end * Vector::UnitX(); })};
  return model;
}

// Blocks so long that the end moves back while the face softens, u = delta + 2 L T/E: the whole branch is traced.
TEST(LongBlocks, SnapBackAlongTheLaw) {
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  const double block_length = 3.0 * toughness / strength * 1e9 / strength;  // 2 L/E is three times the slope's inverse
  const Mesh mesh = long_blocks(block_length);
  const double compliance = 2.0 * block_length / 1e9, area = 0.04 * block_length * block_length;
  const double peak = compliance * strength + strength / stiffness;
  const FractureModel model = long_model(mesh, law, block_length, peak);
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-9},
                  {.end = 1.3,
                   .initial_increment = 0.1,
                   .maximum_increment = 0.1,
                   .maximum_dissipation = 0.05 * toughness * area,
                   .stops = {}});
  double worst = 0.0, furthest_back = 1.0, dissipated = 0.0;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    const OutputFields fields = run.output(state);
    const double opening = fields.interfaces[0].opening[0],
                 traction = report.reaction[mesh_patch(mesh, "xmax")].x() / area;
    const double due = law.respond(glued, Vector::UnitX(), opening * Vector::UnitX(), {}).traction.x();
    worst = std::max(
        {worst, std::abs(traction - due) / strength, std::abs(state.load * peak - opening - compliance * due) / peak});
    if (report.energy.interface_dissipation > 0.0) furthest_back = std::min(furthest_back, state.load);
    dissipated = report.energy.interface_dissipation;
  });
  const double final_opening = 2.0 * toughness / strength;
  report_row("long blocks", {{"largest error of traction and displacement", worst},
                             {"least load on the way back", furthest_back},
                             {"closed form", final_opening / peak},
                             {"dissipated/Gc", dissipated / (toughness * area)}});
  EXPECT_LE(worst, 1e-6);
  EXPECT_NEAR(furthest_back, final_opening / peak, 0.06);
  EXPECT_NEAR(dissipated, toughness * area, 1e-9 * toughness * area);
}

// Loaded beyond its strength a face lets go at once. Increments by released energy find the peak.
TEST(LongBlocks, LetGoAtThePeakIfIncrementsFollowTheReleasedEnergy) {
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  const double block_length = 3.0 * toughness / strength * 1e9 / strength;
  const Mesh mesh = long_blocks(block_length);
  const double peak = 2.0 * block_length / 1e9 * strength + strength / stiffness;
  const FractureModel model = long_model(mesh, law, block_length, peak);
  const auto largest_traction = [&](double energy_release) {
    FractureRun run(mesh, model, {},
                    {.end = 1.2,
                     .initial_increment = 0.15,
                     .maximum_increment = 0.15,
                     .energy_release = energy_release,
                     .stops = {}});
    double largest = 0.0, last = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      last = report.reaction[mesh_patch(mesh, "xmax")].x() / (0.04 * block_length * block_length);
      largest = std::max(largest, last);
    });
    EXPECT_NEAR(last, 0.0, 1e-6 * strength);
    return largest;
  };
  EXPECT_NEAR(largest_traction(std::numeric_limits<double>::infinity()), 0.9 * strength, 1e-3 * strength);
  EXPECT_NEAR(largest_traction(0.05), strength, 2e-3 * strength);
}

// Cells that can be damaged (AT1) and a face: the weaker one of the two breaks.
class DamageableBlocks : public testing::TestWithParam<std::string_view> {};

TEST_P(DamageableBlocks, BreakWhereTheyAreWeaker) {
  const InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"));
  // With the other splits a bar does not bear sixteen times its strength in one step, with a face or without.
  const double increment = GetParam() == "none" ? 0.1 : 0.02;
  for (const double tough : {100.0, 1.0}) {  // strengths by AT1: 13.7 and 1.37 MPa; that of the face is 2 MPa
    BoxHexesSettings box;
    box.axes[0] = {{2.0 * edge, 40, 1.0}};
    box.axes[1] = box.axes[2] = {{0.2 * edge, 2, 1.0}};
    const Mesh mesh = make_box_hexes(box);
    FractureModel model = glued_blocks(mesh, law);
    model.regions[0] = {.elasticity = block, .Gc = tough, .ell = 0.2 * edge, .damageable = true};
    model.crack = &crack_geometry("AT1");
    model.split = energy_split(GetParam());
    model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                      moved("xmax", {true, true, true}, [](const Vector&, double t) -> Vector {
                        return 1.1 * t * 2.0 * toughness / strength * Vector::UnitX();
                      })};
    FractureRun run(mesh, model, {},
                    {.end = 1.0, .initial_increment = increment, .maximum_increment = increment, .stops = {}});
    const double area = 0.04 * edge * edge;
    double most_damage = 0.0, dissipated = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      most_damage = report.max_damage;
      dissipated = report.energy.interface_dissipation;
    });
    report_row("damageable blocks",
               {{"Gc", tough}, {"largest damage", most_damage}, {"by the face", dissipated / (toughness * area)}});
    if (tough > 10.0) {
      EXPECT_LT(most_damage, 1e-12);
      EXPECT_NEAR(dissipated, toughness * area, 1e-9 * toughness * area);
    } else {
      EXPECT_GT(most_damage, 0.99);
      EXPECT_LT(dissipated, 1e-12 * toughness * area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Splits, DamageableBlocks, testing::Values("none", "spectral", "no_tension"),
                         [](const auto& test) { return std::string(test.param); });

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
  for (std::size_t i = 0; i < separation.size(); ++i) {
    EXPECT_LT((points[i].traction - traction[i]).norm(), 1e-10 * strength) << i;
    EXPECT_LT((points[i].separation - separation[i]).norm(), 1e-10 * length) << i;
  }
  EXPECT_NEAR(points.back().energy.interface_dissipation, (history.dissipated + history.rubbed) * edge * edge,
              1e-10 * toughness * edge * edge);
}

INSTANTIATE_TEST_SUITE_P(Rules, MixedPath, testing::Values("camacho_ortiz", "benzeggagh_kenane", "power_law"),
                         [](const auto& test) { return std::string(test.param); });

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

void expect_lames_shells_and_the_law(const PartOfSphere& part) {
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
  EXPECT_LE(worst_load, 5e-3);
  EXPECT_LE(worst_opening, 5e-3 * final_opening);
  EXPECT_GT(most, final_opening);
}

TEST(SphereWithCohesiveFaces, OpensAsLamesShellsAndTheLaw) { expect_lames_shells_and_the_law(narrow_cone()); }

TEST(SphereWithCohesiveFaces, OpensAlikeInAnAxisymmetricSector) { expect_lames_shells_and_the_law(sector()); }

// The same on tetrahedra and polyhedra: the closed form, of a separation in the law's softening part, prescribed on the
// surface of a cube.
TEST(SphereWithCohesiveFaces, OpensEvenlyInACube) {
  const IsotropicElasticity bead = from_young_poisson(70e9, 0.3), matrix = from_young_poisson(75e6, 0.44);
  constexpr double ft = 2e6, Gc = 1.6e5, opening = 0.5 * 2.0 * Gc / ft, traction = 0.5 * ft;  // radius 1 m
  const double bulk = bead.lambda + 2.0 / 3.0 * bead.mu, inner = traction / (3.0 * bulk) + opening;
  const double three_K = 3.0 * matrix.lambda + 2.0 * matrix.mu, four_mu = 4.0 * matrix.mu;
  const double A = (traction + four_mu * inner) / (three_K + four_mu), B = inner - A;
  const Mesh tetrahedra = sphere_in_cube(5, 0, 3.0, 0.4);
  for (const bool polyhedra : {false, true}) {
    const Mesh mesh = polyhedra ? barycentric_dual(tetrahedra) : tetrahedra;
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
    double area = 0.0, mean_opening = 0.0, mean_traction = 0.0, scatter = 0.0;
    for (std::size_t k = 0; k < interface.faces.size(); ++k) {
      const auto i = static_cast<Index>(k);
      const double part = mesh.face_area[interface.faces[k]].norm();
      area += part;
      mean_opening += part * interface.opening[i];
      mean_traction += part * mesh.face_centre[interface.faces[k]].normalized().dot(interface.traction[i]);
      scatter = std::max(scatter, std::abs(interface.opening[i] / opening - 1.0));
    }
    report_row(polyhedra ? "sphere in a cube, polyhedra" : "sphere in a cube, tetrahedra",
               {{"cells", double(mesh.n_cells())},
                {"mean opening", mean_opening / area / opening},
                {"mean traction", mean_traction / area / traction},
                {"largest error of an opening", scatter}});
    // The error of the stress on so coarse a mesh is 2 to 3 %.
    EXPECT_NEAR(mean_opening / area / opening, 1.0, 0.035);
    EXPECT_NEAR(mean_traction / area / traction, 1.0, 0.035);
  }
}

// A double cantilever beam, 60 mm long with a slit of 30 mm, arms of 2 mm. The corrected beam (Hashemi, Kinloch,
// Williams, Proc. R. Soc. A 427 (1990) 173): D = 8 P (a + chi h)^3/(E' h^3), G = 12 P^2 (a + chi h)^2/(E' h^3) for the
// unit width; at G = Gc the length follows from D.
struct CorrectedBeam {
  static constexpr double E = 126e9, nu = 0.3, height = 2e-3, slit = 30e-3, Gc = 281.0;
  double plane_modulus = E / (1.0 - nu * nu), chi = 0.0;

  CorrectedBeam() {
    const double shear = E / (2.0 * (1.0 + nu)), gamma = 1.18 * plane_modulus / shear;
    chi = std::sqrt(plane_modulus / (11.0 * shear) * (3.0 - 2.0 * std::pow(gamma / (1.0 + gamma), 2)));
  }
  double force(double opening) const {
    const double from = slit + chi * height, h3 = std::pow(height, 3);
    const double grown = std::pow(3.0 * plane_modulus * h3 * opening * opening / (16.0 * Gc), 0.25);
    return opening * plane_modulus * h3 / (8.0 * std::pow(std::max(from, grown), 3));
  }
  double opening_at_start() const {
    return std::pow(slit + chi * height, 2) * std::sqrt(16.0 * Gc / (3.0 * plane_modulus * std::pow(height, 3)));
  }
};

TEST(CantileversWithCohesiveFaces, PeelAsTheCorrectedBeam) {
  const CorrectedBeam beam;
  constexpr double width = 1e-3, h = beam.height, strength_of_glue = 120e6;
  BoxHexesSettings box;
  box.axes[0] = {{29e-3, 55, 1.0}, {9e-3, 36, 1.0}, {22e-3, 15, 10.0}};
  box.axes[1] = {{2.0 * h, 12, 1.0}};
  box.axes[2] = {{width, 1, 1.0}};
  box.slits = {{.name = "slit", .lower = {-1.0, h, -1.0}, .upper = {beam.slit, h, 1.0}}};
  box.patches = {{.name = "upper", .lower = {-1.0, h, -1.0}, .upper = {1e-9, 3.0 * h, 1.0}},
                 {.name = "lower", .lower = {-1.0, -h, -1.0}, .upper = {1e-9, h, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  const double end = 1.4 * beam.opening_at_start();
  FractureModel model = elastic_model({from_young_poisson(beam.E, beam.nu)}, {plane_on("zmin"), plane_on("zmax")});
  for (const double side : {1.0, -1.0})
    model.boundary.push_back(moved(side > 0.0 ? "upper" : "lower", {false, true, false},
                                   [=](const Vector&, double t) { return Vector(0.0, 0.5 * side * end * t, 0.0); }));
  model.boundary.push_back(displacement_on("xmax", [](const Vector&) -> Vector { return Vector::Zero(); }));
  glue(model, mesh, law_of(find_by_name(traction_separation_laws(), "linear", "law")),
       {.strength = strength_of_glue, .toughness = beam.Gc}, Vector::UnitY(),
       [&](const Vector& x) { return std::abs(x.y() - h) < 1e-9; });
  FractureRun run(mesh, model, {}, {.end = 1.0, .initial_increment = 0.04, .maximum_increment = 0.04, .stops = {}});
  EXPECT_TRUE(run.interface_warnings().empty());
  double peak = 0.0, worst = 0.0;
  const auto upper = static_cast<std::size_t>(&mesh.patch("upper") - mesh.patches.data());
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    const double force = report.reaction[upper].y() / width, opening = end * state.load;
    peak = std::max(peak, force);
    if (opening > 1.2 * beam.opening_at_start()) worst = std::max(worst, std::abs(force / beam.force(opening) - 1.0));
  });
  report_row("double cantilever beam with cohesive faces",
             {{"peak over the corrected beam's", peak / beam.force(beam.opening_at_start())},
              {"largest error in propagation", worst}});
  EXPECT_NEAR(peak / beam.force(beam.opening_at_start()), 1.0, 0.03);
  EXPECT_LE(worst, 0.03);
}

}  // namespace
}  // namespace pfdm::verification
