#pragma once
// Reads [cohesive]: across which surfaces the traction-separation law of a fracture run is recorded.

#include "cases/program/fracture/materials.h"
#include "postproc/cohesive/columns.h"

#include <optional>
#include <vector>

namespace pfdm {

/// A cut through the body.
struct CohesivePlane {
  std::string name;
  Vector point = Vector::Zero();   ///< [m]
  Vector normal = Vector::Zero();  ///< any length
  double half_width = 0.0;         ///< of the columns through it [m]
  ConfigTable where;               ///< for messages
};

struct CohesiveSettings {
  std::vector<Band> bands;  ///< whose particles' surfaces are sampled
  std::vector<CohesivePlane> planes;
  Vector axis = Vector::UnitZ();  ///< of the load
};

/// All bands between two different regions, unless [cohesive] names some. `root` is the whole case file, `axis` the
/// direction of the curve's displacement. Throws InputError.
CohesiveSettings read_cohesive(const ConfigTable& root, std::span<const Band> bands, const Vector& axis);

/// Throws InputError, with file and line, for a surface that the mesh does not have.
std::vector<ColumnSet> column_sets(const CohesiveSettings& settings, const Mesh& mesh);

}  // namespace pfdm
