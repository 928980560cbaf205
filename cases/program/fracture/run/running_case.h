#pragma once
// A fracture run under way: its steps, with results, progress and page, and the ways in which it ends.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/fracture/case/reduction_case.h"
#include "cases/program/fracture/outcome/fracture_results.h"
#include "cases/program/fracture/run/live_page.h"
#include "cases/program/session/terminal/followed_rows.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/fit/curve_fit.h"
#include "solver/fracture/fracture_run.h"
#include "solver/fracture/words/coarse_cells.h"

#include <map>
#include <optional>
#include <string>

namespace pfdm {

/// Where the wall-clock time of a run goes [s].
struct RunTimes {
  Stopwatch whole;
  double mesh = 0.0;
  double results = 0.0;
};
/// A fracture case, read.
struct FractureProgram {
  CaseFile file;
  FractureCase fracture{};
  std::optional<ExperimentSettings> experiment{};
  std::optional<ReductionSettings> reduction{};
  std::optional<CurveFitSettings> fit{};
  std::string name{};
  std::string hash{};
  std::string mesh_hash{};  ///< of what decides the mesh
};

/// A run that steps.
struct RunningCase {
  const FractureProgram& program;
  Session& session;
  RunTimes& times;
  const Mesh& mesh;
  FractureRun& run;
  FractureResults& results;
  CoarseCells coarse;
  FollowedRows followed;  ///< by a script
  FractureState state;    ///< the last one that was reached
  bool goes_on = false;   ///< from a state that is in the results already
  std::optional<LivePages> live{};
  std::map<std::string, double> own_figures{};  ///< of the long time after the cycles, and of laws
};

/// Steps until the end of the load, --max-steps, an interruption or failure, and says what happened. Throws
/// Interrupted, and ComputationError with what is worth keeping written.
void solve(RunningCase& running);

}  // namespace pfdm
