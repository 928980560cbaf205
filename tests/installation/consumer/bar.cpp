// A bar in tension by the library alone: its force must be E A times the strain.

#include "mesh/generators/box_hexes.h"
#include "solver/fracture/fracture_run.h"

#include <cmath>
#include <cstdio>

int main() {
  using namespace pfdm;
  const double length = 0.1, width = 0.01, elongation = 1e-5, E = 3e9;  // [m], [Pa]
  BoxHexesSettings box;
  box.axes = {std::vector{AxisBlock{.length = length, .n = 10}}, std::vector{AxisBlock{.length = width, .n = 2}},
              std::vector{AxisBlock{.length = width, .n = 2}}};
  const Mesh mesh = make_box_hexes(box);

  FractureModel model;
  model.regions = {RegionModel{.elasticity = from_young_poisson(E, 0.3), .damageable = false}};
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  for (const char* side : {"xmin", "ymin", "zmin"})
    model.boundary.push_back({.patch = side, .kind = BoundaryCondition::Kind::symmetry});
  model.boundary.push_back({.patch = "xmax",
                            .displacement_prescribed = {true, false, false},
                            .value = [=](const Vector&, double t) { return Vector(t * elongation, 0.0, 0.0); }});

  FractureRun run(mesh, model, {}, {.initial_increment = 1.0, .maximum_increment = 1.0});
  double force = 0.0;
  FractureState state = run.initial_state();
  while (!run.is_complete(state)) {
    const StepReport report = run.step(state);
    for (std::size_t p = 0; p < mesh.patches.size(); ++p)
      if (mesh.patches[p].name == "xmax") force = report.reaction[p].x();
  }
  const double expected = E * width * width * elongation / length;
  std::printf("force %.9g N, expected %.9g N\n", force, expected);
  return std::abs(force - expected) < 1e-6 * expected ? 0 : 1;
}
