#pragma once
// Reads a case of kind "fracture": mesh, materials, boundary conditions, loading, output.

#include "cases/program/fracture/body/body_loads.h"
#include "cases/program/fracture/body/boundary_reader.h"
#include "cases/program/fracture/body/initial_damage.h"
#include "cases/program/fracture/body/interface_reader.h"
#include "cases/program/fracture/body/materials.h"
#include "cases/program/fracture/body/mesh/mesh_recipe.h"
#include "cases/program/fracture/case/cohesive_case.h"
#include "cases/program/fracture/case/energy_release_case.h"
#include "cases/program/fracture/case/frame_settings.h"
#include "cases/program/fracture/case/heat_case.h"
#include "cases/program/fracture/case/model_choice.h"
#include "postproc/displacements/displacement_field.h"
#include "solver/fracture/model/fracture_model.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Whose force and displacement make the curve.
struct CurveSettings {
  std::string patch;
  int component = 2;  ///< 0, 1, 2 for x, y, z
};

struct FractureOutput {
  CurveSettings curve;
  bool figures_only = false;  ///< no frames, and nothing on the disk for the first seconds
  Index frames_every = 0;     ///< steps; 0 = only LoadingSettings::stops and the last step
  FrameSettings frames;
  std::optional<Vector> slices_through;  ///< [m]
  std::vector<TipRegion> tips;           ///< around which the energy release rate is measured
  std::vector<FieldPlace> places{};      ///< whose displacements are recorded step by step
};

/// A box that is loaded by mean strains or stresses in place of boundary conditions; of kind "homogenize".
struct BoxCase {
  std::function<BoxMotion(const Mesh& mesh, const FractureModel& model)> motion;
  std::array<int, 2> component{2, 2};  ///< row and column of the mean strain and stress that make the curve
  std::string words;                   ///< how it is loaded
};

struct FractureCase {
  std::string title;
  MeshRecipe mesh;
  Materials materials;
  std::vector<BoundarySettings> boundary;
  std::optional<BoxCase> box;  ///< then there are none of these
  std::vector<InterfaceSettings> interfaces;
  FractureModel model;  ///< what depends on the mesh is filled in by model_on()
  Perturbation perturbation;
  std::optional<InitialDamage> initial_damage;
  std::optional<HeatModel> heat;  ///< that of `model`
  StaggeredSettings staggered;
  LoadingSettings loading;
  FractureOutput output;
  CohesiveSettings cohesive;
  std::vector<std::filesystem::path> data_files;  ///< besides those of the mesh
  std::optional<ConfigValue> curve_patch;         ///< in the file, for messages
  std::optional<ConfigTable> file;                ///< likewise
};

/// The displacement of the curve's patch along its component at load parameter 1 [m], where it is reached linearly and
/// is not zero.
std::optional<double> full_displacement(const FractureCase& fracture);

/// Whose mesh a case is to run on: what its [mesh] makes, or one that the caller has.
enum class MeshOf { the_case, the_caller };

/// `root` is the whole case file. Throws InputError for all that can be told without the mesh; names of regions and
/// patches are compared with those of [mesh] only where that is the mesh.
FractureCase read_fracture_case(const ConfigTable& root, const std::filesystem::path& case_directory,
                                MeshOf mesh = MeshOf::the_case);

/// What no boundary condition decides: mesh, materials, interfaces, loading, solver. With `may_be_elastic` [fracture]
/// may be left out: only interfaces break then, and materials have their elasticity alone.
FractureCase read_body(const ConfigTable& root, const std::filesystem::path& case_directory, bool may_be_elastic);

/// The parts of [output] that need no patch, and [cohesive]; with `box` and the loading as they are to be.
void read_box_output(const ConfigTable& root, FractureCase& fracture, MeshOf mesh);

/// The model with its materials and initial damage on the mesh. Throws InputError, with file and line, for patches and
/// regions that the mesh does not have, for regions without a material and for parameters that are out of range in a
/// cell.
FractureModel model_on(const FractureCase& fracture, const Mesh& mesh);

}  // namespace pfdm
