// A glass sphere in Sylgard under hydrostatic tension with a cohesive crack in a thin band around it: the law that
// columns extract along the radius, and from which radius on the interface snaps, against the closed form
// (literature.md 4.3, here with the band's and the shell's own thickness).
//
// A slender cone of the sphere, two cells wide, between planes of symmetry through its centre: all is a function of r.
// The band's Poisson's ratio is 0 and its modulus small, so that the strain along the surface, separation over radius,
// adds nothing to what drives the damage across it; at the least radius that snaps the strain in Sylgard itself would.

#include "mesh/geometry.h"
#include "postproc/cohesive/cohesive_law.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include "physics/damage/softening_law.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

constexpr double Gc = 10.0, ft = 2e6, ell = 2e-6;   // [J/m^2], [Pa], [m]
constexpr double final_separation = 2.0 * Gc / ft;  // of the linear law
constexpr double band_width = 3.25 * ell;           // a little more than the crack's pi ell
constexpr double band_modulus = 7.5e6;              // [Pa]
constexpr double half_angle = 0.005;                // of the cone

const IsotropicElasticity glass = from_young_poisson(70e9, 0.3), sylgard = from_young_poisson(75e6, 0.44),
                          soft = from_young_poisson(band_modulus, 0.0);

/// What a shell of the radii from ... to has to be told and tells.
struct Shell {
  double from, to;
  IsotropicElasticity elasticity;
};

/// Bead (its core of half the radius is rigid), band, matrix.
struct Layers {
  explicit Layers(double a)
      : core(0.5 * a), bead{core, a, glass}, band{a, a + band_width, soft}, matrix{band.to, 4.0 * a, sylgard} {}
  double crack() const { return 0.5 * (band.from + band.to); }
  double core;
  Shell bead, band, matrix;
};

/// Radial displacement [m] and stress [Pa].
struct Radial {
  double u, stress;
};

/// u = A r + B/r^2, stress = 3 K A - 4 mu B/r^3: from one radius to another.
Radial carried(const Radial& at, double from, double to, const IsotropicElasticity& elasticity) {
  const double three_K = 3.0 * elasticity.lambda + 2.0 * elasticity.mu, four_mu = 4.0 * elasticity.mu;
  const double A = (at.stress + four_mu * at.u / from) / (three_K + four_mu);
  const double B = (at.u - A * from) * from * from;
  return {A * to + B / (to * to), three_K * A - four_mu * B / (to * to * to)};
}

/// separation = per_load * p - per_traction * T: p acts on the outside of the matrix, T on the crack.
struct Compliance {
  double per_load, per_traction;  // [m/Pa]
  double load_at(double separation) const {
    const double traction = ft * std::max(0.0, 1.0 - separation / final_separation);
    return (separation + per_traction * traction) / per_load;
  }
};

Compliance compliance_of(double a) {
  const Layers layers(a);
  const auto outwards = [&](const Radial& at_crack) {
    const Radial outer = carried(at_crack, layers.crack(), layers.band.to, soft);
    return carried(outer, layers.matrix.from, layers.matrix.to, sylgard).stress;
  };
  const Radial surface = carried({0.0, 1.0}, layers.core, a, glass);
  const Radial inside = carried(surface, a, layers.crack(), soft);
  const double of_u = outwards({1.0, 0.0}), of_T = outwards({0.0, 1.0});  // p = of_u u + of_T T
  return {.per_load = 1.0 / of_u, .per_traction = of_T / of_u + inside.u / inside.stress};
}

/// The least radius at which the load falls while the interface softens with so much traction per separation [Pa/m].
double snapping_radius(double slope) {
  double low = 1e-5, high = 1e-2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (compliance_of(middle).per_traction * slope < 1.0 ? low : high) = middle;
  }
  return low;
}

