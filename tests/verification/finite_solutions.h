#pragma once
// Bodies of hyperelastic materials by region, solved in equal steps.

#include "physics/materials/hyperelastic.h"
#include "tests/verification/support.h"

#include <memory>
#include <utility>
#include <vector>

namespace pfdm::verification {

inline std::shared_ptr<const Material> neo_hookean(const IsotropicElasticity& elasticity) {
  return make_hyperelastic("neo_hookean", {.elasticity = elasticity});
}

inline FractureModel finite_model(const std::vector<std::shared_ptr<const Material>>& by_region,
                                  std::vector<BoundaryCondition> boundary) {
  std::vector<IsotropicElasticity> elasticity;
  elasticity.reserve(by_region.size());
  for (const auto& material : by_region) elasticity.push_back(material->elasticity());
  FractureModel model = elastic_model(elasticity, std::move(boundary));
  for (std::size_t r = 0; r < by_region.size(); ++r) model.regions[r].material = by_region[r];
  return model;
}

struct Finished {
  FractureState state;
  StepReport report;
  OutputFields fields;
  Index krylov_iterations = 0;
  double cpu_seconds = 0.0;
};

inline Finished solve(const Mesh& mesh, const FractureModel& model, Index steps, double tolerance = 1e-10) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.initial_increment = 1.0 / double(steps), .maximum_increment = 1.0 / double(steps), .stops = {}});
  Finished done;
  const std::clock_t start = std::clock();
  done.state = run_to_end(run, [&](const FractureState&, const StepReport& report) { done.report = report; });
  done.cpu_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  done.fields = run.output(done.state);
  done.krylov_iterations = run.krylov_iterations();
  return done;
}

inline Mesh hexahedra(Index n) {
  const std::vector<AxisBlock> axis{{.length = 1.0, .n = n}};
  return make_box_hexes({.axes = {axis, axis, axis}, .regions = {}, .slits = {}});
}

}  // namespace pfdm::verification
