#pragma once
// Boxes that follow a path of mean strains and stresses.

#include "physics/interfaces/traction_separation.h"
#include "physics/registry.h"
#include "solver/homogenization/mean_path.h"
#include "tests/verification/support.h"

#include <utility>
#include <vector>

namespace pfdm::verification {

/// Number of the component along z among those of a mean strain or stress.
inline constexpr std::size_t zz = 2;

inline const TractionSeparationLaw& linear_law() { return find_by_name(traction_separation_laws(), "linear", "law"); }

/// Free of stress but for the strains that are named.
inline MeanPath strains(const std::vector<std::pair<std::size_t, std::vector<double>>>& by_component) {
  MeanPath path;
  path.by_stress.fill(true);
  path.points.resize(by_component.front().second.size());
  for (const auto& [k, values] : by_component) {
    path.by_stress[k] = false;
    for (std::size_t i = 0; i < values.size(); ++i) path.points[i][k] = values[i];
  }
  return path;
}

inline void load(FractureModel& model, const Mesh& mesh, const MeanPath& path, const char* loading) {
  CellField<IsotropicElasticity> cells(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) cells[c] = model.in_cell(mesh, c).elasticity;
  model.motion = motion_along(path, mesh, homogenization_loading(loading), reuss_estimate(mesh, cells));
}

/// The reports of the steps of this size; `mean_of_cells`: of the stress at the end.
inline std::vector<StepReport> follow(const Mesh& mesh, const FractureModel& model, const MeanPath& path,
                                      double tolerance = 1e-10, double increment = 1.0,
                                      Tensor* mean_of_cells = nullptr) {
  LoadingSettings loading{.end = static_cast<double>(path.points.size()),
                          .initial_increment = increment,
                          .minimum_increment = 1e-3 * increment,
                          .maximum_increment = increment,
                          .stops = {}};
  loading.is_proportional = path.points.size() == 1;
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance}, loading);
  std::vector<StepReport> reports;
  const FractureState last =
      run_to_end(run, [&](const FractureState&, const StepReport& report) { reports.push_back(report); });
  if (mean_of_cells == nullptr) return reports;
  mean_of_cells->setZero();
  const OutputFields fields = run.output(last);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    *mean_of_cells += mesh.cell_volume[c] / model.motion.size.prod() * fields.stress[c];
  return reports;
}

}  // namespace pfdm::verification
