#pragma once
// Reads [[boundary]]: what is prescribed on which patch.

#include "cases/program/fracture/body/materials.h"
#include "cases/program/input/config/config.h"
#include "solver/momentum/body/boundary_condition.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace pfdm {

struct BoundarySettings {
  BoundaryCondition condition;
  /// Components of the displacement that are reached linearly at t = 1 [m].
  std::array<std::optional<double>, 3> displacement_at_full_load;
  ConfigValue patch;  ///< the patch's name in the file
};

/// Of every patch that `root`, the whole case file, names; throws InputError for a patch that is named twice.
std::vector<BoundarySettings> read_boundary(const ConfigTable& root, const Materials& materials);

/// Whether any condition acts on a patch: the force on a free one is nothing but rounding.
bool acts_on(std::string_view patch, std::span<const BoundarySettings> boundary);

/// What `type` may be.
struct BoundaryType {
  std::string_view name;
  std::string_view description;
  BoundaryCondition::Kind kind;
};
std::span<const BoundaryType> boundary_types();

/// Closed-form displacement fields for displacement = { field = "name", ... }, reached linearly at t = 1.
struct DisplacementField {
  std::string_view name;
  std::string_view description;
  std::function<Vector(const Vector& x)> (*read)(const ConfigTable& settings, const Materials& materials);  ///< [m]
};
std::span<const DisplacementField> displacement_fields();

}  // namespace pfdm
