#pragma once
// analysis.json: how the records of a mass-material case were analysed, and how hard each test was. SI units, units in
// the names; accelerations also in multiples of gravity, as test reports state them.

#include "solver/vibration/diagnosis/record_analysis.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* analysis_file = "analysis.json";

/// How far a model's response to the record's base acceleration is from the recorded one.
struct ModelMisfit {
  std::string name;
  double relative = 0.0;
};

struct LargestResponse {
  double frequency = 0.0;  ///< [Hz]
  double response = 0.0;   ///< relative over base acceleration
};

struct AnalysedRecord {
  std::string name;
  std::string file;
  std::optional<std::string> date;  ///< of the test, "2016-09-14"; none: the case does not say
  std::string remark;               ///< of the file
  std::string motion;               ///< "sine", "random"
  double rate = 0.0;                ///< [Hz]
  double duration = 0.0;            ///< [s]
  std::int64_t samples = 0;
  double band_low = 0.0, band_high = 0.0;  ///< [Hz]
  TestLevel level;
  std::optional<double> sine_amplitude;  ///< of the base [m/s^2]
  LargestResponse resonance;
  std::int64_t segment = 0;  ///< samples
  double overlap = 0.0;
  std::int64_t segments = 0;
  double averages = 0.0;    ///< independent ones
  double resolution = 0.0;  ///< [Hz]
  std::vector<ModelMisfit> misfits;
};

struct AnalysisReport {
  std::string case_name;
  std::string case_hash;
  std::string version;
  std::string analysed;  ///< when, in UTC
  std::vector<AnalysedRecord> records;
};

/// Written whole or not at all; numbers that are not finite become null. Throws ComputationError.
void write_analysis_json(const std::filesystem::path& path, const AnalysisReport& report);

/// What the pages of the tests need of it. Throws InputError for what is no such file.
struct AnalysisStamp {
  std::string case_hash;
  std::string analysed;
};
AnalysisStamp read_analysis_stamp(const std::filesystem::path& path);

}  // namespace pfdm
