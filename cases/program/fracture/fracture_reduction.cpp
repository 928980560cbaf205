#include "cases/program/fracture/fracture_reduction.h"

#include "physics/error.h"
#include "postproc/files/folder_lock.h"
#include "postproc/fits/fit_json.h"
#include "postproc/reduction/reduction_results.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

/// Toughnesses that a fit of this case estimated; none without one.
std::vector<ReductionReport::Fitted> fitted_toughnesses(const std::filesystem::path& results) {
  std::vector<ReductionReport::Fitted> found;
  const std::filesystem::path file = results / "fit.json";
  if (!std::filesystem::exists(file)) return found;
  const FitReport fit = read_fit_json(file);
  for (const FittedParameter& p : fit.found.parameters)
    if (p.unit == "J/m^2")
      found.push_back({.name = p.name,
                       .verdict = std::string(name_of(fit.found.verdict)),
                       .estimate = p.estimate,
                       .lower = p.lower,
                       .upper = p.upper});
  return found;
}

std::string words_of(const ReductionReport::Fitted& fitted) {
  const std::string interval =
      std::isfinite(fitted.lower) ? fmt::format(", 95 % interval {:.4g} to {:.4g}", fitted.lower, fitted.upper) : "";
  return fmt::format("  fit of {}: {:.4g} J/m^2{} ({})", fitted.name, fitted.estimate, interval, fitted.verdict);
}

}  // namespace

bool can_be_reduced(const FractureProgram& program, Log& log) {
  if (!program.reduction) return false;
  try {
    reduced_tests(*program.reduction);
    return true;
  } catch (const InputError& error) {
    log.warn(fmt::format("{}; pfdm reduce needs that, runs and fits do not", error.what()));
    return false;
  }
}

void reduce_tests(const FractureProgram& program, Session& session) {
  const std::vector<ReducedTest> tests = reduced_tests(*program.reduction);
  ReductionReport report{.case_name = program.name,
                         .case_hash = program.hash,
                         .version = session.version,
                         .tests = tests,
                         .fitted = fitted_toughnesses(session.results)};
  const FolderLock lock(session.results);
  write_reduction(session.results, report);
  for (const ReducedTest& test : tests)
    for (const std::string& line : reduction_text(test)) session.log.say(line);
  for (const ReductionReport::Fitted& fitted : report.fitted) session.log.say(words_of(fitted));
  session.log.say(fmt::format("written to {}", (session.results / reduction_file).string()));
}

}  // namespace pfdm
