#pragma once
// Sheets of one cell across at finite strain.

#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/finite_cells.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/finite.h"
#include "tests/verification/noise.h"

#include <memory>
#include <string_view>
#include <vector>

namespace pfdm::verification::sheets {

inline const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.49);

inline std::shared_ptr<const Material> law_of(std::string_view name, const IsotropicElasticity& elasticity = rubber) {
  HyperelasticParameters parameters{.elasticity = elasticity};
  if (name == "mooney_rivlin") parameters.second_invariant = 0.2;
  if (name == "ogden") parameters.shares = {0.7, 0.3}, parameters.exponents = {1.3, 4.0};
  if (name == "lopez_pamies") parameters.shares = {0.8, 0.2}, parameters.exponents = {0.6, 2.0};
  return make_hyperelastic(name, parameters);
}

inline Mesh sheet(Index n) {
  return make_box_hexes({.axes = {{{{.length = 1.0, .n = n}}, {{.length = 1.0, .n = n}}, {{.length = 0.1, .n = 1}}}},
                         .regions = {},
                         .slits = {}});
}

/// Conditions that hold a sheet by a gradient within its plane.
inline std::vector<BoundaryCondition> stretched(const Tensor& H, bool is_sheet) {
  std::vector<BoundaryCondition> boundary;
  for (const char* patch : {"xmin", "xmax", "ymin", "ymax"})
    boundary.push_back(
        moved(patch, {true, true, false}, [H](const Vector& x, double t) -> Vector { return t * H * x; }));
  if (is_sheet)
    boundary.push_back(plane_stress_on("zmin")), boundary.push_back(plane_stress_on("zmax"));
  else
    boundary.push_back(symmetry_on("zmin"));
  return boundary;
}

inline std::vector<BoundaryCondition> bent(double size) {
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, true, true}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
      moved("xmax", {true, true, true},
            [size](const Vector&, double t) -> Vector { return size * t * Vector(0.6, 0.8, 0.0); })};
  boundary.push_back(plane_stress_on("zmin")), boundary.push_back(plane_stress_on("zmax"));
  return boundary;
}

}  // namespace pfdm::verification::sheets
