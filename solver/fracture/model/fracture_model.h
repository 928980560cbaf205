#pragma once
// The input of a fracture run besides its mesh: materials by region, boundary conditions, settings.

#include "mesh/mesh.h"
#include "physics/damage/crack_geometry.h"
#include "physics/damage/degradation.h"
#include "physics/damage/energy_split.h"
#include "physics/damage/fatigue.h"
#include "physics/interfaces/interface_law.h"
#include "physics/materials/material.h"
#include "physics/materials/strength_model.h"
#include "solver/fracture/model/fatigue_state.h"
#include "solver/heat/heat_model.h"
#include "solver/momentum/body/boundary_condition.h"
#include "solver/momentum/body/unknowns.h"
#include "solver/momentum/solution/preconditioner.h"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct TemperatureShift;

/// Value at x [m] and the load parameter t.
template <class Value>
using LoadField = std::function<Value(const Vector& x, double t)>;

struct RegionModel {
  IsotropicElasticity elasticity;
  double Gc = 0.0;            ///< fracture toughness [J/m^2]
  double ell = 0.0;           ///< regularisation length [m]
  bool damageable = true;     ///< false pins d = 0 in the region
  EnergySplit split{};        ///< if none is chosen, the model's
  Degradation degradation{};  ///< if none is chosen, the model's
  StrengthModel strength{};   ///< none is chosen: the energy alone drives damage
  Fatigue fatigue{};          ///< none is chosen: cycles of load leave the toughness as it is
  /// The undamaged material, with the same elasticity; null: linear elastic.
  std::shared_ptr<const Material> material{};

  double density = 0.0;                                    ///< on which gravity acts [kg/m^3]
  Tensor expansion = Tensor::Zero();                       ///< thermal, symmetric [1/K]
  std::shared_ptr<const LoadField<Tensor>> eigenstrain{};  ///< given besides [-]; null: none
  double conductivity = 0.0;                               ///< of heat [W/(m K)]; where there is heat
  double specific_heat = 0.0;                              ///< of the density [J/(kg K)]; where there is heat
  /// Elasticity that depends on the direction [Pa]; `elasticity` is then the closest isotropic one, an estimate. Null:
  /// `elasticity` is it.
  std::shared_ptr<const MandelMatrix> stiffness{};

  /// How the times of its material depend on the temperature; null: they do not, or there are none.
  const TemperatureShift* temperature_shift() const;
  /// Toughness of the surface energy [J/m^2]: a strength model pays part of Gc otherwise.
  double surface_toughness() const { return strength.is_chosen() ? strength.delta() * Gc : Gc; }
};

enum class Irreversibility {
  bounds,     ///< d_n <= d <= 1, by active set
  crack_set,  ///< the same where d_n >= 0.95, elsewhere 0 <= d <= 1: only cracks stay (Bourdin et al., JMPS 48 (2000)
              ///< 797)
  history,    ///< the driving energy is the largest that was seen (Miehe et al., CMAME 199 (2010) 2765, eq. 38)
};

/// The damage that degrades the stiffness of a cell: its own, or of hexahedra the mean about it (stiffness_damage.h).
enum class StiffnessBy { cell, mean };

/// Loads within the body from the first step on; each may be empty: nothing. At the beginning there is none of it.
struct BodyLoads {
  LoadField<Vector> gravity{};      ///< acceleration [m/s^2], which acts on the density of the regions
  LoadField<Vector> force{};        ///< per reference volume, in all regions [N/m^3]
  LoadField<double> temperature{};  ///< change of it [K]
  double start_temperature = 0.0;   ///< from which changes and rises by heat count [K]; 0: not known
};

/// Interior faces whose sides a cohesive law joins.
struct CohesiveSurface {
  std::string name;
  InterfaceLaw law;
  std::vector<Index> faces;
  /// Sign of each face: 1, or -1 where its normal leads to the first side of the interface, from which separations and
  /// tractions are told. Empty: the normal always leaves it.
  std::vector<double> sign{};
  /// One per face. A stiffness of zero, of a law with a straight rise: initially rigid (cohesive_faces.h).
  std::vector<InterfaceStrength> at{};
};

