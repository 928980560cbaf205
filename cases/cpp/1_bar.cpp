// 1. A mesh and a softening law of one's own: a concrete bar with a waist is torn apart.
//
// Problem: a bar of 100 mm, 10 mm x 10 mm at its ends and 2 % narrower in the middle, is pulled until it has parted.
// Material: E = 30 GPa, nu = 0.2, strength 3 MPa, toughness 100 J/m^2. Softening by two straight lines (Petersson
// 1981), which the program does not have; a phase field with its rational degradation follows it (Wu, JMPS 103 (2017)
// 72).
//
//   y ^ ______                      ______
//     | |     '''----......----'''       |
//     | |             waist              | -> u_x
//     +-+--------------------------------+---> x
//
//   A quarter: y = 0 and z = 0 are planes of symmetry, x = 0 is held along x; 160 cells along (h = ell/8), one across.
//
// Result: the strength times the area of the waist as the greatest force, and the toughness times that area as the work
// to part the bar, each within 2 %; else the program ends with 1.
//
//   cmake -S cases/cpp -B build/cpp -DCMAKE_PREFIX_PATH=DIR && cmake --build build/cpp && build/cpp/1_bar

#include "mesh/mesh.h"
#include "physics/damage/softening_law.h"
#include "solver/fracture/fracture_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using namespace pfdm;

constexpr double length = 0.1, width = 0.01, waist = 0.98;               // [m], [m], share of the width [-]
constexpr double E = 30e9, nu = 0.2, strength = 3e6, toughness = 100.0;  // [Pa], [-], [Pa], [J/m^2]
constexpr double ell = 5e-3;                                             // regularisation length [m]
constexpr Index n = 160;

/// Half of the bar's width at x [m].
double half_width(double x) { return 0.5 * width * (1.0 - (1.0 - waist) * std::sin(std::numbers::pi * x / length)); }

/// Points and cells, from which assemble_mesh finds faces and patches.
Mesh bar() {
  CellSoup soup;
  soup.region_names = {"concrete"};
  for (Index i = 0; i <= n; ++i) {
    const double x = length * static_cast<double>(i) / n, y = half_width(x), z = 0.5 * width;
    soup.points.insert(soup.points.end(), {{x, 0.0, 0.0}, {x, y, 0.0}, {x, y, z}, {x, 0.0, z}});
  }
  for (Index i = 0; i < n; ++i) {  // a hexahedron in VTK's order: the four points of one end, then those of the other
    std::array<Index, 8> points{};
    for (Index k = 0; k < 8; ++k) points[k] = 4 * i + k;
    soup.add_cell(CellShape::hexahedron, points, 0);
  }
  const auto plane = [](int axis, double at) {
    return
        [=](const Vector& centre, const Vector&, std::span<const Index>) { return std::abs(centre[axis] - at) < 1e-9; };
  };
  return assemble_mesh(
      std::move(soup),
      {{"left", plane(0, 0.0)}, {"right", plane(0, length)}, {"y0", plane(1, 0.0)}, {"z0", plane(2, 0.0)}});
}

/// Petersson's two lines: strength/3 at an opening of 0.8 Gf/ft, nothing at 3.6 Gf/ft.
const SofteningLaw two_lines{
    .name = "two_lines",
    .description = "Petersson 1981",
    .initial_slope = (2.0 / 3.0) / 0.8,
    .final_opening = 3.6,
    .exponent = 2.0,
    .traction = [](double w) { return w < 0.8 ? 1.0 - w / 1.2 : std::max(3.6 - w, 0.0) / 8.4; },
    .slope = [](double w) { return w < 0.8 ? -1.0 / 1.2 : (w < 3.6 ? -1.0 / 8.4 : 0.0); },
    .work =
        [](double w) {
          if (w < 0.8) return w - w * w / 2.4;
          const double left = std::max(3.6 - w, 0.0);
          return 1.0 - left * left / 16.8;
        }};

FractureModel model() {
  FractureModel made;
  made.regions = {RegionModel{.elasticity = from_young_poisson(E, nu), .Gc = toughness, .ell = ell}};
  made.crack = &crack_geometry("Wu");
  made.degradation = rational_degradation(rational_coefficients(two_lines, E, toughness, strength, ell));
  made.split = energy_split("rankine");
  for (const char* side : {"left", "y0", "z0"})
    made.boundary.push_back({.patch = side, .kind = BoundaryCondition::Kind::symmetry});
  made.boundary.push_back({.patch = "right",
                           .displacement_prescribed = {true, false, false},
                           .value = [](const Vector&, double t) { return Vector(2.5e-4 * t, 0.0, 0.0); }});
  return made;
}

}  // namespace

int main() {
  const Mesh mesh = bar();
  FractureRun run(mesh, model(), {}, {.initial_increment = 0.01, .maximum_increment = 0.01});
  const auto right = mesh.patch_index("right");

  FractureState state = run.initial_state();
  double greatest = 0.0, work = 0.0, force = 0.0, moved = 0.0;
  while (!run.is_complete(state)) {
    const StepReport report = run.step(state);
    const double new_force = report.reaction[right].x(), new_moved = report.patch_displacement[right].x();
    work += 0.5 * (force + new_force) * (new_moved - moved);
    force = new_force;
    moved = new_moved;
    greatest = std::max(greatest, force);
  }
  const double area = 0.25 * waist * width * width;
  std::printf("greatest force %.2f N, strength x area %.2f N\n", greatest, strength * area);
  std::printf("work %.5f J, toughness x area %.5f J; force left %.2f N\n", work, toughness * area, force);
  const bool right_force = std::abs(greatest / (strength * area) - 1.0) < 0.02;
  const bool right_work = std::abs(work / (toughness * area) - 1.0) < 0.02;
  return right_force && right_work ? 0 : 1;
}
