#pragma once
// summary.json and fit.json of the mass-material model. SI units, units in the names. Files are written whole or not at
// all; numbers that are not finite become null.

#include "solver/vibration/identification_repeats.h"
#include "solver/vibration/ogden_fit.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pfdm {

struct NamedFigures {
  std::string name;                       ///< of a test
  std::map<std::string, double> figures;  ///< with the unit in the name
  std::map<std::string, std::int64_t> counts{};
};

struct VibrationSummary {
  std::string case_name;
  std::string status;
  std::string version;
  std::string case_hash;
  int threads = 0;
  double wall_seconds = 0.0;
  std::map<std::string, double> figures;  ///< of the whole case
  std::vector<NamedFigures> tests;
};
void write_vibration_summary(const std::filesystem::path& path, const VibrationSummary& summary);

/// The names of the tests whose results a summary tells of; none if the file is no such summary.
std::vector<std::string> tests_of_vibration_summary(const std::filesystem::path& path);

/// Young's modulus of the sample at a frequency: K L/A.
struct ModulusRow {
  double frequency = 0.0;  ///< [Hz]
  double storage = 0.0;    ///< E' [Pa]
  double loss = 0.0;       ///< E'' [Pa]
};

struct VibrationFit {
  std::string case_name;
  std::string version;
  std::string case_hash;
  std::string method;
  std::string structure;
  double confidence = 0.95;
  double wall_seconds = 0.0;
  std::vector<Estimate> estimates;  ///< lower = upper = NaN where the method gives no intervals
  Eigen::MatrixXd correlation;
  std::vector<double> path;
  std::vector<OrderTrial> orders;
  bool converged = true;
  Passivity passivity;
  std::vector<NamedFigures> tests;
  std::vector<ModulusRow> modulus;
  std::optional<OgdenFit> ogden;  ///< of the stiffness polynomial
  std::optional<RepeatedIdentification> repeats;
};
void write_vibration_fit(const std::filesystem::path& path, const VibrationFit& fit);

/// What write_vibration_fit() wrote: method, structure, estimates, tests, modulus and Ogden's model. Throws InputError
/// that names the file for what is no such fit.
VibrationFit read_vibration_fit(const std::filesystem::path& path);

}  // namespace pfdm
