#pragma once
// What the columns of a run told, step by step, as text: results/columns/NAME/places.csv says where the columns of a
// set are, step_000012.csv has a row for each of them. Each file is written whole or not at all, so that a run that is
// killed and restarted leaves the record of an unbroken one.

#include "postproc/cohesive/columns.h"

#include <filesystem>
#include <optional>

namespace pfdm {

/// A column without its cells.
struct Place {
  Vector point = Vector::Zero();   ///< [m]
  Vector normal = Vector::Zero();  ///< unit length
  double polar_angle = 0.0;        ///< between the normal and the direction of the load [rad]
  double area = 0.0;               ///< [m^2]
  double length = 0.0;             ///< of the column [m]
};

/// The record of one set.
struct ColumnRecord {
  std::string name;
  SurfaceKind kind = SurfaceKind::interface;
  bool is_cohesive = false;  ///< the faces of a cohesive interface, whose law is given
  std::vector<Place> places;
  /// One for each load step from 0 on, each with an entry for each place.
  std::vector<std::vector<ColumnSample>> steps;

  double area() const;  ///< of the whole surface [m^2]
};

/// The writing side.
class ColumnFiles {
 public:
  /// Replaces the record of an earlier run in `folder`, or keeps of it the steps up to `last_step`. Keeps a reference
  /// to the sets. Throws ComputationError where a file cannot be written, as append() does.
  ColumnFiles(std::filesystem::path folder, const std::vector<ColumnSet>& sets, const Vector& axis,
              std::optional<Index> last_step);

  void append(Index step, const Mesh& mesh, const FractureModel& model, const OutputFields& output) const;

 private:
  std::filesystem::path folder_;
  const std::vector<ColumnSet>& sets_;
};

/// Removes the records of an earlier run from `folder`, of surfaces that are no longer sampled as well.
void remove_columns(const std::filesystem::path& folder);

/// The records of all sets in `folder`, by name; none if there is no such folder. With a `last_step`, only the steps up
/// to it. Throws InputError that names the file for what is not such a record, and for a record with a step missing.
std::vector<ColumnRecord> read_columns(const std::filesystem::path& folder, std::optional<Index> last_step = {});

}  // namespace pfdm
