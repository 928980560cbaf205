#pragma once
// Reads [cohesive]: across which surfaces the traction-separation law of a fracture run is recorded.

#include "cases/program/fracture/body/materials.h"
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
  std::vector<std::string> faces;  ///< names of [[interface]]s whose faces are recorded
  Vector axis = Vector::UnitZ();   ///< of the load
};

/// All bands between two different regions and all cohesive interfaces, unless [cohesive] names some. `root` is the
/// whole case file, `interfaces` the names of its [[interface]]s, `axis` the direction of the curve's displacement.
/// Throws InputError.
CohesiveSettings read_cohesive(const ConfigTable& root, std::span<const Band> bands,
                               std::span<const std::string> interfaces, const Vector& axis);

/// `model` has the cohesive interfaces of the mesh. Throws InputError, with file and line, for a surface that the mesh
/// does not have.
std::vector<ColumnSet> column_sets(const CohesiveSettings& settings, const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
