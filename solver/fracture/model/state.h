#pragma once
// The state of a fracture run is a value: it can be copied, written, and restarted from.

#include "mesh/fields.h"
#include "physics/interfaces/interface_law.h"
#include "solver/fracture/model/cell_histories.h"
#include "solver/fracture/model/energy_account.h"
#include "solver/fracture/model/fatigue_state.h"
#include "solver/heat/heat_state.h"
#include "solver/momentum/body/box_means.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// How tightly the forces on the parts of a body have to balance.
struct ForceBalance {
  double greatest_force = 0.0;  ///< through a section of the body, so far [N]
  double tightening = 1.0;      ///< factor on the tolerances of the momentum balance
  bool is_tightest = false;     ///< smaller tolerances have not brought the forces closer to balance
};

struct FractureState {
  Index step = 0;          ///< accepted load steps so far
  double load = 0.0;       ///< load parameter t
  double increment = 0.0;  ///< the next increment to try
  /// Displacement [m] of the cells, then of the faces that carry an unknown (material interfaces and boundary).
  std::vector<Vector> displacement;
  CellField<double> damage;                  ///< d [-]
  CellField<double> driving_energy;          ///< psi_plus, or its history [J/m^3]
  CellField<double> closure;                 ///< of the energy split: 1 where cracks are closed, 0 where open
  CellHistories histories;                   ///< of the effective materials
  std::vector<InterfaceHistory> interfaces;  ///< of the cohesive faces, one surface after the other
  std::vector<Vector> boundary_force;        ///< on each boundary face [N], in the mesh's face order
  EnergyAccount energy;
  HeatState heat{};        ///< without heat empty
  FatigueState fatigue{};  ///< without fatigue empty
  ForceBalance balance{};
};

/// Report on a body that heat warms.
struct HeatReport {
  HeatFigures figures{};
  HeatBalance account{};
  double cycle_change = 0.0;  ///< of the last whole cycle's heat from the one before, relative; infinite before two
  double elapsed = 0.0;       ///< since the start, with the times that cycles stood for [s]
};

/// One row of the force-displacement curve.
struct StepReport {
  Index step = 0;
  double load = 0.0;
  std::vector<Vector> reaction;            ///< force on each patch [N]
  std::vector<Vector> patch_displacement;  ///< area mean of each patch's displacement [m]
  EnergyAccount energy;
  std::optional<BoxMeans> means;      ///< of a box that moves by its mean strain
  std::vector<double> debonded_area;  ///< of each cohesive surface: where it has dissipated nine tenths or more [m^2]
  std::optional<HeatReport> heat;     ///< of a body that heat warms
  std::optional<FatigueReport> fatigue;  ///< of a body with fatigue
  double max_damage = 0.0;               ///< [-]
  double damaged_volume = 0.0;           ///< volume with d > 0.5 [m^3]
  Index staggered_iterations = 0;
  Index krylov_iterations = 0;
  double increment = 0.0;            ///< of the load parameter
  std::vector<std::string> remarks;  ///< increments that were cut, a residual stiffness that distorts
};

/// Output of the histories of the materials, one of both fields; zero in the cells of other materials.
struct OutputHistory {
  std::string name;
  std::string_view unit;
  CellField<double> scalar{};
  CellField<Tensor> tensor{};
};

/// The faces of a cohesive surface, one value per face.
struct OutputInterface {
  std::string name;
  std::vector<Index> faces;
  CellField<Vector> separation;  ///< of the second side from the first [m]
  CellField<Vector> traction;    ///< on the first side [Pa]
  CellField<double> opening;     ///< along the normal [m]
  CellField<double> damage;      ///< fraction of the toughness that has been dissipated
  CellField<double> dissipated;  ///< by decohesion [J/m^2]
};

/// Fields for output at a converged state.
struct OutputFields {
  CellField<Vector> displacement;  ///< [m]
  CellField<double> damage;        ///< [-]
  CellField<Tensor> stress;        ///< [Pa]
  CellField<Tensor> strain;        ///< [-]
  CellField<Tensor> gradient{};    ///< of the displacement, du_i/dx_j [-]
  /// F [-]; only at finite strain, where `stress` is Cauchy's, `strain` Green's, `traction` P N per reference area, and
  /// energies are per reference volume.
  CellField<Tensor> deformation_gradient{};
  CellField<double> energy_density;  ///< degraded elastic energy [J/m^3]
  CellField<double> driving_energy;  ///< [J/m^3]
  /// Discrete surface energy over the cell's volume, half of a face's to each of its cells [J/m^3].
  CellField<double> fracture_energy_density;
  std::vector<OutputHistory> history{};       ///< of materials that have one
  std::vector<OutputInterface> interfaces{};  ///< one per cohesive surface
  /// Traction on each face along its normal, sigma n [Pa]; zero on the front and back of a plate, which carry none.
  FaceField<Vector> traction;
  Vector plane_stress_normal = Vector::Zero();  ///< of a plate in plane stress; else zero
};

}  // namespace pfdm
