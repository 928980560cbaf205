// Surface energy of straight cracks at any angle to the rows of a mesh: their cells are broken, the damage beside them
// takes the profile of least energy. In a continuous body it is Gc per area at every angle.

#include "mesh/search/flat_surface.h"
#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/cracks/unit_toughness.h"
#include "tests/verification/near_field.h"
#include "tests/verification/support.h"

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

struct StraightCrack {
  double angle = 0.0;   // to x, about z [degrees]
  double offset = 0.0;  // from the middle of the unit square
};

// Surface energy per length and thickness about the middle of a crack through the unit square, over Gc: a mean with a
// weight that falls to zero at its ends.
double energy_of(const Mesh& mesh, double thickness, const FractureModel& model, const Vector& plane_normal,
                 const StraightCrack& crack) {
  const double angle = crack.angle * std::numbers::pi / 180.0;
  const Vector along(std::cos(angle), std::sin(angle), 0.0), up(-along.y(), along.x(), 0.0);
  const Vector middle = Vector(0.5, 0.5, 0.0) + crack.offset * up;
  CellField<double> d(mesh.n_cells(), 0.0);
  for (const Index c : cells_on(mesh, strip(middle - 2.0 * along, middle + 2.0 * along, Vector::UnitZ()))) d[c] = 1.0;
  DamageEquation equation(mesh, model, plane_normal);
  d = equation.relaxed(d);
  equation.renewed_fracture_energy(d);
  const CellField<double> density = equation.fracture_energy_density(d);
  constexpr double half = 0.3, ramp = 0.15;
  double energy = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double at = std::abs(along.dot(mesh.cell_centre[c] - middle));
    energy += std::clamp((half - at) / ramp, 0.0, 1.0) * density[c] * mesh.cell_volume[c];
  }
  return energy / (Gc * thickness * (2.0 * half - ramp));
}

struct Range {
  double least = 1e300, most = 0.0;
};

// Over angles, each with the mean of two places between the cells.
Range energies(const std::string& label, const Mesh& mesh, double thickness, const std::string& law, double h,
               double n_cells_per_ell, const Vector& plane_normal, const std::vector<double>& angles) {
  const FractureModel model = model_of(law, n_cells_per_ell * h);
  Range range;
  std::vector<std::pair<std::string, double>> row;
  for (const double angle : angles) {
    double mean = 0.0;
    for (const double offset : {0.03, 0.37})
      mean += energy_of(mesh, thickness, model, plane_normal, {.angle = angle, .offset = offset * h}) / 2.0;
    row.emplace_back(fmt::format("{:g} degrees", angle), mean);
    range.least = std::min(range.least, mean);
    range.most = std::max(range.most, mean);
  }
  report_row(fmt::format("{}, {}, ell/h = {:g}", label, law, n_cells_per_ell), row);
  return range;
}

const std::vector<double> some_angles{0.0, 10.0, 20.0, 30.0, 45.0};

