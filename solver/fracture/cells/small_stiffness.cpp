#include "solver/fracture/cells/small_stiffness.h"

#include "solver/fracture/cells/degraded_heat.h"
#include "solver/parallel.h"

#include <cmath>
#include <map>
#include <utility>

namespace pfdm {

SmallStiffness::SmallStiffness(const Mesh& mesh, const FractureModel& model)
    : CellStiffness(mesh, model), materials_(mesh, model), is_isotropic_(model.is_isotropic()) {
  if (model.cells.size() == 0)
    for (const RegionModel& region : model.regions) laws_.push_back(make_cell_law(model, region));
  std::map<std::pair<Index, const MandelMatrix*>, std::shared_ptr<const CellLaw>> known;  // these are large
  for (Index c = 0; c < model.cells.size(); ++c) {
    const RegionModel& in_cell = model.cells[c];
    if (!in_cell.stiffness) {
      laws_.push_back(make_cell_law(model, in_cell));
      continue;
    }
    std::shared_ptr<const CellLaw>& law = known[{mesh.region[c], in_cell.stiffness.get()}];
    if (!law) law = make_cell_law(model, in_cell);
    laws_.push_back(law);
  }
}

void SmallStiffness::start_step(double duration, const CellField<double>& shift) {
  materials_.start_step(duration, shift);
  CellStiffness::start_step(duration, shift);
}

void SmallStiffness::give(const FractureState& state, const CellField<double>& g, MomentumSolver& momentum) const {
  if (!is_isotropic_) {
    momentum.set_law(strain_law(g, state.closure), g, state.displacement);
    return;
  }
  CellField<IsotropicElasticity> moduli(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) { moduli[c] = law(c).secant(g[c], state.closure[c]); });
  momentum.set_moduli(moduli, g, materials_.any() ? with_histories(state, g, moduli) : HistoryStress());
}

bool SmallStiffness::has_degradable_part(Index cell) const {
  return is_damageable(cell) && !materials_.has(cell) && is_variational(cell);
}

bool SmallStiffness::drives_by_faces(Index cell) const {
  return is_damageable(cell) && materials_.has(cell) && law(cell).has_secant() && is_variational(cell);
}

bool SmallStiffness::depends_on_strain() const {
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (is_damageable(c) && (!has_degradable_part(c) || law(c).depends_on_strain())) return true;
  return false;
}

CellField<IsotropicElasticity> SmallStiffness::degradable_part(const FractureState& state) const {
  CellField<IsotropicElasticity> part(mesh_.n_cells(), {});
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (has_degradable_part(c)) part[c] = law(c).degradable_part(state.closure[c]);
    if (!drives_by_faces(c)) return;
    part[c] = materials_.all_drives(c) ? law(c).secant(0.0, state.closure[c])
                                       : degradable_part_of(model_.split_of(model_.in_cell(mesh_, c)),
                                                            materials_.relaxed_elasticity(c), state.closure[c]);
  });
  return part;
}

StrainLaw SmallStiffness::strain_law(const CellField<double>& g, const CellField<double>& closure) const {
  struct At {
    CellField<double> g, closure;
  };
  const auto at = std::make_shared<const At>(At{g, closure});
  return {
      .tangent = [this, at](Index c, const Tensor& strain) { return law(c).tangent(strain, at->g[c], at->closure[c]); },
      .degradable = [this](Index c, const Tensor& strain) -> Tensor {
        return has_degradable_part(c) ? law(c).degradable_stress(strain) : Tensor::Zero();
      }};
}

// The part of the stiffness that the split keeps beyond g times it is elastic.
HistoryStress SmallStiffness::with_histories(const FractureState& state, const CellField<double>& g,
                                             CellField<IsotropicElasticity>& moduli) const {
  HistoryStress history = materials_.history_stress(state.histories);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    LinearStress& stress = history.stress[c];
    stress.C = stiffness_matrix(moduli[c]);
    if (!materials_.has(c)) return;
    const LinearStress effective = materials_.linearised(c, state.histories);
    stress.C += g[c] * (effective.C - stiffness_matrix(elasticity(c)));
    stress.initial = g[c] * effective.initial;
    const IsotropicElasticity beyond = materials_.beyond_elasticity(c);
    moduli[c].lambda += g[c] * beyond.lambda;
    moduli[c].mu += g[c] * beyond.mu;
  });
  return history;
}

double SmallStiffness::integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state) {
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    if (!materials_.has(c)) return 0.0;
    const double wrong = materials_.advance(c, mechanics, start.histories, state.histories);
    return factor(c, state.damage[c]) * wrong * mesh_.cell_volume[c];
  });
}

