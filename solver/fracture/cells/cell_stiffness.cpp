#include "solver/fracture/cells/cell_stiffness.h"

#include "solver/fracture/cells/degraded_heat.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm {
CellStiffness::CellStiffness(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh), model_(model), materials_(mesh, model), finite_(mesh, model), is_isotropic_(model.is_isotropic()) {
  if (!model.is_anisotropic()) return;
  std::map<const MandelMatrix*, std::shared_ptr<const AnisotropicElasticity>> known;
  anisotropy_ = CellField<std::shared_ptr<const AnisotropicElasticity>>(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const MandelMatrix* C = model.in_cell(mesh, c).stiffness.get();
    if (C == nullptr) continue;
    if (!known.contains(C)) known[C] = std::make_shared<const AnisotropicElasticity>(anisotropic_elasticity(*C));
    anisotropy_[c] = known[C];
  }
}

CellHistories CellStiffness::virgin_histories() const {
  return finite_.any() ? finite_.histories().virgin_histories() : materials_.virgin_histories();
}

void CellStiffness::start_step(double duration, const CellField<double>& shift) {
  materials_.start_step(duration, shift);
  closures_.start_step(mesh_.n_cells());
}

const IsotropicElasticity& CellStiffness::elasticity(Index cell) const {
  return model_.in_cell(mesh_, cell).elasticity;
}

const EnergySplit& CellStiffness::split(Index cell) const { return model_.split_of(model_.in_cell(mesh_, cell)); }

double CellStiffness::factor(Index cell, double d) const {
  const RegionModel& region = model_.in_cell(mesh_, cell);
  if (!region.damageable) return 1.0;
  return (1.0 - model_.residual_stiffness) * model_.degradation_of(region).g(d) + model_.residual_stiffness;
}

CellField<double> CellStiffness::factors(const FractureState& state) const {
  CellField<double> g(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) { g[c] = factor(c, seen(c, state)); });
  return g;
}

Tensor CellStiffness::cauchy_stress(Index cell, const CellMechanics& mechanics, const FractureState& state,
                                    const Vector& plane_normal) const {
  return finite_.cauchy_stress(cell, mechanics, left(cell, state), plane_normal);
}

Tensor CellStiffness::thinned_gradient(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  return finite_.thinned(cell, mechanics, left(cell, state));
}

void CellStiffness::set(const FractureState& state, MomentumSolver& momentum) const {
  const std::size_t n = mesh_.n_cells();
  const CellField<double> g = factors(state);
  momentum.set_eigenstrain(state.step > 0 ? std::optional(state.load) : std::nullopt, state.heat.felt);
  if (finite_.any()) {
    const CellField<Mandel>& free = momentum.balance().eigenstrain();
    const auto law = [&](Index c, Index own, const Tensor& H) {
      return finite_.law({c, own}, H, {g[c], state.closure[c]},
                         free.size() > 0 ? FreeDeformation(to_tensor(free[c])) : FreeDeformation());
    };
    momentum.set_finite(law, finite_.histories().gaps(), g, state.displacement, state.load);
  } else if (is_isotropic_) {
    CellField<IsotropicElasticity> moduli(n);
    parallel_for(mesh_.n_cells(), [&](Index c) { moduli[c] = split(c).secant(elasticity(c), g[c], state.closure[c]); });
    momentum.set_moduli(moduli, g, materials_.any() ? with_histories(state, g, moduli) : HistoryStress());
  } else {
    momentum.set_law(law(g, state.closure), g, state.displacement);
  }
}

bool CellStiffness::has_degradable_part(Index cell) const {
  const EnergySplit& law = split(cell);
  return model_.in_cell(mesh_, cell).damageable && !finite_.any() && !materials_.has(cell) && law.is_variational();
}

bool CellStiffness::descends() const {
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (model_.in_cell(mesh_, c).damageable && !(finite_.any() ? finite_.descends(c) : has_degradable_part(c)))
      return false;
  return model_.irreversibility != Irreversibility::history && !model_.has_strength();
}

bool CellStiffness::depends_on_strain() const {
  constexpr double g = 0.5;
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (model_.in_cell(mesh_, c).damageable &&
        (!has_degradable_part(c) || !split(c).has_secant() || anisotropy(c) != nullptr ||
         split(c).secant(elasticity(c), g, 0.0) != split(c).secant(elasticity(c), g, 1.0)))
      return true;
  return false;
}

