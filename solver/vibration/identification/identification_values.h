#pragma once
// What an identification is given beside the records, and values that it and its callers tell: estimates by name, with
// intervals; the range that records excite; what their motion reaches.

#include "physics/point/mass_material.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct IdentificationSettings {
  double mass = 1.0;                ///< known [kg]
  double reference_velocity = 1.0;  ///< V of the model [m/s]
  std::optional<int> kernel_order;  ///< none: by BIC
  int maximum_kernel_order = 4;
  double crop = 0.05;    ///< of each record, at either end
  int replicates = 500;  ///< of the bootstrap
  double confidence = 0.95;
  std::uint64_t seed = 1;                                                   ///< of the bootstrap
  std::function<void(const std::string&)> say = [](const std::string&) {};  ///< told what is being done
};

struct Estimate {
  std::string name;  ///< "k1_N_per_m", "alpha1_per_s" ...
  std::string unit;  ///< "N/m", "1/s" ...
  double value = 0.0;
  double lower = 0.0;  ///< of the interval
  double upper = 0.0;
  double standard_error = 0.0;
  double lower_bound = -std::numeric_limits<double>::infinity();  ///< of the search
  double upper_bound = std::numeric_limits<double>::infinity();
  bool at_bound = false;
};

/// The values that a user asks for, units in their names too; bounds equal to the value.
std::vector<Estimate> named_values(const MassMaterial& model);

struct OrderTrial {
  int kernel_order = 0;  ///< number of terms, a pair counting one
  double bic = 0.0;
  double misfit = 0.0;
  bool pair = false;  ///< one of the terms is a conjugate pair
};

/// What a record's motion reaches away from its ends; for what depends on the test's level.
struct PeakMotion {
  double displacement = 0.0;  ///< [m]
  double velocity = 0.0;      ///< [m/s]
};
PeakMotion peak_motion(const VibrationRecord& record);

/// What records excite together.
struct ExcitedRange {
  double low, high;     ///< [Hz]
  double velocity;      ///< the largest [m/s]
  double displacement;  ///< the largest [m]
};
ExcitedRange excited_range(std::span<const VibrationRecord> records);

/// Over the band that the records excite, at the largest velocity in them.
Passivity passivity_in_band(const MassMaterial& model, std::span<const VibrationRecord> records);

}  // namespace pfdm
