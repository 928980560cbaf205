#pragma once
// The cells of a body at finite strain: hyperelastic laws (physics/materials/hyperelastic.h). Damage degrades the part
// of the energy W that the split does not keep:
//
//   none, hybrid           W = g W(F)
//   volumetric_deviatoric  W = g (W(F) - W_c) + W_c,  W_c = W(J^(1/3) 1) where J < 1, else 0
//
// Whether a crack is closed, J < 1, is held while equilibrium is found and follows from one iteration of the loop to
// the next, as at small strain (crack_closures.h): W = g (W - closure W_c) + closure W_c at any J. With a pressure,
// which bears all of a closed crack, (K_m/kappa) c U takes the place of W_c of W_m, K_m and kappa being their bulk
// moduli.
//
// `hybrid` is driven as volumetric_deviatoric, by W - W_c, and is not variational (Ambati, Gerasimov, De Lorenzis,
// Comput. Mech. 55 (2015) 383). What broken cells become is in finite_degradation.h.
//
// Stress, stored and driving energy of the mean gradient are derivatives of this one energy. It is not linear in g: the
// damage equation takes its derivative at every d (driving_law.h). The driving energy of what the faces add is exact
// where that is proportional to g.
//
// Plates in plane stress: finite_sheets.h.
//
// Cells that expand, swell or shrink (eigenstrains): F above is the elastic part F_e of F = F_e F*, and energies are J*
// times those of F_e per reference volume (physics/materials/free_deformation.h). A cell's pressure acts as without, on
// the volume J* J_e(q). With m = F*^-T N the acoustic tensor of the faces is J* (mu m.m + ...), by the mean of m.m.
//
// Viscoelastic materials: the energy of the branches is degraded as W_m is, and their stress that of the step from its
// start (finite_histories.h). Closed cracks keep the elastic W_c.

#include "mesh/mesh.h"
#include "physics/materials/free_deformation.h"
#include "physics/materials/hyperelastic.h"
#include "solver/fracture/cells/finite_degradation.h"
#include "solver/fracture/cells/finite_energies.h"
#include "solver/fracture/cells/finite_histories.h"
#include "solver/fracture/model/driving_law.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pfdm {

class FiniteCells {
 public:
  /// Of a model of finite strain.
  FiniteCells(const Mesh& mesh, const FractureModel& model);
  virtual ~FiniteCells() = default;
  FiniteCells(const FiniteCells&) = delete;
  FiniteCells& operator=(const FiniteCells&) = delete;

  bool has_pressure(Index cell) const { return material_[cell]->pressure_modulus() > 0.0; }
  /// Whether the driving energy is nearly the derivative of the discrete one: a pressure is lost faster than the
  /// stiffness, and branches dissipate.
  bool descends(Index cell) const { return !has_pressure(cell) && !histories_.has(cell); }
  /// Law of a place at the displacement gradient H.
  FiniteLaw law(FinitePlace at, const Tensor& H, const Degraded& left, const FreeDeformation& free = {}) const;
  const FiniteHistories& histories() const { return histories_; }
  void set_own_sides(std::vector<Index> cells) { histories_.set_own_sides(std::move(cells)); }
  /// a_T of every cell (temperature_shift.h) in the steps that follow; empty: 1.
  void shift_times(const CellField<double>& factor) { histories_.shift_times(factor); }
  /// Begins a step at these histories, which takes `duration` [s]; 0: holds them. Laws and energies are those of it.
  void start_from(const CellHistories& start, double duration) { histories_.start_from(start, duration); }
  /// Takes the histories of viscoelastic cells, if there are any, to the deformation of now.
  void advance(const CellMechanics& mechanics, const CellField<Degraded>& left, CellHistories& to);
  /// Heat of the branches of a cell from one history to another while its factor went from g_from to g_to, with what
  /// damage frees of them without being driven by it [J].
  double dissipation(Index cell, const CellHistories& from, double g_from, const CellHistories& to, double g_to) const;
  /// J_e - 1 of a cell, from its mean stress, whose crack is closed where that is negative. None where the split does
  /// not keep compression.
  std::optional<double> closing_change(Index cell, const CellMechanics& mechanics, const Degraded& left) const;
  /// Energy [J] by which the closure errs where the volume has changed so.
  double closing_energy(Index cell, double change, const Degraded& left) const;

  /// Energies of a cell by its mean gradient and by its faces, the work of whose tractions comes on top (momentum.h).
  /// g: factor with which the displacements were found; now: histories there, none of elastic cells.
  FiniteEnergies energies(Index cell, const CellMechanics& mechanics, const Degraded& left,
                          const CellHistories& now = {}) const;
  /// Energy that a cell stores [J].
  double stored_energy(Index cell, const FiniteEnergies& at, double g) const;
  /// Derivative of the stored energy by g, per volume, and its own derivative by g [J/m^3].
  DrivingAt driving_energy(Index cell, const FiniteEnergies& at, double g) const;

