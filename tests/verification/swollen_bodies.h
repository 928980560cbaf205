#pragma once
// Bodies with eigenstrains at finite strain.

#include "mesh/generators/sphere_sector.h"
#include "tests/verification/finite.h"
#include "tests/verification/finite_solutions.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace pfdm::verification::swollen_bodies {

inline const IsotropicElasticity soft = from_young_poisson(1e6, 0.3), rubber = from_young_poisson(1e6, 0.4999),
                                 stiffer = from_young_poisson(3e6, 0.3);
inline const Tensor one = Tensor::Identity();

inline std::shared_ptr<const LoadField<Tensor>> given(const Tensor& strain) {
  return std::make_shared<const LoadField<Tensor>>([strain](const Vector&, double t) -> Tensor { return t * strain; });
}

inline FractureModel swollen(const Mesh& mesh, const std::shared_ptr<const Material>& material, const Tensor& strain,
                             std::vector<BoundaryCondition> boundary) {
  FractureModel model = finite_body(mesh, material, std::move(boundary));
  for (RegionModel& region : model.regions) region.eigenstrain = given(strain);
  return model;
}

struct Swollen {
  Drawn drawn;
  OutputFields fields;
};

inline Swollen swell(const Mesh& mesh, const FractureModel& model, Index steps, double tolerance = 1e-12) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.initial_increment = 1.0 / double(steps), .maximum_increment = 1.0 / double(steps), .stops = {}});
  Swollen result;
  result.drawn.state =
      run_to_end(run, [&](const FractureState&, const StepReport& report) { result.drawn.report = report; });
  result.fields = run.output(result.drawn.state);
  return result;
}

inline double largest(const CellField<Tensor>& field, const Tensor& than = Tensor::Zero()) {
  double most = 0.0;
  for (const Tensor& value : field) most = std::max(most, (value - than).norm());
  return most;
}

inline const std::vector<BoundaryCondition> corner{symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")};
inline const Tensor uneven = Vector(0.2, -0.15, 0.3).asDiagonal(), even = 0.25 * Tensor::Identity();

inline Mesh cube() { return sphere_in_cube(1, 2, 2.0, 0.6); }

}  // namespace pfdm::verification::swollen_bodies
