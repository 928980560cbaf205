#include "solver/fracture/endochronic_cells.h"

#include "solver/parallel.h"

#include <algorithm>
#include <limits>

namespace pfdm {

EndochronicCells::EndochronicCells(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {
  any_ = std::ranges::any_of(model.regions, [](const RegionModel& region) { return region.endochronic != nullptr; });
  if (!any_) return;
  const auto n = as_size(mesh.n_cells());
  law_ = CellField<const EndochronicLaw*>(n, nullptr);
  for (Index c = 0; c < mesh.n_cells(); ++c) law_[c] = model.in_cell(mesh, c).endochronic.get();
  tangent_ = CellField<MandelMatrix>(n);
  start_step(0.0);
}

void EndochronicCells::start_step(double duration) {
  duration_ = duration;
  parallel_for(any_ ? mesh_.n_cells() : 0, [&](Index c) {
    if (has(c)) tangent_[c] = stiffness_matrix(law_[c]->elasticity);
  });
}

double EndochronicCells::advance(Index cell, const Tensor& strain, const EndochronicState& from, EndochronicState& to) {
  const EndochronicLaw& law = *law_[cell];
  const Mandel eps = to_mandel(strain), expected = linearised(cell, to)(eps);
  EndochronicUpdate result = update(law, from, eps - from.strain, duration_);
  if (!result.converged) return std::numeric_limits<double>::quiet_NaN();
  to = std::move(result.state);
  tangent_[cell] = result.tangent;
  return (result.stress - expected).norm() * result.stress.norm() / (2.0 * law.elasticity.mu);
}

LinearStress EndochronicCells::linearised(Index cell, const EndochronicState& state) const {
  const MandelMatrix& T = tangent_[cell];
  return {T, stress(*law_[cell], state) - T * state.strain};
}

// The terms of the kernel are deviatoric: no split keeps their energy. A split that is not variational defines its own
// driving energy.
double EndochronicCells::driving_energy(Index cell, const EndochronicState& state) const {
  const EndochronicLaw& law = *law_[cell];
  const double psi = model_.split->energy(law.elasticity, to_tensor(state.strain - state.plastic_strain)).psi_plus;
  return model_.split->variational ? psi + pfdm::kernel_energy(law, state) : psi;
}

CellField<EndochronicState> EndochronicCells::virgin_states() const {
  CellField<EndochronicState> states(any_ ? as_size(mesh_.n_cells()) : 0);
  for (Index c = 0; c < states.size(); ++c)
    if (has(c)) states[c] = virgin_state(*law_[c]);
  return states;
}

}  // namespace pfdm