  /// The mean gradient H with the stretch across a plate at which it has no stress across it; else H.
  virtual Tensor thinned(Index cell, const CellMechanics& mechanics, const Degraded&) const {
    return mechanics.gradient[cell];
  }

  /// Biot stress [Pa] of the undamaged material at the mean gradient; pressures that damage has relaxed count as they
  /// are.
  Tensor undamaged_biot_stress(Index cell, const CellMechanics& mechanics, const Degraded& left) const;

  /// Derivative of the stored energy by F* at constant displacements, V dW/dF* [J], with its sign changed. It is
  /// computed from the tractions as far as they are known: eigenstrains that grow by d eps* supply minus this times d
  /// eps*.
  Tensor eigenstrain_moment(Index cell, const CellMechanics& mechanics, const Degraded& left,
                            const Vector& plane_normal) const;

  /// Cauchy stress [Pa] from the first Piola-Kirchhoff stress of the tractions, with that across a plane mesh.
  Tensor cauchy_stress(Index cell, const CellMechanics& mechanics, const Degraded& left,
                       const Vector& plane_normal) const;

 protected:
  // Undamaged, at some F_e - 1 = H: W_m, the network's, c U, that of branches, and where compression does not
  // drive the damage W_c and the share of it that does not: the closure, or with `hybrid` 1 where J of H < 1. `closure`
  // is that of the pressure: with `hybrid` by `change`.
  struct Parts {
    PotentialAt moderate, network, pressure{}, dilation{}, branches{};
    double taken = 0.0, closure = 0.0;
  };
  Parts parts(FinitePlace at, const Tensor& H, double change, double closure) const;
  Parts parts(FinitePlace at, const Tensor& H, double closure) const { return parts(at, H, volume_change(H), closure); }
  PotentialAt damaged(Index cell, const Parts& at, const FiniteShares& by, double g) const;
  const HyperelasticMaterial& material(Index cell) const { return *material_[cell]; }
  static FreeDeformation free_deformation(Index cell, const CellMechanics& mechanics);
  Tensor thinned_elastic(Index cell, const CellMechanics& mechanics, const Degraded& left) const {
    return thinned({cell}, elastic(mechanics.gradient[cell], free_deformation(cell, mechanics)), left);
  }

 private:
  // F_e - 1 of H; of a plate within its plane.
  virtual Tensor elastic(const Tensor& H, const FreeDeformation& free) const { return free.elastic(H); }
  // The law of F_e - 1 = H.
  virtual FiniteLaw elastic_law(FinitePlace at, const Tensor& H, const Degraded& left) const;
  // H with the stretch across a plate at which there is no stress across it.
  virtual Tensor thinned(FinitePlace, const Tensor& H, const Degraded&) const { return H; }
  // The deformation gradient for the Cauchy stress.
  virtual Tensor true_deformation(Index, const Tensor& H, const Degraded&) const { return Tensor::Identity() + H; }

  Parts parts(Index cell, const CellMechanics& mechanics, const Tensor& H, double closure) const {
    return parts({cell}, H, change_of(cell, mechanics, H), closure);
  }
  double change_of(Index cell, const CellMechanics& mechanics, const Tensor& H) const;
  FiniteEnergies mean_energies(Index cell, const CellMechanics& mechanics, const Parts& at) const;
  Tensor beside_law(Index cell, const CellMechanics& mechanics, const Parts& at, const Tensor& P, double g) const;
  double beside_mean(Index cell, const CellMechanics& mechanics, const Parts& at, double g) const;
  PotentialAt of_branches(FinitePlace at, const Tensor& H) const;
  void add_branches(FinitePlace at, const Tensor& H, const FiniteShares& by, FiniteLaw& law) const;
  Tensor traction_stress(Index cell, const CellMechanics& mechanics, const Degraded& left,
                         const Vector& plane_normal) const;
  bool keeps_compression(Index cell) const { return split_[cell]->keeps_compression; }
  // Of what damage leaves `share` of, with a closed crack that keeps the part `kept` of the rest.
  static double share_left(double share, double kept) { return share + kept * (1.0 - share); }
  // Share of a cell's W_c that the split keeps from the degradation.
  double kept(Index cell, const auto& at) const { return keeps_compression(cell) ? at.closure : 0.0; }

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<const HyperelasticMaterial*> material_;
  CellField<const FiniteSplit*> split_;
  FiniteHistories histories_;
  CellField<double> free_volume_;         // J* of viscoelastic cells as they were advanced; empty: 1
  Vector plane_normal_ = Vector::Zero();  // of a plane mesh
};

/// Those of a model of finite strain: a body's, or a plate's in plane stress.
std::unique_ptr<FiniteCells> make_finite_cells(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
