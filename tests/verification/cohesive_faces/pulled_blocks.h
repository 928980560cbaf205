#pragma once
// Two blocks with a cohesive face between them, pulled step by step.

#include "tests/verification/cohesive_blocks.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm::verification::pulled_blocks {

struct Point {
  Vector traction, separation;
  EnergyAccount energy;
};

/// Steps through the values 1, 2 ... of the load parameter.
inline std::vector<Point> step_through(const Mesh& mesh, const FractureModel& model, std::size_t n_steps,
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

inline const Vector& entry(const std::vector<Vector>& path, double t) {
  return path[std::min(static_cast<std::size_t>(std::lround(t)), path.size() - 1)];
}

/// The left end is held, the right one moved along a path of displacements, one step each.
inline std::vector<Point> pull(const InterfaceLaw& law, const std::vector<Vector>& path) {
  const Mesh mesh = two_blocks(2);
  FractureModel model = glued_blocks(mesh, law);
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {true, true, true}, [&](const Vector&, double t) { return entry(path, t); })};
  return step_through(mesh, model, path.size() - 1);
}

/// The whole surface moves as it does where the separations and tractions across x = edge are these: uniform strains.
inline std::vector<Point> lead(const InterfaceLaw& law, const std::vector<Vector>& separation,
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

}  // namespace pfdm::verification::pulled_blocks
