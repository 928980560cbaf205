#pragma once
// What a comparison with experiments found, as files:
//
//   comparison.json            figures of merit
//   comparison.csv             both force-displacement curves over their common range
//   comparison_debonding.csv   likewise the debonding angles, where they were measured
//   comparison_energies.csv    likewise energies, those of one kind after the other

#include "postproc/curves/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

struct ForceComparison {
  ComparedCurves curves;
  CurveFigures model;
  CurveFigures mean;                                    ///< of the specimens' mean curve
  std::vector<std::string> names;                       ///< of the specimens
  std::vector<CurveFigures> specimens;                  ///< one for each
  double stiffness_from = 0.0, stiffness_to = 0.0;      ///< [m]
  std::vector<std::vector<std::string>> preparation{};  ///< what was done to each measured curve; empty: nothing
};

/// Throws InputError like compare_curves, and for a range of the stiffness beyond the common one.
ForceComparison compare_forces(const SampledCurve& model, const std::vector<SampledCurve>& specimens,
                               double stiffness_from, double stiffness_to);

/// Of the debonding angle [rad] over the displacement [m].
struct AngleComparison {
  ComparedCurves curves;
  std::vector<std::string> names;
  std::optional<double> model_onset, mean_onset;  ///< displacement where the angle first exceeds one degree [m]
};

AngleComparison compare_angles(const SampledCurve& model, const std::vector<SampledCurve>& specimens);

/// Of an energy of the run [J] over the displacement [m].
struct EnergyComparison {
  std::string kind;
  ComparedCurves curves;
  std::vector<std::string> names;
};

/// Throws InputError like compare_curves.
EnergyComparison compare_energies(const std::string& kind, const SampledCurve& model,
                                  const std::vector<SampledCurve>& specimens);

struct ComparisonReport {
  std::string case_name;
  std::string case_hash;
  std::string version;
  ForceComparison force;
  std::optional<AngleComparison> angle;
  std::vector<EnergyComparison> energies{};
};

inline constexpr const char* comparison_files[] = {"comparison.json", "comparison.csv", "comparison_debonding.csv",
                                                   "comparison_energies.csv"};

/// Each written whole or not at all. Throws ComputationError.
void write_comparison(const std::filesystem::path& results, const ComparisonReport& report);

}  // namespace pfdm
