#pragma once
// Reads a case of kind "homogenize": mesh, materials, how the box is loaded.

#include "cases/program/fracture/body/materials.h"
#include "cases/program/fracture/body/mesh/mesh_recipe.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/input/case_files/case_file.h"
#include "physics/elasticity/effective_stiffness.h"
#include "solver/homogenization/homogenization.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// What a material has besides its elasticity.
struct CompositeMaterial {
  std::string name;
  std::vector<std::string> regions;
  std::optional<double> density;  ///< [kg/m^3]
  double loss_factor = 0.0;       ///< dissipated energy of a cycle over 2 pi times the largest stored one [-]
};

struct HomogenizationCase {
  std::string title;
  MeshRecipe mesh;
  Materials materials;
  std::vector<CompositeMaterial> by_name;
  HomogenizationSettings settings;
};

/// Keys of strains that make no stress, and of temperatures. Throws InputError that names the first.
void refuse_free_strains(const ConfigTable& root);

/// `root` is the whole case file. Throws InputError for all that can be told without the mesh.
HomogenizationCase read_homogenization_case(const ConfigTable& root, const std::filesystem::path& case_directory,
                                            MeshOf mesh = MeshOf::the_case);

/// One with all that its file says. Throws InputError for whatever is wrong with it, unknown keys included.
HomogenizationCase read_whole_homogenization_case(const CaseFile& file, MeshOf mesh);

/// The elasticity on the mesh. Throws InputError, with file and line, for a region without a material, one that the
/// mesh does not have, and parameters that are out of range in a cell.
LinearComposite composite_on(const HomogenizationCase& homogenization, const Mesh& mesh);

/// On a nearly incompressible material beside one whose elasticity depends on the direction: no cell has a pressure
/// then.
std::optional<std::string> warning_of_volume(const LinearComposite& composite, const Mesh& mesh);

/// The materials with their fractions of the box; nothing where an elasticity varies from place to place, or where
/// there are voids.
std::vector<Phase> phases_of(const HomogenizationCase& homogenization, const Mesh& mesh, const Homogenized& result);

}  // namespace pfdm