Mesh cone(double a) {
  const Layers layers(a);
  constexpr Index band_cells = 65;
  BoxHexesSettings box;
  box.origin = {layers.core, -1.0, -1.0};
  box.axes[0] = {
      {0.5 * a, 10, 0.02}, {band_width, band_cells, 1.0}, {layers.matrix.to - layers.matrix.from, 40, 300.0}};
  box.axes[1] = {{2.0, 2, 1.0}};
  box.axes[2] = {{2.0, 1, 1.0}};
  box.base_region = "matrix";
  const auto shell = [](const std::string& name, double from, double to) -> SubRegion {
    return {.name = name, .lower = {from, -2.0, -2.0}, .upper = {to, 2.0, 2.0}};
  };
  box.regions = {shell("bead", 0.0, a), shell("interface", a, a + band_width)};
  Mesh mesh = make_box_hexes(box);
  for (Vector& x : mesh.points) x = x[0] * Vector(1.0, half_angle * x[1], half_angle * x[2]);
  compute_geometry(mesh);
  return mesh;
}

RegionModel band_model(double strength) {
  return {.elasticity = soft,
          .Gc = Gc,
          .ell = ell,
          .damageable = true,
          .degradation =
              rational_degradation(rational_coefficients(softening_law("linear"), band_modulus, Gc, strength, ell))};
}

/// The strength falls outwards as the traction does, and a little more at the band's middle, so that the crack is
/// there.
FractureModel model_on(const Mesh& mesh, const Layers& layers, double largest_load) {
  FractureModel model;
  for (const std::string& name : mesh.region_names)
    model.regions.push_back(name == "interface"
                                ? band_model(ft)
                                : RegionModel{.elasticity = name == "bead" ? glass : sylgard, .damageable = false});
  model.cells = CellField<RegionModel>(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    model.cells[c] = model.regions[mesh.region[c]];
    if (!model.cells[c].damageable) continue;
    const double r = mesh.cell_centre[c][0], strength = ft * std::pow(layers.crack() / r, 2);
    model.cells[c] = band_model(std::abs(r - layers.crack()) < 0.7 * ell ? 0.997 * strength : strength);
  }
  model.crack = &crack_geometry("Wu");
  model.degradation = degradation("rational");
  model.split = energy_split("none");
  model.residual_stiffness = 1e-9;
  BoundaryCondition pulled = traction_on("xmax", {});
  pulled.value = [largest_load](const Vector&, double t) { return Vector(largest_load * t, 0.0, 0.0); };
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }), pulled};
  for (const char* side : {"ymin", "ymax", "zmin", "zmax"}) model.boundary.push_back(symmetry_on(side));
  return model;
}

struct Measured {
  std::vector<double> load, separation, traction;  // [Pa], [m], [Pa]
  double surface_energy = 0.0;                     // at the end [J/m^2]
  double crack = 0.0;                              // radius of the most damaged cell at the end [m]
  void add(double at_load, const ColumnSample& sample) {
    load.push_back(at_load);
    separation.push_back(sample.separation[0]);
    traction.push_back(sample.traction[0]);
    surface_energy = sample.surface_energy;
  }
  double largest_step() const {  // of the separation
    double largest = 0.0;
    for (std::size_t i = 1; i < separation.size(); ++i) largest = std::max(largest, separation[i] - separation[i - 1]);
    return largest;
  }
};

