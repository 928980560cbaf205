#pragma once
// The cohesive laws of a run as files:
//
//   cohesive_law.csv         the averaged laws, a row for each load step of each law; none for surfaces never damaged
//   cohesive_law_places.csv  those of every place that was damaged
//   cohesive.json            figures and fitted analytic laws of the averaged ones; of cohesive interfaces the law that
//                            is given, and figures of the means over its faces, which are no law
//   debonding.csv            debonded area and angles against the load, a row for each load step of each surface

#include "postproc/cohesive/cohesive_fit.h"
#include "postproc/cohesive/cohesive_law.h"
#include "postproc/curves/curve_csv.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// An averaged law with what was made of it.
struct CohesiveResult {
  CohesiveLaw law;
  CohesiveFigures figures;
  std::vector<CohesiveFit> fits;  ///< the best first; of traced laws only, and not of those that are given
};

/// All of a surface's averaged laws; none if it was never damaged.
std::vector<CohesiveResult> evaluate(const ColumnRecord& record);

/// The law of a cohesive interface, as its case gives it; figures that vary from place to place are left out.
struct GivenFigures {
  std::string law, mixed_mode;
  std::optional<double> strength{}, toughness{};              ///< in opening [Pa], [J/m^2]
  std::optional<double> shear_strength{}, shear_toughness{};  ///< likewise in shear
};

struct CohesiveReport {
  std::string case_name;
  std::string case_hash;
  std::string version;
  std::vector<ColumnRecord> records;
  std::vector<std::vector<CohesiveResult>> results;  ///< one list for each record
  std::vector<CurveRow> curve;                       ///< of the run
  int component = 2;                                 ///< of the curve's force
  /// Of each record the strength in shear that its band has over that in opening, where it is known; empty: of none.
  std::vector<std::optional<double>> shear_ratios{};
  /// Of each record the law that is given, if there is one; empty: of none.
  std::vector<std::optional<GivenFigures>> given{};
};

inline constexpr const char* cohesive_files[] = {"cohesive_law.csv", "cohesive_law_places.csv", "cohesive.json",
                                                 "debonding.csv"};

/// Each written whole or not at all. Throws InputError if the curve has not the steps of the records, ComputationError
/// if a file cannot be written.
void write_cohesive_results(const std::filesystem::path& results, const CohesiveReport& report);

}  // namespace pfdm
