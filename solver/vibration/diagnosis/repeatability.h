#pragma once
// Repeated measurements of a value over a schedule of tests: how much it scatters between tests that were alike, and
// how it moves with the level of the test, the age of the sample, and the run's number within its day.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// When and how hard a test was.
struct ScheduledRun {
  double level = 0.0;      ///< [m/s^2]; of random motion its rms
  double age = 0.0;        ///< of the sample [s]
  int run = 1;             ///< number within its day
  double density = 0.0;    ///< of random motion in its band [m^2/s^4/Hz]; 0: a sine
  bool fractured = false;  ///< the sample broke in this test
  double level_in_g0() const;
  double age_in_days() const;
  /// Tests of one whole day of age are of the same day.
  long day() const;
};

/// A slope with its interval; NaN bounds where no degree of freedom is left.
struct Effect {
  std::string name;  ///< "per_g0", "per_day", "per_run"
  double value = 0.0;
  double lower_95 = 0.0;
  double upper_95 = 0.0;
};

/// By ordinary least squares: value = mean + a (level - mean level) + b (age - mean age) + r (run - mean run) + error,
/// errors independent and alike. A slope on what did not vary is left out; intervals by Student's t.
struct Repeatability {
  double mean = 0.0;
  std::vector<Effect> effects;
  double residual_deviation = 0.0;  ///< of the values about the line
  int residual_freedom = 0;
  /// Of values at equal level and day about their mean, pooled; none: no two tests were alike.
  std::optional<double> repeat_deviation;
  int repeat_freedom = 0;
};

/// Names of the slopes that a schedule confounds; none: it separates all that it varies.
std::optional<std::string> confounded(std::span<const ScheduledRun> schedule);

/// Of a value of each test; as many as runs. The schedule must not be confounded, and have at least one more test than
/// unknowns for intervals.
Repeatability repeatability(std::span<const ScheduledRun> schedule, std::span<const double> values);

}  // namespace pfdm
