#pragma once
// Blocks at finite strain with a cohesive face between them.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/equilibrium/cohesive_newton.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/noise.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace pfdm::verification::finite_blocks {

inline const IsotropicElasticity rubber = from_young_poisson(2e6, 0.3);
inline constexpr InterfaceStrength bond{
    .strength = 1e6, .toughness = 4000.0, .shear_strength = 1.5e6, .shear_toughness = 7000.0, .stiffness = 2e10};

/// Regions of one elasticity share their material: no unknowns on the faces between them, as at small strain.
inline void make_finite(FractureModel& model) {
  std::shared_ptr<const Material> last;
  for (RegionModel& region : model.regions) {
    if (!last || !(last->elasticity() == region.elasticity))
      last = make_hyperelastic("neo_hookean", {.elasticity = region.elasticity});
    region.material = last;
  }
}

inline FractureModel bonded_blocks(const Mesh& mesh, const InterfaceLaw& law, const IsotropicElasticity& elasticity) {
  FractureModel model = elastic_model(std::vector(mesh.region_names.size(), elasticity), {});
  glue(model, mesh, law, bond, Vector::UnitX(), [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
  make_finite(model);
  return model;
}

inline const TractionSeparationLaw& linear_law() { return find_by_name(traction_separation_laws(), "linear", "law"); }

struct Step {
  Vector force;  // on the patch xmax
  OutputInterface interface;
  EnergyAccount energy;
};

/// The end of the blocks follows these displacements, one at each whole load parameter; their sides glide.
inline std::vector<BoundaryCondition> pulled_along(const std::vector<double>& path) {
  const auto at = [path](double t) {
    return path[std::min(static_cast<std::size_t>(std::lround(t)), path.size() - 1)];
  };
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, false, false}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
      moved("xmax", {true, false, false}, [at](const Vector&, double t) -> Vector { return at(t) * Vector::UnitX(); })};
  for (const char* side : {"ymin", "ymax", "zmin", "zmax"}) boundary.push_back(symmetry_on(side));
  return boundary;
}

/// Steps through the values 1, 2 ... of the load parameter, of this duration each.
inline std::vector<Step> finite_steps(const Mesh& mesh, const FractureModel& model, std::size_t n_steps,
                                      double tolerance = 1e-12, double duration = 0.0) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.end = double(n_steps),
                   .initial_increment = 1.0,
                   .minimum_increment = 1.0,
                   .maximum_increment = 1.0,
                   .duration = duration,
                   .stops = {}});
  std::vector<Step> steps;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    steps.push_back({report.reaction[mesh.patch_index("xmax")], run.output(state).interfaces[0], report.energy});
  });
  return steps;
}

/// The closed form of a neo-Hookean bar between sliding sides: lambda_y = lambda_z = 1,
/// P = mu (s - 1/s) + Lambda (s - 1) at the stretch s.
inline double confined_traction(double s) { return rubber.mu * (s - 1.0 / s) + rubber.lambda * (s - 1.0); }
inline double confined_stretch(double P) {
  double low = 0.2, high = 8.0;
  for (int i = 0; i < 200; ++i) (confined_traction(0.5 * (low + high)) < P ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

}  // namespace pfdm::verification::finite_blocks