/// Pulled at the outside until the band is broken: to just below its strength, then in so many equal steps.
Measured pulled(double a, Index n_steps) {
  const Compliance compliance = compliance_of(a);
  const double end = 1.02 * std::max(compliance.load_at(0.0), compliance.load_at(final_separation));
  const Mesh mesh = cone(a);
  const FractureModel model = model_on(mesh, Layers(a), end);
  const ColumnSet set = interface_columns(mesh, "interface", "matrix", Vector::UnitX()).front();
  Measured measured;
  const auto run_to = [&](double load, double increment, std::optional<FractureState> from) {
    FractureRun run(mesh, model, {.damage_tolerance = 1e-5, .energy_tolerance = 1e-7, .maximum_iterations = 100000},
                    {.end = load, .initial_increment = increment, .maximum_increment = increment, .stops = {}});
    FractureState start = from ? *from : run.initial_state();
    start.increment = increment;
    const auto step_done = [&](const FractureState& state, const StepReport&) {
      measured.add(state.load * end, sample_columns(mesh, model, run.output(state), set).front());
    };
    return from ? advance_to_end(run, start, step_done) : run_to_end(run, start, step_done);
  };
  const double elastic = 0.97 * compliance.load_at(0.0) / end;
  const FractureState broken =
      run_to(1.0, (1.0 - elastic) / static_cast<double>(n_steps), run_to(elastic, elastic, std::nullopt));
  const auto most = std::ranges::max_element(broken.damage) - broken.damage.begin();
  measured.crack = mesh.cell_centre[most].x();
  return measured;
}

/// Of the straight line through the softening part [Pa/m].
double softening_slope(const Measured& measured) {
  double n = 0.0, w = 0.0, T = 0.0, ww = 0.0, wT = 0.0;
  for (std::size_t i = 0; i < measured.load.size(); ++i) {
    const double x = measured.separation[i], y = measured.traction[i];
    if (x < 0.02 * final_separation || x > 0.95 * final_separation) continue;
    n += 1.0, w += x, T += y, ww += x * x, wT += x * y;
  }
  return (w * T - n * wT) / (n * ww - w * w);
}

TEST(CohesiveSphere, ExtractedLawIsTheBands) {
  const double radius = 0.6 * snapping_radius(ft / final_separation);
  const Compliance compliance = compliance_of(radius);

  const Measured measured = pulled(radius, 50);
  double law = 0.0, load = 0.0, area = 0.0;
  for (std::size_t i = 1; i < measured.load.size(); ++i) {
    const double w = measured.separation[i], T = measured.traction[i];
    area += 0.5 * (T + measured.traction[i - 1]) * (w - measured.separation[i - 1]);
    if (w < 1e-4 * final_separation || w > final_separation) continue;
    law = std::max(law, std::abs(T / ft - (1.0 - w / final_separation)));
    load = std::max(load, std::abs(measured.load[i] / compliance.load_at(w) - 1.0));
  }
  const double strength = *std::ranges::max_element(measured.traction);
  const double from_law = snapping_radius(softening_slope(measured));
  const double closed = snapping_radius(ft / final_separation);
  report_row("sphere with a cohesive band, radius " + fmt::format("{:.0f} um", 1e6 * radius),
             {{"largest error of the law/ft", law},
              {"strength/ft", strength / ft},
              {"area/Gc", area / Gc},
              {"surface energy/Gc", measured.surface_energy / Gc},
              {"crack beside the middle, um", 1e6 * (measured.crack - Layers(radius).crack())},
              {"largest error of the load", load},
              {"least radius that snaps, from the extracted law [um]", 1e6 * from_law},
              {"closed form [um]", 1e6 * closed},
              {"largest step of the separation/final", measured.largest_step() / final_separation}});
  EXPECT_LE(law, 0.03);
  EXPECT_NEAR(strength, ft, 0.02 * ft);
  EXPECT_NEAR(area, Gc, 0.015 * Gc);
  EXPECT_LE(load, 0.025);
  EXPECT_NEAR(from_law, closed, 1.5e-3 * closed);
}

/// The load can only grow: what has no equilibrium under a little more of it goes at once.
TEST(CohesiveSphere, SnapsFromTheClosedFormsRadiusOn) {
  const double closed = snapping_radius(ft / final_separation);
  for (const double share : {0.95, 1.05}) {
    const Measured measured = pulled(share * closed, 20);
    const double step = measured.largest_step() / final_separation;
    report_row(fmt::format("sphere with a cohesive band, {:.2f} of the radius that snaps", share),
               {{"largest step of the separation/final", step}});
    if (share < 1.0)
      EXPECT_LE(step, 0.3);
    else
      EXPECT_GE(step, 0.9);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