// A staircase of cells that meet at faces would cost h/(2 ell) more than a row (AT2).
TEST(CrackDirections, CostTheSameOnHexahedra) {
  constexpr Index n_cells = 61;
  constexpr double h = 1.0 / n_cells;
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, n_cells, 1.0}}, {{1.0, n_cells, 1.0}}, {{h, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  for (const auto& [law, cells, most] : {std::tuple{"AT2", 2.0, 1.075},
                                         {"AT2", 3.0, 1.045},
                                         {"AT2", 4.0, 1.033},
                                         {"AT1", 2.0, 1.06},
                                         {"AT1", 3.0, 1.04},
                                         {"AT1", 4.0, 1.03},
                                         {"Wu", 2.0, 1.05},
                                         {"Wu", 3.0, 1.04},
                                         {"Wu", 4.0, 1.03}}) {
    const Range range = energies("hexahedra", mesh, h, law, h, cells, Vector::UnitZ(), some_angles);
    EXPECT_LE(range.most, most) << law << ", ell/h = " << cells;
    EXPECT_GE(range.least, 0.98) << law << ", ell/h = " << cells;
  }
}

TEST(CrackDirections, CostTheSameOnPrisms) {
  constexpr Index n_cells = 45;
  constexpr double h = 1.0 / n_cells;
  const Mesh mesh = extruded_triangles(n_cells, {0.0, h});
  for (const std::string law : {"AT2", "AT1", "Wu"}) {
    const Range range = energies("prisms", mesh, h, law, h, 3.0, Vector::UnitZ(), {0.0, 20.0, 45.0, 70.0, 135.0});
    EXPECT_LE(range.most, 1.06) << law;
    EXPECT_GE(range.least, 0.94) << law;
  }
}

TEST(CrackDirections, CostTheSameOnTetrahedraAndPolyhedra) {
  constexpr double h = 1.0 / 20.0, thickness = 0.2;
  ParticlesInBoxSettings settings;
  settings.upper = {1.0, 1.0, thickness};
  settings.boundary_size = h;
  settings.size_far = h;
  const Mesh mesh = make_particles_in_box(settings), dual = barycentric_dual(mesh);
  for (const auto& [label, cells, most] : {std::tuple{"tetrahedra", &mesh, 1.03}, {"polyhedra", &dual, 1.1}}) {
    const Range range = energies(label, *cells, thickness, "AT2", h, 3.0, Vector::Zero(), {0.0, 20.0, 45.0});
    EXPECT_LE(range.most, most) << label;
    EXPECT_LE(range.most, 1.02 * range.least) << label;
  }
}

// Twice the energy of half a crack, whose cells have a face in a plane of symmetry: as a crack of [initial] there.
TEST(CrackDirections, CostTheSameInAPlaneOfSymmetryOfTetrahedra) {
  constexpr double h = 1.0 / 16.0, height = 1.0, side = 0.5;
  ParticlesInBoxSettings settings;
  settings.upper = {side, side, height};
  settings.boundary_size = h;
  settings.size_far = h;
  const Mesh mesh = make_particles_in_box(settings);
  for (const double cells : {2.0, 3.0}) {
    FractureModel model = model_of("AT2", cells * h);
    model.boundary = {symmetry_on("zmin")};
    CellField<double> d(mesh.n_cells(), 0.0);
    for (const Index c : cells_on(mesh, disc(Vector::Zero(), Vector::UnitZ(), 10.0))) d[c] = 1.0;
    DamageEquation equation(mesh, model, Vector::Zero());
    d = equation.relaxed(d);
    const double energy = 2.0 * equation.renewed_fracture_energy(d) / (Gc * side * side);
    report_row("tetrahedra beside a plane of symmetry", {{"ell/h", cells}, {"energy", energy}});
    EXPECT_NEAR(energy, 1.0, 0.3 / cells);
  }
}

// A crack of AT1 in 61 x 61 hexahedra, ell = 3 h, that follows a moving near field of mode I with G = Gc at an angle to
// their rows. It ought to keep that direction and to spend Gc.
struct Followed {
  double direction = 0.0;  // from where the field began to the foremost broken cell [degrees]
  double spent = 0.0;      // over Gc and the way of the field, after the first two ell
  double lost = 0.0;       // likewise: work that is neither stored nor spent
  Index iterations = 0;
};

Followed follow(double degrees) {
  constexpr Index n_cells = 61;
  constexpr double h = 1.0 / n_cells, ell = 3.0 * h, way = 7.0 * ell, step = ell;
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vector along(std::cos(angle), std::sin(angle), 0.0), up(-along.y(), along.x(), 0.0);
  const Vector begin = Vector(0.5, 0.5, 0.0) - 0.25 * along;
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, n_cells, 1.0}}, {{1.0, n_cells, 1.0}}, {{h, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  const IsotropicElasticity elasticity = from_young_poisson(1.0, 0.3);
  FractureModel model = model_of("AT1", ell);
  model.regions[0].elasticity = elasticity;
  model.stiffness_by = StiffnessBy::mean;
  model.boundary = {plane_on("zmin"), plane_on("zmax")};
  const double K = std::sqrt(Gc / (1.0 - 0.3 * 0.3));
  for (const char* side : {"xmin", "xmax", "ymin", "ymax"}) {
    BoundaryCondition moving = displacement_on(side, {});
    moving.value = [=](const Vector& x, double t) -> Vector {
      const Vector from_tip = x - begin - t * way * along;
      const Vector u = near_field(elasticity, Vector(from_tip.dot(along), from_tip.dot(up), 0.0), K);
      return u.x() * along + u.y() * up;
    };
    model.boundary.push_back(moving);
  }
  CellField<double> d(mesh.n_cells(), 0.0);
  for (const Index c : cells_on(mesh, strip(begin - 2.0 * along, begin, Vector::UnitZ()))) d[c] = 1.0;
  model.initial_damage = DamageEquation(mesh, model, Vector::UnitZ()).relaxed(d);
  FractureRun run(mesh, model, {},
                  {.end = 1.0, .initial_increment = step / way, .maximum_increment = step / way, .stops = {}});
  Followed result;
  double first_load = 0.0;
  EnergyAccount first;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
    result.iterations += report.staggered_iterations;
    if (first_load == 0.0 && report.load * way > 1.9 * ell) first_load = report.load, first = report.energy;
    if (first_load == 0.0 || report.load == first_load) return;
    const double all = Gc * h * way * (report.load - first_load);
    const EnergyAccount& now = report.energy;
    result.spent = (now.fracture - first.fracture) / all;
    result.lost = (now.external_work - now.elastic - (first.external_work - first.elastic)) / all - result.spent;
  });
  const CellField<double> broken = run.output(end).damage;
  Vector foremost = begin;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (broken[c] > 0.95 && along.dot(mesh.cell_centre[c] - foremost) > 0.0) foremost = mesh.cell_centre[c];
  foremost -= begin;
  result.direction = std::atan2(foremost.y(), foremost.x()) * 180.0 / std::numbers::pi;
  return result;
}

// By the cells' own damage one at 20 degrees turns to 7 and spends 1.085 Gc. Smaller angles remain too small.
TEST(CrackDirections, GrowingCracksKeepTheirsByTheMeanDamage) {
  for (const double angle : {20.0, 45.0}) {
    const Followed crack = follow(angle);
    report_row(fmt::format("{:g} degrees", angle), {{"direction", crack.direction},
                                                    {"spent over Gc", crack.spent},
                                                    {"lost", crack.lost},
                                                    {"iterations", static_cast<double>(crack.iterations)}});
    EXPECT_NEAR(crack.direction, angle, 3.0) << angle;
    EXPECT_NEAR(crack.spent, 1.0, 0.06) << angle;
    EXPECT_NEAR(crack.lost, 0.0, 0.03) << angle;
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
