#include "cases/program/fracture_cohesive.h"

#include "cases/program/fracture_results.h"
#include "physics/angle.h"
#include "postproc/cohesive_results.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

std::string outcome_of(const CohesiveResult& result) {
  const CohesiveFigures& f = result.figures;
  if (f.jump)
    return fmt::format(
        "falls at once at step {}: between there and {:.4g} m the law is not known; int T ddelta at least "
        "{:.4g} J/m^2",
        *f.jump, f.final_separation, f.energy_at_least);
  if (!f.is_traced())
    return fmt::format("carries {:.4g} Pa at the end; int T ddelta so far at least {:.4g} J/m^2", f.final_traction,
                       f.energy_at_least);
  const double work = f.normal_energy + f.tangential_energy;
  const std::string energy =
      std::isfinite(work)
          ? fmt::format("int T ddelta {:.6g} J/m^2", work)
          : fmt::format("int T ddelta at least {:.4g} J/m^2, as single places fall at once", f.energy_at_least);
  if (result.fits.empty()) return energy + ", too few states for a fit";
  return fmt::format("{}; nearest to \"{}\", rms {:.2g} % of the strength", energy, result.fits.front().law,
                     100.0 * result.fits.front().rms);
}

void say_law(const CohesiveResult& result, SurfaceKind kind, Log& log) {
  const CohesiveFigures& f = result.figures;
  const std::string where = kind == SurfaceKind::plane ? std::string("  mean")
                                                       : fmt::format("  {:3.0f} to {:3.0f} degrees",
                                                                     result.law.from / degree, result.law.to / degree);
  if (!(f.strength > 0.0)) return log.say(where + ": always pressed");
  log.say(fmt::format("{}: largest normal traction {:.4g} Pa at {:.4g} m, {}; surface energy {:.4g} J/m^2", where,
                      f.strength, f.critical_separation, outcome_of(result), f.surface_energy));
}

}  // namespace

void write_cohesive_laws(const FractureCase& fracture, const std::string& name, const std::string& hash,
                         Session& session) {
  CohesiveReport report{.case_name = name,
                        .case_hash = hash,
                        .version = session.version,
                        .records = read_column_record(session.results, hash),
                        .results = {},
                        .curve = read_curve_record(session.results, hash),
                        .component = fracture.output.curve.component};
  for (const ColumnRecord& record : report.records) report.results.push_back(evaluate(record));
  write_cohesive_results(session.results, report);
  for (std::size_t r = 0; r < report.records.size(); ++r) {
    const ColumnRecord& record = report.records[r];
    const Debonding debonded = debonding_of(record).back();
    session.log.say(fmt::format("cohesive law of \"{}\", {} places, debonded area {:.4g} m^2", record.name,
                                record.places.size(), debonded.area));
    for (const CohesiveResult& result : report.results[r]) say_law(result, record.kind, session.log);
  }
  session.log.say(fmt::format("written to {}", (session.results / "cohesive.json").string()));
}

}  // namespace pfdm
