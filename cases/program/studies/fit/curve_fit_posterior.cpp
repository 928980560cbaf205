// The posterior of a fit of a curve: samples of the parameters, and what they make of the laws of interfaces.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/calibration/posterior.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr const char* samples_file = "fit_posterior.csv";
constexpr const char* discrepancy_file = "fit_discrepancy.csv";
constexpr double noticeable_error = 0.3;  // of the logarithm of the posterior
constexpr double least_effective = 400.0;

double mean_widening(const FitFindings& found) {
  double sum = 0.0;
  for (const FittedParameter& p : found.parameters) sum += p.widened_by;
  return sum / static_cast<double>(found.parameters.size());
}

CsvTable table_of(const Posterior& posterior, const std::vector<FittedParameter>& parameters, const std::string& name) {
  CsvTable table;
  table.comments.push_back(fmt::format("posterior of the fit of {}: {} samples, as good as {:.0f} independent ones",
                                       name, posterior.samples.size(), posterior.effective));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    table.comments.push_back(fmt::format("{} [{}]", parameters[k].name, parameters[k].unit));
    table.add(parameters[k].name, posterior.of_parameter(k));
  }
  return table;
}

void warn_of(const Posterior& sampled, std::vector<std::string>& warnings) {
  if (!std::isfinite(sampled.emulator_error))
    warnings.emplace_back(
        "the posterior rests on polynomials of which too few points are near the estimates to tell how good they are");
  else if (sampled.emulator_error > noticeable_error)
    warnings.push_back(
        fmt::format("the posterior rests on polynomials that miss its logarithm by {:.2g}: the curve is rough, or "
                    "jumps, within the "
                    "intervals; what they miss counts as noise",
                    sampled.emulator_error));
  if (sampled.failures > 0)
    warnings.push_back(
        fmt::format("the model does not converge at {} of the {} points on which the posterior rests; "
                    "there it is extrapolated from the others",
                    sampled.failures, sampled.evaluations));
  if (sampled.is_cut)
    warnings.emplace_back("the posterior goes on beyond the points at which the model was run: its ends are too near");
  if (sampled.effective < least_effective)
    warnings.push_back(
        fmt::format("the samples of the posterior are as good as {:.0f} independent ones, too few for its "
                    "ends",
                    sampled.effective));
}

/// Displacements as they were recorded. A discrepancy is hardly larger than twice what the best fit leaves, or than
/// twice the noise where that is more.
ResidualPlaces places_of(const MeasuredPoints& points, double rms) {
  ResidualPlaces places;
  double scale = 0.0;
  for (const MeasuredPoints::Point& point : points.points) {
    places.at.push_back(point.x);
    places.scale.push_back(points.scale(point));
    scale += places.scale.back() / static_cast<double>(points.points.size());
  }
  places.largest = 2.0 * scale * std::max(rms, points.noise_is_known ? 1.0 : 1e-12);
  return places;
}

CsvTable table_of(const ModelDiscrepancy& discrepancy, const std::string& name) {
  CsvTable table;
  table.comments.push_back(fmt::format(
      "discrepancy of the model in the posterior of the fit of {}: force that it lacks (measured less computed), "
      "median and 95 %",
      name));
  table.add("displacement_m", discrepancy.at);
  table.add("median_force_N", discrepancy.median);
  table.add("lower_force_N", discrepancy.lower);
  table.add("upper_force_N", discrepancy.upper);
  return table;
}

/// Of law number `law`: that of the estimates, and quantiles of those drawn.
CsvTable table_of_law(const LawOfCase& fitted, const std::vector<std::vector<LawOfCase>>& drawn, std::size_t law) {
  constexpr std::size_t n_separations = 200;
  constexpr double beyond_end = 1.15;
  CsvTable table;
  table.comments.push_back(
      fmt::format("law of \"{}\" in opening: of the estimates, and quantiles over {} samples of the "
                  "posterior at each separation",
                  fitted.name, drawn.size()));
  std::vector<double> x, estimate, lower, median, upper;
  for (std::size_t i = 0; i <= n_separations; ++i) {
    x.push_back(beyond_end * fitted.end * std::pow(double(i) / double(n_separations), 2.0));
    estimate.push_back(fitted.traction(x.back()));
    std::vector<double> values;
    values.reserve(drawn.size());
    for (const std::vector<LawOfCase>& laws : drawn) values.push_back(laws[law].traction(x.back()));
    const SampledInterval interval = interval_of(values);
    lower.push_back(interval.lower);
    median.push_back(interval.median);
    upper.push_back(interval.upper);
  }
  table.add("separation_m", std::move(x));
  table.add("traction_Pa", std::move(estimate));
  table.add("median_traction_Pa", std::move(median));
  table.add("lower_traction_Pa", std::move(lower));
  table.add("upper_traction_Pa", std::move(upper));
  return table;
}

}  // namespace

void CurveFit::add_posterior(const DoneStage& done, FitFindings& found) {
  PosteriorSettings how{.widening = mean_widening(found), .running = [this](int points) {
                          session_.log.say(fmt::format("  posterior: {} points about the estimates", points));
                        }};
  if (job_.settings.intervals == Intervals::discrepancy) how.places = places_of(done.points, done.result.rms);
  const Posterior sampled = posterior(done.problem, done.result, how);
  for (std::size_t k = 0; k < found.parameters.size(); ++k) {
    SampledInterval interval = interval_of(sampled.of_parameter(k));
    hold_move(found.parameters[k], interval.lower, interval.upper);
    found.parameters[k].posterior = interval;
  }
  tables_[samples_file] = table_of(sampled, found.parameters, job_.name);
  found.posterior = PosteriorFindings{.file = samples_file,
                                      .emulator_error = sampled.emulator_error,
                                      .effective = sampled.effective,
                                      .evaluations = sampled.evaluations,
                                      .law_files = add_law_bands(done.stage, sampled.samples, found.warnings)};
  if (const auto& discrepancy = sampled.discrepancy) {
    tables_[discrepancy_file] = table_of(*discrepancy, job_.name);
    found.posterior->discrepancy = {
        .file = discrepancy_file, .amplitude = discrepancy->amplitude, .length = discrepancy->length};
  }
  warn_of(sampled, found.warnings);
}

std::vector<std::string> CurveFit::add_law_bands(const CurveFitStage& stage,
                                                 const std::vector<std::vector<double>>& samples,
                                                 std::vector<std::string>& warnings) {
  constexpr std::size_t n_laws = 1000;
  if (!job_.laws) return {};
  const std::vector<LawOfCase> fitted = job_.laws(with_values(job_.file, parameters_, values_));
  if (fitted.empty()) return {};
  std::vector<std::vector<LawOfCase>> drawn;
  const std::size_t n = std::min(n_laws, samples.size());
  for (std::size_t i = 0; i < n; ++i) try {
      drawn.push_back(
          job_.laws(with_values(job_.file, parameters_, with_stage(stage, samples[i * samples.size() / n]))));
    } catch (const InputError&) {  // values that a run refuses
    }
  if (drawn.size() < n)
    warnings.push_back(fmt::format("the band of the law leaves out {} of {} samples, whose values a run refuses",
                                   n - drawn.size(), n));
  if (drawn.empty()) return {};
  std::vector<std::string> files;
  for (std::size_t law = 0; law < fitted.size(); ++law) {
    files.push_back(fmt::format("fit_law_{}.csv", law));
    tables_[files.back()] = table_of_law(fitted[law], drawn, law);
  }
  return files;
}

}  // namespace pfdm
