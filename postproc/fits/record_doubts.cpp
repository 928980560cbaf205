#include "postproc/fits/record_doubts.h"

#include "postproc/fits/fit_judgement.h"
#include "postproc/fits/stray_row.h"
#include "postproc/fits/uneven_scatter.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

bool is_rounding(const FitResult& result, double negligible) {
  return !result.noise_is_known && result.rms < negligible;
}

std::vector<double> sizes_of(const std::vector<FittedRecord>& records) {
  std::vector<double> sizes;
  for (const FittedRecord& record : records) sizes.insert(sizes.end(), record.size.begin(), record.size.end());
  return sizes;
}

/// The row of a record, by its number among all residuals.
std::string row_of(const std::vector<FittedRecord>& records, std::size_t row) {
  auto record = records.begin();
  for (; row >= record->measured.size(); ++record) row -= record->measured.size();
  return record->row(row);
}

}  // namespace

void doubt_stray_row(const FitResult& result, const std::vector<FittedRecord>& records, double negligible,
                     FitFindings& found) {
  constexpr double false_alarm = 1e-3, noticeable_shift = 0.3;
  if (found.verdict == Verdict::failed || is_rounding(result, negligible)) return;
  std::vector<std::vector<double>> measured;
  for (const FittedRecord& record : records) measured.push_back(record.measured);
  const auto stray = stray_row(result, measured, sizes_of(records));
  if (!stray || !(stray->probability < false_alarm && stray->shift > noticeable_shift)) return;
  question(found, fmt::format("{} lies {:.2g} standard deviations off the fit and off the rows beside it, and moves an "
                              "estimate by {:.2g} standard errors; leave it out if it is an error of the record",
                              row_of(records, stray->row), stray->distance, stray->shift));
}

void widen_for_uneven_scatter(const FitResult& result, const std::vector<FittedRecord>& records, double negligible,
                              const std::string& advice, FitFindings& found) {
  constexpr double false_alarm = 0.002, noticeable_widening = 1.25;
  const bool is_widened =
      std::ranges::any_of(found.parameters, [](const FittedParameter& p) { return reach_of_widened(p).has_value(); });
  if (result.noise_is_known || !is_sound(found.verdict) || is_widened || is_rounding(result, negligible)) return;
  const UnevenScatter scatter = uneven_scatter(result, sizes_of(records));
  if (!(scatter.probability < false_alarm && scatter.widest() > noticeable_widening)) return;
  for (std::size_t j = 0; j < found.parameters.size(); ++j) {
    FittedParameter& p = found.parameters[j];
    widen(p, scatter.widening[j], scatter.freedom);
    hold_move(p, p.lower, p.upper);
  }
  found.warnings.push_back(
      fmt::format("the residuals scatter {:.2g} times as much where large values were measured as where small ones "
                  "were: the intervals are widened for it, up to {:.1f} times; {}",
                  scatter.large / scatter.small, scatter.widest(), advice));
}

}  // namespace pfdm
