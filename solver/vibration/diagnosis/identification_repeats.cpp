#include "solver/vibration/diagnosis/identification_repeats.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace pfdm {
namespace {

RecordEstimates estimates_of(const VibrationRecord& record, const ScheduledRun& schedule, const MassMaterial& model,
                             const IdentificationSettings& settings) {
  OutputErrorFit fit = refine_output(std::span(&record, 1), model, settings);
  if (fit.record_misfit.empty())
    throw ComputationError(
        fmt::format("test {}: no bounded motion was found when this record was fitted on its own", record.name));
  return {.name = record.name,
          .schedule = schedule,
          .estimates = std::move(fit.estimates),
          .misfit = fit.record_misfit.front(),
          .converged = fit.converged};
}

double expected_deviation(const std::vector<RecordEstimates>& records, std::size_t parameter) {
  double sum = 0.0;
  for (const RecordEstimates& r : records) {
    const double error = r.estimates[parameter].standard_error;
    sum += error * error / static_cast<double>(records.size());
  }
  return std::sqrt(sum);
}

}  // namespace

RepeatedIdentification identify_each(std::span<const VibrationRecord> records, std::span<const ScheduledRun> schedule,
                                     const MassMaterial& model, const IdentificationSettings& settings) {
  assert(records.size() == schedule.size() && !records.empty());
  RepeatedIdentification result;
  for (std::size_t i = 0; i < records.size(); ++i)
    result.records.push_back(estimates_of(records[i], schedule[i], model, settings));
  for (std::size_t k = 0; k < result.records.front().estimates.size(); ++k) {
    std::vector<double> values;
    for (const RecordEstimates& r : result.records) values.push_back(r.estimates[k].value);
    result.parameters.push_back({.name = result.records.front().estimates[k].name,
                                 .statistics = repeatability(schedule, values),
                                 .expected_deviation = expected_deviation(result.records, k)});
  }
  return result;
}

}  // namespace pfdm
