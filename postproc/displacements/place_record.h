#pragma once
// The displacements at places of a run, step by step, in a file of its results.

#include "physics/tensor.h"
#include "postproc/files/step_table.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace pfdm {

/// displacements_at_places.csv: the step, and three components for each place [m].
class PlaceRecord {
 public:
  /// As StepTable: starts a file in this folder, or goes on after `last_step`.
  PlaceRecord(const std::filesystem::path& folder, std::size_t n_places, std::optional<Index> last_step);
  void append(Index step, const std::vector<Vector>& displacements, bool now);
  void write() { table_.write(); }

 private:
  StepTable table_;
};

/// Its rows without the number of the step. Throws InputError for what is no such file.
std::vector<std::vector<double>> read_place_record(const std::filesystem::path& folder);

}  // namespace pfdm