struct FractureModel {
  /// One per region of the mesh; of a region that varies, an example. Regions whose elasticities are equal here share
  /// an elastic zone.
  std::vector<RegionModel> regions;
  CellField<RegionModel> cells{};  ///< one per cell where a region varies from cell to cell; else empty
  const CrackGeometry* crack = nullptr;
  Degradation degradation{};
  EnergySplit split{};
  Irreversibility irreversibility = Irreversibility::bounds;
  StiffnessBy stiffness_by = StiffnessBy::cell;
  double residual_stiffness = 1e-6;         ///< k of g_k = (1 - k) g + k
  double viscosity = 0.0;                   ///< eta of the damage equation [Pa s]; 0: rate-independent
  std::vector<BoundaryCondition> boundary;  ///< patches that are not named are free
  BoxMotion motion{};                       ///< of a box by its mean strain; then nothing is prescribed on patches
  BodyLoads loads{};
  std::vector<CohesiveSurface> interfaces{};  ///< no face in two of them
  std::optional<HeatModel> heat{};            ///< none: what is dissipated warms nothing
  FatigueCycles fatigue_cycles{};             ///< of the load, for jumps over them
  /// Least damage at load 0, between 0 and 1 [-]: the damage has the profile of least surface energy. Empty: none.
  CellField<double> initial_damage{};

  const RegionModel& in_cell(const Mesh& mesh, Index cell) const {
    return cells.size() > 0 ? cells[cell] : regions[mesh.region[cell]];
  }
  const EnergySplit& split_of(const RegionModel& region) const {
    return region.split.is_chosen() ? region.split : split;
  }
  const Degradation& degradation_of(const RegionModel& region) const {
    return region.degradation.is_chosen() ? region.degradation : degradation;
  }
  /// Whether the laws of the materials are of finite strain: those of all regions, or of none.
  bool is_finite_strain() const;
  bool is_plane_stress() const;  ///< whether front and back of a plane mesh bear no stress
  bool has_strength() const;     ///< whether some region has a strength model
  bool has_body_force() const;   ///< whether a force or gravity is given
  bool has_eigenstrain() const;  ///< whether some region expands or has one
  bool has_cycles() const { return fatigue_cycles.any() || (heat && heat->cycle > 0.0); }  ///< of the load
  bool is_warmed() const { return heat && heat->is_two_way; }  ///< whether rises by heat act on the body
  /// The least damage that a step from this one may end with.
  CellField<double> lower_bound(const CellField<double>& damage) const;
  bool is_anisotropic() const;  ///< whether the elasticity of some region depends on the direction
  /// Whether every cell has isotropic secant moduli.
  bool is_isotropic() const;
};

/// Regions of equal elasticity and equal material are one zone.
ElasticBody elastic_body(const FractureModel& model);

struct StaggeredSettings {
  double damage_tolerance = 1e-4;       ///< largest change of d between iterations
  double damage_tolerance_l2 = 0.0;     ///< L2 norm of its change over that of d; suffices too. 0: not looked at
  double energy_tolerance = 1e-4;       ///< change of the energy over it, and error of stiffnesses over the stored one
  double equilibrium_tolerance = 1e-6;  ///< row-scaled residual of the momentum balance at an accepted step, relative
  Index maximum_iterations = 500;
  double long_step = 120.0;              ///< time after which a step says how far it is [s]
  const LinearSolver* linear = nullptr;  ///< of the momentum balance; null: the automatic choice
};

struct LoadingSettings {
  double end = 1.0;                 ///< load parameter t at the end
  double initial_increment = 0.05;  ///< of t
  double minimum_increment = 1e-5;
  double maximum_increment = 0.05;
  /// Increments are chosen so that the damage of no cell grows by more than this within a step. Steps of the finest
  /// increment or less are not limited.
  double damage_growth = std::numeric_limits<double>::infinity();
  /// Largest energy that a step's cracks release, over the elastic energy at its load plus the surface energy;
  /// increments are chosen so.
  double energy_release = std::numeric_limits<double>::infinity();
  double finest_increment = 1e-3;  ///< of t
  /// Dissipation control: surface energy that a step may dissipate [J], in proportion less while the increment is below
  /// its maximum. A load that would dissipate more is lowered, also below that of the step before, so that the
  /// snap-back branch is traced.
  double maximum_dissipation = std::numeric_limits<double>::infinity();
  /// Time in which the load parameter grows by 1 [s]; required by a viscosity, by rate-dependent materials and by heat.
  double duration = 0.0;
  std::vector<double> stops;  ///< values of t that a step must end on (frames)
  /// Whether what is prescribed may be taken as proportional to t: the first guess of a step.
  bool is_proportional = true;

  bool controls_dissipation() const { return std::isfinite(maximum_dissipation); }
};

}  // namespace pfdm