CellEnergies SmallStiffness::energies(const CellMechanics& mechanics, const FractureState& state) const {
  const std::size_t n = mesh_.n_cells();
  CellEnergies energies{
      .driving = CellField<double>(n), .stored = CellField<double>(n), .idle = CellField<double>(n, 0.0)};
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!materials_.has(c)) {
      energies.driving[c] = driving_energy(c, mechanics);
      energies.stored[c] = mechanics.energy[c];
      return;
    }
    const MaterialEnergy material = materials_.energy(c, state.histories);
    energies.driving[c] = driving_energy(c, mechanics, material, state);
    energies.stored[c] = stored_energy(c, mechanics, material, factor(c, seen(c, state)));
    energies.idle[c] = material.idle;
  });
  return energies;
}

double SmallStiffness::driving_energy(Index cell, const CellMechanics& mechanics) const {
  return has_degradable_part(cell) ? mechanics.part_energy[cell]
                                   : law(cell).driving_energy(mechanics.elastic_strain(cell));
}

double SmallStiffness::driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  if (!materials_.has(cell)) return driving_energy(cell, mechanics);
  return driving_energy(cell, mechanics, materials_.energy(cell, state.histories), state);
}

// All that a cell stores may drive, over what damage leaves of it, but for what the split keeps. Otherwise what relaxed
// moduli store does.
double SmallStiffness::driving_energy(Index cell, const CellMechanics& mechanics, const MaterialEnergy& material,
                                      const FractureState& state) const {
  if (!drives_by_faces(cell)) return material.driving;
  const double g = factor(cell, seen(cell, state));
  const double of_part = mechanics.part_energy[cell];
  if (!materials_.all_drives(cell)) return of_part;
  if (!(g > 0.0)) return material.driving;
  return std::max(stored_energy(cell, mechanics, material, g) / mesh_.cell_volume[cell] - of_part, 0.0) / g;
}

double SmallStiffness::stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  if (!materials_.has(cell)) return mechanics.energy[cell];
  return stored_energy(cell, mechanics, materials_.energy(cell, state.histories), factor(cell, seen(cell, state)));
}

// Half the work on the elastic strain, and what is locked up.
double SmallStiffness::stored_energy(Index cell, const CellMechanics& mechanics, const MaterialEnergy& material,
                                     double g) const {
  const double on_inelastic = 0.5 * contract(mechanics.stress[cell], material.inelastic);
  return mechanics.energy[cell] + mesh_.cell_volume[cell] * (g * material.locked - on_inelastic);
}

Tensor SmallStiffness::undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState&) const {
  return stress(elasticity(cell), mechanics.elastic_strain(cell));
}

double SmallStiffness::plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const {
  if (!materials_.has(cell)) return 0.0;
  const double g_from = factor(cell, from.damage[cell]), g_to = factor(cell, to.damage[cell]);
  return mesh_.cell_volume[cell] *
         degraded_heat(g_from, materials_.energy(cell, from.histories), g_to, materials_.energy(cell, to.histories));
}

double SmallStiffness::follow(const CellMechanics& mechanics, FractureState& state) {
  return parallel_sum(mesh_.n_cells(),
                      [&](Index c) { return law(c).has_secant() ? follow_with_closure(c, mechanics, state) : 0.0; });
}

// The strain with the volume change that belongs to the cell's mean stress. The tractions hold a closed crack; the
// volume change of the face displacements may have the other sign where the strain varies within a cell, and the crack
// would open and close for ever.
Tensor SmallStiffness::closing_strain(Index cell, const CellMechanics& mechanics, double g, double closure) const {
  const Tensor strain = mechanics.elastic_strain(cell);
  const double K = law(cell).secant(g, closure).bulk_modulus();
  return deviator(strain) + mechanics.stress[cell].trace() / (9.0 * K) * Tensor::Identity();
}

double SmallStiffness::follow_with_closure(Index cell, const CellMechanics& mechanics, FractureState& state) {
  const double g = factor(cell, seen(cell, state)), before = state.closure[cell];
  const Tensor strain = closing_strain(cell, mechanics, g, before);
  const double wanted = law(cell).closure(strain);
  state.closure[cell] = closures_.next(cell, g, before, wanted);
  if (wanted == before) return 0.0;
  const double wrong =
      energy_density(law(cell).secant(g, wanted), strain) - energy_density(law(cell).secant(g, before), strain);
  return mesh_.cell_volume[cell] * std::abs(wrong);
}

}  // namespace pfdm
