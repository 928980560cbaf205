#include "solver/momentum/momentum.h"

#include "solver/momentum/bending/slender_layers.h"
#include "solver/momentum/body/cell_pressure.h"
#include "solver/momentum/finite_strain/finite_tractions.h"
#include "solver/momentum/small_strain/history_tractions.h"
#include "solver/momentum/small_strain/law_tractions.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace pfdm {

MomentumOperator::MomentumOperator(const Mesh& mesh, const Unknowns& unknowns)
    : skeleton_(std::make_unique<const FaceSkeleton>(mesh, unknowns)),
      cells_(std::make_unique<CellReconstruction>(*skeleton_)),
      eigenstrain_(std::make_unique<CellEigenstrain>()),
      loads_(*skeleton_),
      springs_(*skeleton_),
      spins_(*skeleton_, cells_->gradient()) {}

// Tractions of now if they are of this kind, else new ones.
template <class Kind, class... Parts>
Kind& MomentumOperator::choose(const Parts&... parts) {
  if (tractions_ && typeid(*tractions_) == typeid(Kind)) return static_cast<Kind&>(*tractions_);
  auto chosen = std::make_unique<Kind>(*skeleton_, *cells_, parts...);
  Kind& kind = *chosen;
  tractions_ = std::move(chosen);
  finite_ = nullptr;
  isotropic_ = nullptr;
  return kind;
}

void MomentumOperator::set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part,
                                  HistoryStress history) {
  if (history.any()) {
    auto& tractions = choose<HistoryTractions>(*eigenstrain_);
    tractions.set(moduli, g, part, std::move(history));
    isotropic_ = &tractions;
  } else {
    isotropic_ = &choose<IsotropicTractions>(*eigenstrain_);
    isotropic_->set(moduli, g, part);
  }
}

CellField<double> MomentumOperator::set_law(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u,
                                            bool afresh, double part) {
  auto& tractions = choose<LawTractions>(*eigenstrain_);
  tractions.set(std::move(law), g, u, afresh, part);
  return tractions.side_stiffness();
}

std::vector<Index> MomentumOperator::own_sides_at_finite_strain() {
  finite_ = &choose<FiniteTractions>(*eigenstrain_);
  return finite_->states().cells_of_own();
}

CellField<double> MomentumOperator::set_finite(const FiniteLawAt& law, const std::vector<GapStress>& gaps,
                                               const CellField<double>& g, const std::vector<Vector>& u, double t,
                                               double part) {
  finite_ = &choose<FiniteTractions>(*eigenstrain_);
  const auto lease = sweep();
  finite_->set(law, gaps, g, u, part, *lease);
  loads_.follow(t, u, lease->gradients, g);
  return finite_->states().face_stiffness();
}

bool MomentumOperator::set_eigenstrain(std::optional<double> t, const CellField<double>& rise) {
  return eigenstrain_->set(skeleton_->mesh, skeleton_->unknowns.loads, t, rise);
}

// In a uniform body the forces of eigenstrains cancel. Pressures are zero then.
double MomentumOperator::energy_if_held() const {
  const Mesh& mesh = skeleton_->mesh;
  const Unknowns& unknowns = skeleton_->unknowns;
  if (finite_ != nullptr)
    return parallel_sum(eigenstrain().size(), [&](Index c) {
      IsotropicElasticity sound = unknowns.sound[unknowns.zone[c]];
      sound.lambda = std::min(sound.lambda, CellPressure::moderate_lambda * sound.mu);
      return 2.0 * mesh.cell_volume[c] * energy_density(sound, to_tensor(eigenstrain()[c]));
    });
  const CellMechanics held =
      mechanics(std::vector<Vector>(unknowns.n_unknowns(), Vector::Zero()), Wanted::without_gradient);
  return parallel_sum(held.eigenstrain.size(),
                      [&](Index c) { return std::abs(held.traction_moment[c].dot(held.eigenstrain[c])); });
}

double MomentumOperator::energy_remembered() const {
  if (finite_ == nullptr || !finite_->remembers()) return 0.0;
  return parallel_sum(skeleton_->mesh.n_cells(), [&](Index c) {
    const FiniteLaw& law = finite_->states().law(c);
    return law.memory.share > 0.0 ? skeleton_->mesh.cell_volume[c] * law.stress.squaredNorm() / law.face.mu : 0.0;
  });
}

bool MomentumOperator::is_slender() const { return is_slender_body(skeleton_->mesh, skeleton_->unknowns); }

void MomentumOperator::relax_flat_cells() { cells_->relax_flat_cells(); }

void MomentumOperator::apply(const std::vector<Vector>& u, std::vector<Vector>& out, Sweep& sweep) const {
  tractions_->find_linear(u, sweep);
  skeleton_->sum_forces(sweep, out);
  spins_.add(*tractions_, sweep.gradients, out);
  std::vector<Vector> of_springs = springs_.forces(u);
  tractions_->turn_springs(sweep, springs_.all(), of_springs);
  springs_.pull(of_springs, out);
  loads_.add_response(u, sweep.gradients, out);
  tractions_->balance_pressures(u, sweep, out);
}

std::vector<Vector> MomentumOperator::applied_forces(double t) const {
  std::vector<Vector> load = traction_forces(t);
  spins_.add_targets(*tractions_, loads_, t, load);
  loads_.add_initial_turn(load);
  return load;
}

std::vector<Vector> MomentumOperator::load_vector(double t) const {
  std::vector<Vector> load = applied_forces(t);
  take_away_constant_forces(load);
  return load;
}

CellMechanics MomentumOperator::mechanics(const std::vector<Vector>& u, Wanted wanted,
                                          const CellField<IsotropicElasticity>& part) const {
  CellMechanics result = tractions_->mechanics(u, wanted == Wanted::all, part);
  if (finite_ != nullptr) result.eigenstrain = eigenstrain();
  return result;
}

void MomentumOperator::take_away_constant_forces(std::vector<Vector>& load) const {
  const auto constant = sweep();
  std::ranges::fill(constant->force, Vector::Zero());
  std::ranges::fill(constant->sector_stress, 0.0);
  if (!tractions_->add_constant(*constant)) return;
  std::vector<Vector> initial(load.size(), Vector::Zero());
  skeleton_->sum_forces(*constant, initial);
  for (std::size_t i = 0; i < load.size(); ++i) load[i] -= initial[i];
  tractions_->take_away_constant_volumes(load);
}

void MomentumOperator::take_away_pressure_forces(const std::vector<Vector>& q, std::vector<Vector>& r) const {
  const std::vector<Index>& cells = skeleton_->unknowns.pressure_cells;
  const Index n_nodes = skeleton_->unknowns.n_nodes();
  CellField<double> tension(skeleton_->mesh.n_cells(), 0.0);
  for (std::size_t k = 0; k < cells.size(); ++k) tension[cells[k]] = q[n_nodes + k][0];
  const auto forces = sweep();
  tractions_->find_pressure_forces(tension, *forces);
  std::vector<Vector> of_pressures(r.size());
  skeleton_->sum_forces(*forces, of_pressures);
  parallel_for(n_nodes, [&](Index i) { r[i] -= of_pressures[i]; });
}

}  // namespace pfdm