// The secant moduli are linear in g.
CellField<IsotropicElasticity> CellStiffness::degradable_part(const FractureState& state) const {
  CellField<IsotropicElasticity> part(mesh_.n_cells(), {});
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!has_degradable_part(c) || !split(c).has_secant() || anisotropy(c) != nullptr) return;
    const EnergySplit& law = split(c);
    const IsotropicElasticity whole = law.secant(elasticity(c), 1.0, state.closure[c]);
    const IsotropicElasticity kept = law.secant(elasticity(c), 0.0, state.closure[c]);
    part[c] = {.lambda = whole.lambda - kept.lambda, .mu = whole.mu - kept.mu};
  });
  return part;
}

// The splits of the regions may differ in kind.
StrainLaw CellStiffness::law(const CellField<double>& g, const CellField<double>& closure) const {
  struct At {
    CellField<double> g, closure;
  };
  const auto at = std::make_shared<const At>(At{g, closure});
  return {.tangent =
              [this, at](Index c, const Tensor& strain) {
                const EnergySplit& by = split(c);
                if (const AnisotropicElasticity* given = anisotropy(c))
                  return degraded_tangent(by, *given, at->g[c], strain);
                return by.has_secant() ? stiffness_matrix(by.secant(elasticity(c), at->g[c], at->closure[c]))
                                       : degraded_tangent(by, elasticity(c), at->g[c], strain);
              },
          .degradable = [this](Index c, const Tensor& strain) -> Tensor {
            if (!has_degradable_part(c)) return Tensor::Zero();
            if (const AnisotropicElasticity* given = anisotropy(c)) return degradable_stress(split(c), *given, strain);
            if (split(c).has_secant()) return Tensor::Zero();
            return degradable_stress(split(c), elasticity(c), strain);
          }};
}

// The part of the stiffness that the split keeps beyond g times it is elastic.
HistoryStress CellStiffness::with_histories(const FractureState& state, const CellField<double>& g,
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

double CellStiffness::integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state) {
  if (finite_.histories().any()) {
    CellField<Degraded> left(mesh_.n_cells());
    parallel_for(mesh_.n_cells(), [&](Index c) { left[c] = this->left(c, state); });
    finite_.advance(mechanics, left, state.histories);
  }
  if (!materials_.any()) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    if (!materials_.has(c)) return 0.0;
    const double wrong = materials_.advance(c, mechanics, start.histories, state.histories);
    return factor(c, state.damage[c]) * wrong * mesh_.cell_volume[c];
  });
}

double CellStiffness::driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  if (finite_.any()) return driving_energy(cell, finite_energies(cell, mechanics, state), state.damage[cell]).value;
  if (materials_.has(cell)) return materials_.energy(cell, state.histories).driving;
  if (const AnisotropicElasticity* given = anisotropy(cell); given != nullptr && !has_degradable_part(cell)) {
    const Mandel strain = to_mandel(mechanics.elastic_strain(cell));
    return 0.5 * strain.dot(given->stiffness * strain);
  }
  return has_degradable_part(cell) ? mechanics.part_energy[cell]
                                   : split(cell).energy(elasticity(cell), mechanics.elastic_strain(cell)).psi_plus;
}

FiniteEnergies CellStiffness::finite_energies(Index cell, const CellMechanics& mechanics,
                                              const FractureState& state) const {
  return finite_.energies(cell, mechanics, left(cell, state), state.histories);
}

CellField<FiniteEnergies> CellStiffness::finite_energies(const CellMechanics& mechanics,
                                                         const FractureState& state) const {
  CellField<FiniteEnergies> energies(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) { energies[c] = finite_energies(c, mechanics, state); });
  return energies;
}

DrivingAt CellStiffness::driving_energy(Index cell, const FiniteEnergies& at, double d) const {
  const double g_prime = model_.degradation_of(model_.in_cell(mesh_, cell)).g_prime(d);
  const DrivingAt by_g = finite_.driving_energy(cell, at, factor(cell, d));
  return {.value = by_g.value, .slope = (1.0 - model_.residual_stiffness) * g_prime * by_g.slope};
}

Tensor CellStiffness::undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  if (finite_.any()) return finite_.undamaged_biot_stress(cell, mechanics, left(cell, state));
  return stress(elasticity(cell), mechanics.elastic_strain(cell));
}

