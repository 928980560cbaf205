#pragma once
// The effective linear stiffness of a composite that fills a box: six load cases, and the averages of stress and strain
// over the box, which follow from the tractions and displacements of its surface,
//
//   C = <sigma> <eps>^-1
//
// as matrices whose columns are the load cases (solver/momentum/body/box_means.h). Voids inside the box count as
// material without stiffness.
//
// The order of the energies of one body: uniform traction <= periodic <= uniform displacement (Suquet, Lecture Notes in
// Physics 272 (1987) 193; Hazanov, Huet, J. Mech. Phys. Solids 42 (1994) 1995).

#include "mesh/mesh.h"
#include "physics/elasticity/mandel.h"
#include "solver/momentum/body/unknowns.h"
#include "solver/momentum/solution/preconditioner.h"

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

/// How the box is loaded; to add one, write its `set` and a row of the table at the foot of homogenization.cpp.
struct Loading {
  std::string_view name, description;
  bool by_traction;      ///< of the sides; else by the displacements
  bool repeats = false;  ///< opposite sides move alike, apart from the mean strain
};
/// The first one is the default.
std::span<const Loading> homogenization_loadings();
/// Throws InputError for an unknown name.
const Loading& homogenization_loading(std::string_view name);

struct LinearComposite {
  std::vector<IsotropicElasticity> elasticity;  ///< of each region of the mesh
  std::vector<Index> zone;                      ///< as in ElasticBody
  CellField<IsotropicElasticity> cells{};       ///< where it varies from cell to cell; else empty
  /// As of ElasticBody: where it depends on the direction; those above are then the closest isotropic ones.
  DirectedStiffness stiffness{};
};

struct HomogenizationSettings {
  const Loading* loading = nullptr;      ///< null: the first
  double tolerance = 1e-8;               ///< row-scaled residual of the momentum balance, relative
  const LinearSolver* linear = nullptr;  ///< null: the automatic choice
};

/// Of one of the six: unit strain, or unit stress, in one Mandel component.
struct LoadCase {
  Mandel stress = Mandel::Zero();               ///< mean [Pa]
  Mandel strain = Mandel::Zero();               ///< mean
  Mandel constitutive_stress = Mandel::Zero();  ///< mean of C : eps with the mean strain of each cell [Pa]
  Index iterations = 0;
  double residual = 0.0;
};

/// What the cells do in a load case.
struct LoadCaseFields {
  CellField<Vector> displacement;  ///< [m]
  CellField<Tensor> gradient;      ///< of the displacement, du_i/dx_j
  CellField<Tensor> strain;
  CellField<Tensor> stress;  ///< [Pa]
};

struct Homogenized {
  MandelMatrix stiffness;               ///< symmetric part of <sigma> <eps>^-1 [Pa]
  double asymmetry = 0.0;               ///< |C - C^T| / |C| before
  std::vector<MandelMatrix> of_region;  ///< by region: what it adds to the stiffness that the energies tell [Pa]
  std::vector<double> fraction;         ///< by region: of the box's volume
  double volume = 0.0;                  ///< of the box [m^3]
  Index n_unknowns = 0;
  std::array<LoadCase, 6> cases;

  MandelMatrix energy_stiffness() const;  ///< sum of the regions': E : C : E = 2 <psi> [Pa]
  /// Hill and Mandel: |C by the energies - C by the mean stresses| / |C|.
  double energy_difference() const;
  /// Largest of the load cases' |mean of C : eps - mean stress| / |mean stress|, a measure of the mesh's error.
  double constitutive_difference() const;
};

/// The unknowns of a load case; throws like homogenize() for what is wrong with the body.
Index homogenization_unknowns(const Mesh& mesh, const LinearComposite& composite,
                              const HomogenizationSettings& settings);

/// Throws InputError for a body that does not fill a box or whose sides do not match, ComputationError where a load
/// case does not converge. `solved` is called after each load case, with its number from 0; `fields`, if it is there,
/// gets the fields of each.
Homogenized homogenize(const Mesh& mesh, const LinearComposite& composite, const HomogenizationSettings& settings,
                       const std::function<void(std::size_t, const LoadCase&)>& solved = {},
                       const std::function<void(std::size_t, const LoadCase&, const LoadCaseFields&)>& fields = {});

}  // namespace pfdm
