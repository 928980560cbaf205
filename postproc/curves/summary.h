#pragma once
// summary.json: what ran, what it cost, and the figures that one asks for first.

#include "postproc/curves/curve_csv.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {

/// Figures of a force-displacement curve; NaN where the curve has none.
struct Headlines {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double peak_force = none;            ///< largest in magnitude, of the force along the displacement [N]
  double displacement_at_peak = none;  ///< [m]
  double load_at_peak = none;          ///< load parameter [-]
  /// The peak lies between the largest force and this one [N]: what the slope before it reaches in the step after it,
  /// if that step lost a tenth of the force or more; else the same.
  double peak_force_at_most = none;
  double initial_stiffness =
      none;                   ///< slope of the first step that displaces, or of the next where others came before [N/m]
  double final_force = none;  ///< [N]
  double final_displacement = none;                    ///< [m]
  double final_load = none;                            ///< load parameter [-]
  EnergyAccount energy{none, none, none, none, none};  ///< at the end [J]
  double max_damage = none;                            ///< at the end [-]
  double damaged_volume = none;                        ///< at the end [m^3]
  double energy_balance_error = none;                  ///< |W - E_elastic - E_fracture - D| / W at the end [-]
  double released_energy = none;           ///< the most that one step's work leaves over, as an unstable jump does [J]
  double displacement_at_release = none;   ///< at the end of that step [m]
  double max_energy_balance_error = none;  ///< the largest over all rows with W > 0 [-]
};

/// `component` 0, 1, 2: the direction of the displacement in the rows.
Headlines headlines(std::span<const CurveRow> rows, int component);

struct RunSummary {
  std::string case_name;
  std::string status;  ///< "complete", or why it ended before
  std::string version;
  std::string case_hash;
  int threads = 0;
  Index cells = 0;
  Index unknowns = 0;
  Index steps = 0;
  Index staggered_iterations = 0;
  Index krylov_iterations = 0;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
  std::map<std::string, double> wall_seconds_by_stage;
  std::map<std::string, double> cpu_seconds_by_stage;
  double peak_memory = 0.0;                     ///< [byte]
  std::optional<Headlines> figures;             ///< of kinds that have a force-displacement curve
  std::map<std::string, double> other_figures;  ///< a case's own, with the unit in the name
  std::map<std::string, std::int64_t> other_counts;
  std::map<std::string, std::string> other_texts;
  double other_figure(const std::string& name) const;  ///< NaN if there is none of this name
};

/// Written whole or not at all; numbers that are not finite become null. Throws ComputationError if the file cannot be
/// written.
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

inline constexpr const char* summary_file = "summary.json";

/// What a summary.json says.
struct ReadSummary {
  std::string status;
  std::string case_hash;
  std::string processor;                                ///< that computed; empty: not told
  std::vector<std::pair<std::string, double>> numbers;  ///< in their order, by name; NaN where it has null
  double number(std::string_view name) const;           ///< NaN if it has none of this name
};

/// Nothing if there is no such file. Throws InputError for a file that is no summary.
std::optional<ReadSummary> read_summary(const std::filesystem::path& path);

/// What write_summary() wrote; all figures are in other_figures, other_counts and other_texts. Throws InputError that
/// names the file for what is no summary.
RunSummary read_run_summary(const std::filesystem::path& path);

/// Model of this machine's processor, "AMD EPYC"; empty where the system does not tell.
std::string processor_name();
/// The most memory that this process has had so far [byte].
double peak_memory();
/// Processor time of all threads of this process so far [s].
double cpu_seconds();

}  // namespace pfdm
