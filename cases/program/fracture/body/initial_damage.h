#pragma once
// Reads [initial]: damage and cracks that are there before the first step.

#include "cases/program/input/fields/amount.h"
#include "mesh/search/flat_surface.h"
#include "solver/fracture/model/fracture_model.h"

#include <optional>
#include <vector>

namespace pfdm {

struct InitialCrack {
  FlatSurface surface;
  ConfigTable where;  ///< in the file, for messages
};

struct InitialDamage {
  std::optional<Parameter> damage;
  std::vector<InitialCrack> cracks;
  std::vector<ConfigValue> regions;  ///< where; empty: in all that can be damaged
};

/// `root` is the whole case file; nothing if it has no [initial].
std::optional<InitialDamage> read_initial_damage(const ConfigTable& root, const FractureModel& model);

/// The larger of both in each cell, 1 in the cells of cracks; 0 where nothing can be damaged. Throws InputError, with
/// file and line, for a region that is not there or cannot be damaged, and for a crack that goes through no cell.
CellField<double> damage_at_the_start(const InitialDamage& initial, const FractureModel& model, const Mesh& mesh);

}  // namespace pfdm
