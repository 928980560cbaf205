#pragma once
// Reads [mesh]: which generator makes the mesh, with which settings.

#include "cases/program/input/config/config.h"
#include "mesh/band.h"
#include "mesh/mesh.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct MeshRecipe {
  std::function<Mesh()> make;        ///< throws InputError
  std::vector<std::string> regions;  ///< that the mesh may have; empty if only the mesh tells
  std::vector<std::string> patches;  ///< likewise
  std::vector<std::filesystem::path> data_files;
  std::vector<Band> bands{};    ///< those that the generator makes
  std::optional<double> ell{};  ///< if the mesh depends on it [m]
};

/// What [mesh] is read with.
struct MeshSurroundings {
  std::filesystem::path case_directory;  ///< where relative paths start
  std::optional<double> ell;             ///< of [fracture] [m], for sizes that are multiples of it
};

/// A way to make meshes; to add one, write `read` and a row of the table at the foot of mesh_recipe.cpp.
struct MeshGenerator {
  std::string_view name;
  std::string_view description;
  MeshRecipe (*read)(const ConfigTable& settings, const MeshSurroundings& around);  ///< `settings`: the table [mesh]
};
std::span<const MeshGenerator> mesh_generators();

/// What [mesh] cells makes of the generator's mesh.
struct CellKind {
  std::string_view name;
  std::string_view description;
  Mesh (*turn_into)(Mesh mesh);  ///< throws InputError for cells that cannot be turned
};
std::span<const CellKind> cell_kinds();

/// Errors of the recipe's `make` name [mesh].
MeshRecipe read_mesh_recipe(const ConfigTable& settings, const MeshSurroundings& around);

}  // namespace pfdm
