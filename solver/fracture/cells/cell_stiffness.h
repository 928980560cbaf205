#pragma once
// The stiffness of damaged cells, which depends on the strain where the energy split keeps compression. Within the
// momentum solve it is linear, taken at the last strain: secant moduli where the split has isotropic ones, else its
// tangent. The tangent is the secant as well (energies of second degree), so the solves are Newton's steps. Cells with
// a history are linearised about it, with a stress of their own.

#include "solver/fracture/cells/crack_closures.h"
#include "solver/fracture/cells/finite_cells.h"
#include "solver/fracture/cells/material_cells.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <memory>
#include <utility>
#include <vector>

namespace pfdm {

class CellStiffness {
 public:
  CellStiffness(const Mesh& mesh, const FractureModel& model);

  /// Begins a load step, which takes `duration` [s]: clears the memory of how the strains moved in the previous one.
  /// `shift`: a_T of every cell (temperature_shift.h); empty: 1.
  void start_step(double duration, const CellField<double>& shift = {});
  /// Names the cells of the sides that have a gradient of their own at finite strain; before virgin_histories().
  void set_own_sides(std::vector<Index> cells) { finite_.set_own_sides(std::move(cells)); }
  CellHistories virgin_histories() const;
  /// Has cells at finite strain begin a step of this duration [s] at a state; 0: holds it. Before set() of this state
  /// or of later ones within the step.
  void start_from(const FractureState& start, double duration) { finite_.start_from(start.histories, duration); }
  /// Takes a trial state, which is that of the start, to what linear laws with a history make of it in the step at held
  /// strains. After start_step().
  void hold(FractureState& state) { materials_.hold(state.histories); }
  /// The damage that degrades stiffness where it is not the states' own (stiffness_damage.h), for the states that
  /// follow.
  void see(CellField<double> damage) { seen_ = std::move(damage); }
  /// Gives the momentum balance the stiffness that belongs to the damage, closure and tangent strain of the state.
  void set(const FractureState& state, MomentumSolver& momentum) const;
  /// The part of the stiffness that damage degrades, by cell; zero where it is not given by isotropic moduli, and where
  /// nothing is degraded.
  CellField<IsotropicElasticity> degradable_part(const FractureState& state) const;
  /// Has the closure or the tangent strain of the state follow the stress and the strain. Returns the energy error [J]
  /// of the stiffness that was used.
  double follow(const CellMechanics& mechanics, FractureState& state);
  /// Broken cells whose cracks the last follow() has opened or closed (crack_closures.h).
  std::vector<Index> moving_cracks() const { return closures_.moving(); }
  /// Takes the cells with a history from `start` to these strains. Returns the energy error [J] of the stress that
  /// was used; NaN where a material's step cannot be solved.
  double integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state);

  /// psi_plus [J/m^3] of a cell, the derivative of its energy by the stiffness factor g. It is the energy of the part
  /// of the stiffness that is degraded, which `mechanics` has to have. Where there is none it is that of the strain,
  /// with a history that of the state.
  double driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const;
  /// Parts of the cells' energies at finite strain, and psi_plus at any damage d of a cell, with its derivative by d.
  CellField<FiniteEnergies> finite_energies(const CellMechanics& mechanics, const FractureState& state) const;
  DrivingAt driving_energy(Index cell, const FiniteEnergies& at, double d) const;
  /// Whether alternate minimisation descends: the driving energy of every damageable cell is the derivative of the
  /// discrete energy. That of the part of the stiffness that damage degrades is; at finite strain nearly so, where no
  /// pressure is lost faster than the stiffness.
  bool descends() const;
  /// Whether the stiffness of some damageable cell depends on its strain, as where cracks close.
  bool depends_on_strain() const;
  /// Whether stresses are functions of the strain, linearised about the displacements of the state: equilibrium is
  /// found by Newton's method.
  bool is_linearised() const { return finite_.any() || !is_isotropic_; }
  /// Energy that a cell stores [J].
  double stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const;
  double stored_energy(Index cell, const FiniteEnergies& at, double d) const;
  /// The part of what a cell stores [J] that the residual stiffness alone has, at this driving energy [J/m^3]
  /// (residual_stiffness.h).
  double residual_energy(Index cell, double psi_plus, const FractureState& state) const;
  /// Moments [J] of the work of eigenstrains, which is minus these times their growth; empty without eigenstrains.
  CellField<Mandel> eigenstrain_moments(const CellMechanics& mechanics, const FractureState& state,
                                        const Vector& plane_normal) const;
  /// Energy dissipated by the materials [J] from one state to the other, with the heat of what damage has freed and did
  /// not drive it.
  double plastic_dissipation(const FractureState& from, const FractureState& to) const;
  /// The part of it in a cell [J].
  double plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const;
  /// Stress of the undamaged material [Pa], on which strength depends: at finite strain Biot's.
  Tensor undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState& state) const;
  const MaterialCells& materials() const { return materials_; }
  const FiniteCells& finite() const { return finite_; }
  /// Displacement gradient at finite strain, with the stretch across a plate in plane stress.
  Tensor thinned_gradient(Index cell, const CellMechanics& mechanics, const FractureState& state) const;
  Tensor cauchy_stress(Index cell, const CellMechanics& mechanics, const FractureState& state,
                       const Vector& plane_normal) const;

 private:
  double factor(Index cell, double d) const;  // g, the residual stiffness included
  Degraded left(Index cell, const FractureState& state) const {
    return {factor(cell, state.damage[cell]), state.closure[cell]};
  }
  double seen(Index cell, const FractureState& state) const {
    return seen_.size() > 0 ? seen_[cell] : state.damage[cell];
  }
  FiniteEnergies finite_energies(Index cell, const CellMechanics& mechanics, const FractureState& state) const;
  CellField<double> factors(const FractureState& state) const;
  /// Cells with a history at the state; their moduli become those that gaps meet.
  HistoryStress with_histories(const FractureState& state, const CellField<double>& g,
                               CellField<IsotropicElasticity>& moduli) const;
  const IsotropicElasticity& elasticity(Index cell) const;
  // Elasticity that depends on the direction; null where it does not.
  const AnisotropicElasticity* anisotropy(Index cell) const {
    return anisotropy_.size() > 0 ? anisotropy_[cell].get() : nullptr;
  }
  const EnergySplit& split(Index cell) const;
  StrainLaw law(const CellField<double>& g, const CellField<double>& closure) const;
  bool has_degradable_part(Index cell) const;
  Tensor closing_strain(Index cell, const CellMechanics& mechanics, double g, double closure) const;
  double follow_with_closure(Index cell, const CellMechanics& mechanics, FractureState& state);
  double follow_volume(Index cell, const CellMechanics& mechanics, FractureState& state);

  const Mesh& mesh_;
  const FractureModel& model_;
  MaterialCells materials_;
  FiniteCells finite_;
  CellField<std::shared_ptr<const AnisotropicElasticity>> anisotropy_;  // null: isotropic; empty: all of them
  CellField<double> seen_;                                              // may be empty
  bool is_isotropic_;                                                   // every cell has isotropic secant moduli
  CrackClosures closures_;
};

}  // namespace pfdm
