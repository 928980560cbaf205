#pragma once
// The stiffness of damaged cells and their energies, as the damage loop asks for them: at small strain
// (small_stiffness.h) and at finite strain (finite_stiffness.h). Within the momentum solve the stiffness is linear,
// taken at the last strain.

#include "solver/fracture/cells/crack_closures.h"
#include "solver/fracture/model/driving_law.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <memory>
#include <utility>
#include <vector>

namespace pfdm {

/// How equilibrium is found: in one solve; by Newton's method in a convex energy (law_newton.h); at finite strain
/// (finite_newton.h).
enum class BalanceIs : char { linear, convex, finite };

/// Energies of the cells at an equilibrium.
struct CellEnergies {
  CellField<double> driving;  ///< psi_plus, the derivative of a cell's energy by the stiffness factor g [J/m^3]
  CellField<double> stored;   ///< [J]
  CellField<double> idle;     ///< degraded by damage which it does not drive [J/m^3]
  DrivingLaw law{};           ///< psi_plus at any damage; empty where it is `driving` at any
};

class CellStiffness {
 public:
  CellStiffness(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {}
  virtual ~CellStiffness() = default;
  CellStiffness(const CellStiffness&) = delete;
  CellStiffness& operator=(const CellStiffness&) = delete;

  /// Begins a load step, which takes `duration` [s]: clears the memory of how the strains moved in the previous one.
  /// `shift`: a_T of every cell (temperature_shift.h); empty: 1.
  virtual void start_step(double duration, const CellField<double>& shift = {});
  /// Prepares the balance for its laws, and takes from it which sides have a gradient of their own at finite strain;
  /// before all else.
  virtual void prepare(MomentumSolver&) {}
  virtual CellHistories virgin_histories() const { return {}; }
  /// The numbers of the histories that results show.
  virtual std::vector<OutputHistory> output(const CellHistories&) const { return {}; }
  /// Has cells at finite strain begin a step of this duration [s] at a state; 0: holds it. Before set() of this state
  /// or of later ones within the step.
  virtual void start_from(const FractureState&, double) {}
  /// Takes a trial state, which is that of the start, to what linear laws with a history make of it in the step at held
  /// strains. After start_step().
  virtual void hold(FractureState&) {}
  /// The damage that degrades stiffness where it is not the states' own (stiffness_damage.h), for the states that
  /// follow.
  void see(CellField<double> damage) { seen_ = std::move(damage); }

  virtual BalanceIs balance_is() const = 0;
  /// Whether stresses are functions of the displacements of the state, about which they are linearised.
  bool is_linearised() const { return balance_is() != BalanceIs::linear; }
  virtual bool has_histories() const = 0;
  /// Gives the momentum balance the stiffness that belongs to the damage, closure and tangent strain of the state.
  void set(const FractureState& state, MomentumSolver& momentum) const;
  /// The part of the stiffness whose energy the driving ones need (CellMechanics::part_energy), by cell: that which
  /// damage degrades; of cells with a history that which it keeps, or of relaxed moduli that which it degrades. Zero
  /// where it is not given by isotropic moduli, and where nothing is degraded.
  virtual CellField<IsotropicElasticity> degradable_part(const FractureState& state) const;
  /// Has the closure of the state follow the stress and the strain. Returns the energy error [J] of the stiffness that
  /// was used.
  virtual double follow(const CellMechanics& mechanics, FractureState& state) = 0;
  /// Broken cells whose cracks the last follow() has opened or closed (crack_closures.h).
  std::vector<Index> moving_cracks() const { return closures_.moving(); }
  /// Takes the cells with a history from `start` to these strains. Returns the energy error [J] of the stress that
  /// was used; NaN where a material's step cannot be solved.
  virtual double integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state) = 0;

  /// Energies of all cells. `mechanics` has to have that of the part of the stiffness that is degraded; where there is
  /// none the driving energy is that of the strain, with a history that of the state.
  virtual CellEnergies energies(const CellMechanics& mechanics, const FractureState& state) const = 0;
  /// Those of one cell.
  virtual double driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const = 0;
  virtual double stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const = 0;
  /// Whether alternate minimisation descends: the driving energy of every damageable cell is the derivative of the
  /// discrete energy. That of the part of the stiffness that damage degrades is; at finite strain nearly so, where no
  /// pressure is lost faster than the stiffness.
  bool descends() const;
  /// Whether the stiffness of some damageable cell depends on its strain, as where cracks close.
  virtual bool depends_on_strain() const = 0;
  /// The part of what a cell stores [J] that the residual stiffness alone has, at this driving and idle energy [J/m^3]
  /// (residual_stiffness.h).
  double residual_energy(Index cell, double psi_plus, double idle, const FractureState& state) const;
  /// Moments [J] of the work of eigenstrains, which is minus these times their growth; empty without eigenstrains.
  virtual CellField<Mandel> eigenstrain_moments(const CellMechanics& mechanics, const FractureState& state,
                                                const Vector& plane_normal) const = 0;
  /// Energy dissipated by the materials [J] from one state to the other, with the heat of what damage has freed and did
  /// not drive it.
  double plastic_dissipation(const FractureState& from, const FractureState& to) const;
  /// The part of it in a cell [J].
  virtual double plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const = 0;
  /// Stress of the undamaged material [Pa], on which strength depends: at finite strain Biot's.
  virtual Tensor undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState& state) const = 0;
  /// Puts strain and stress of the results where they are not those of small strain, which the fields have: F of the
  /// cells, with the stretch across a plate in plane stress, Green's strain and Cauchy's stress [Pa].
  virtual void show(const CellMechanics&, const FractureState&, const Vector&, OutputFields&) const {}

 protected:
  double factor(Index cell, double d) const;  // g, the residual stiffness included
  double seen(Index cell, const FractureState& state) const {
    return seen_.size() > 0 ? seen_[cell] : state.damage[cell];
  }
  // The stiffness at these g, by the damage that degrades it.
  virtual void give(const FractureState& state, const CellField<double>& g, MomentumSolver& momentum) const = 0;
  bool is_damageable(Index cell) const { return model_.in_cell(mesh_, cell).damageable; }
  // Of a damageable cell.
  virtual bool descends(Index cell) const = 0;

  const Mesh& mesh_;
  const FractureModel& model_;
  CrackClosures closures_;

 private:
  CellField<double> seen_;  // may be empty
};

std::unique_ptr<CellStiffness> make_cell_stiffness(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