// Half the work on the elastic strain, and what is locked up.
double CellStiffness::stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  if (finite_.any()) return stored_energy(cell, finite_energies(cell, mechanics, state), state.damage[cell]);
  if (!materials_.has(cell)) return mechanics.energy[cell];
  const MaterialEnergy material = materials_.energy(cell, state.histories);
  const double on_inelastic = 0.5 * contract(mechanics.stress[cell], material.inelastic);
  const double locked = factor(cell, state.damage[cell]) * material.locked;
  return mechanics.energy[cell] + mesh_.cell_volume[cell] * (locked - on_inelastic);
}

double CellStiffness::stored_energy(Index cell, const FiniteEnergies& at, double d) const {
  return finite_.stored_energy(cell, at, factor(cell, d));
}

double CellStiffness::residual_energy(Index cell, double psi_plus, const FractureState& state) const {
  const RegionModel& region = model_.in_cell(mesh_, cell);
  if (!region.damageable) return 0.0;
  const double lost = 1.0 - model_.degradation_of(region).g(seen(cell, state));
  const double idle = materials_.has(cell) ? materials_.energy(cell, state.histories).idle : 0.0;
  return model_.residual_stiffness * lost * (psi_plus + idle) * mesh_.cell_volume[cell];
}

CellField<Mandel> CellStiffness::eigenstrain_moments(const CellMechanics& mechanics, const FractureState& state,
                                                     const Vector& plane_normal) const {
  if (!finite_.any()) return mechanics.traction_moment;
  CellField<Mandel> moments(mechanics.eigenstrain.size());
  parallel_for(moments.size(), [&](Index c) {
    moments[c] = to_mandel(finite_.eigenstrain_moment(c, mechanics, left(c, state), plane_normal));
  });
  return moments;
}

double CellStiffness::plastic_dissipation(const FractureState& from, const FractureState& to) const {
  if (!materials_.any() && !finite_.histories().any()) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return plastic_dissipation(c, from, to); });
}

double CellStiffness::plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const {
  if (finite_.any())
    return finite_.dissipation(cell, from.histories, factor(cell, from.damage[cell]), to.histories,
                               factor(cell, to.damage[cell]));
  if (!materials_.has(cell)) return 0.0;
  const double g_from = factor(cell, from.damage[cell]), g_to = factor(cell, to.damage[cell]);
  return mesh_.cell_volume[cell] *
         degraded_heat(g_from, materials_.energy(cell, from.histories), g_to, materials_.energy(cell, to.histories));
}

double CellStiffness::follow(const CellMechanics& mechanics, FractureState& state) {
  if (finite_.any()) return parallel_sum(mesh_.n_cells(), [&](Index c) { return follow_volume(c, mechanics, state); });
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    return split(c).has_secant() && anisotropy(c) == nullptr ? follow_with_closure(c, mechanics, state) : 0.0;
  });
}

// The strain with the volume change that belongs to the cell's mean stress. The tractions hold a closed crack; the
// volume change of the face displacements may have the other sign where the strain varies within a cell, and the crack
// would open and close for ever.
Tensor CellStiffness::closing_strain(Index cell, const CellMechanics& mechanics, double g, double closure) const {
  const Tensor strain = mechanics.elastic_strain(cell);
  const double K = split(cell).secant(elasticity(cell), g, closure).bulk_modulus();
  return deviator(strain) + mechanics.stress[cell].trace() / (9.0 * K) * Tensor::Identity();
}

// At finite strain.
double CellStiffness::follow_volume(Index cell, const CellMechanics& mechanics, FractureState& state) {
  const Degraded left{factor(cell, seen(cell, state)), state.closure[cell]};
  const std::optional<double> change = finite_.closing_change(cell, mechanics, left);
  if (!change) return 0.0;
  state.closure[cell] = closures_.next(cell, left.g, left.closure, *change < 0.0 ? 1.0 : 0.0);
  return finite_.closing_energy(cell, *change, left);
}

double CellStiffness::follow_with_closure(Index cell, const CellMechanics& mechanics, FractureState& state) {
  const double g = factor(cell, seen(cell, state)), before = state.closure[cell];
  const Tensor strain = closing_strain(cell, mechanics, g, before);
  const double wanted = split(cell).closure(strain);
  state.closure[cell] = closures_.next(cell, g, before, wanted);
  if (wanted == before) return 0.0;
  const double wrong = energy_density(split(cell).secant(elasticity(cell), g, wanted), strain) -
                       energy_density(split(cell).secant(elasticity(cell), g, before), strain);
  return mesh_.cell_volume[cell] * std::abs(wrong);
}

}  // namespace pfdm
