#pragma once
// Energy release rates and stress intensities of a run, step by step.

#include "postproc/fields/energy_release_rate.h"
#include "postproc/files/step_table.h"
#include "solver/fracture/model/state.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* energy_release_file = "energy_release_rate.csv";

/// Names of the columns of energy_release_file.
std::vector<std::string> energy_release_columns(const std::vector<TipRegion>& regions);

class EnergyReleaseTable {
 public:
  /// Continues the file after a step, or starts it. Keeps a reference to the regions.
  EnergyReleaseTable(const std::filesystem::path& folder, const std::vector<TipRegion>& regions,
                     std::optional<Index> last_step);

  /// Appends a row; returns what is to be said of its figures, once for each region, which `said_of` remembers.
  std::vector<std::string> add(const Mesh& mesh, const FractureModel& model, const FractureState& state,
                               const OutputFields& output, std::vector<bool>& said_of);
  /// Of the last row, for the summary.
  std::map<std::string, double> figures() const;

 private:
  const std::vector<TipRegion>& regions_;
  StepTable table_;
};

}  // namespace pfdm
