#pragma once
// What is wrong with a vibration record before anything is computed from it. Each fault has a name.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct RecordFault {
  std::string name;     ///< one of the names below
  std::string message;  ///< what was found and where
  bool refused = true;  ///< false: the record can be used, with a warning
};

/// A record as it came from a file.
struct RawRecord {
  std::optional<Eigen::VectorXd> time;  ///< [s]
  Eigen::VectorXd base;                 ///< [m/s^2]
  Eigen::VectorXd relative;             ///< [m/s^2]
  std::optional<double> rate;           ///< what the user says it is [Hz]
  double band_low = 0.0;                ///< what the test excites [Hz]
  double band_high = 0.0;               ///< [Hz]
};

/// Refused: "unequal_lengths", "not_finite", "time_runs_backwards", "gap", "uneven_sampling", "wrong_rate",
/// "no_rate", "too_short", "sampled_too_slowly", "dead_channel". Warned of: "clipped", "quantised", "dropouts",
/// "drift", "spikes", "outside_the_band", "rate_or_band", and told of: "base_at_rest". The first that stops all further
/// ones ends the list.
std::vector<RecordFault> check_record(const RawRecord& record);

/// Samples per second: by the times, or as stated [Hz]. For records without refused faults.
double sampling_rate(const RawRecord& record);

}  // namespace pfdm
