#include "solver/vibration/diagnosis/identification_changes.h"

#include "solver/vibration/identification/identification_responses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

constexpr double alike_ratios = 0.05;  // of the ratios of parameters

/// The model fitted to one record, if that leaves a third of `misfit`, or of the response, at most.
std::optional<OutputErrorFit> by_itself(const VibrationRecord& record, double misfit, const MassMaterial& model,
                                        IdentificationSettings settings) {
  settings.replicates = 0;
  OutputErrorFit fit = refine_output(std::span(&record, 1), model, settings);
  if (fit.record_misfit.empty() || !(fit.record_misfit.front() < std::min(misfit, 1.0) / 3.0)) return std::nullopt;
  return fit;
}

VibrationRecord quarter_of(const VibrationRecord& r, Eigen::Index number) {
  const Eigen::Index n = r.n() / 4;
  VibrationRecord quarter = r;
  quarter.base = r.base.segment(number * n, n);
  quarter.relative = r.relative.segment(number * n, n);
  return quarter;
}

/// All parameters that are in proportion to the mass are smaller by the same factor.
std::optional<double> as_by_another_mass(const MassMaterial& one, const MassMaterial& other) {
  const double ratio = one.stiffness[0] / other.stiffness[0];
  const auto is_same = [&](double a, double b) { return std::abs(a / b / ratio - 1.0) < alike_ratios; };
  if (!(std::abs(ratio - 1.0) > alike_ratios) || !is_same(one.damping, other.damping)) return std::nullopt;
  return ratio;
}

std::optional<std::string> change_between(std::span<const VibrationRecord> records, std::span<const double> misfit,
                                          const MassMaterial& model, const IdentificationSettings& settings) {
  constexpr std::size_t most = 8;
  if (records.size() < 2 || records.size() > most) return std::nullopt;
  std::vector<OutputErrorFit> fits;
  for (std::size_t i = 0; i < records.size(); ++i) {
    auto fit = by_itself(records[i], misfit[i], model, settings);
    if (!fit) return std::nullopt;
    fits.push_back(std::move(*fit));
  }
  const auto k1 = [](const OutputErrorFit& fit) { return fit.model.stiffness[0]; };
  const auto [soft, stiff] = std::ranges::minmax_element(fits, {}, k1);
  const auto name = [&](auto it) { return records[it - fits.begin()].name; };
  std::string text = fmt::format(
      "every test by itself is met (misfit {:.3g} at most), but not all together: the mass or the sample has changed "
      "between them, k1 from {:.4g} N/m (test {}) to {:.4g} N/m (test {})",
      std::ranges::max(fits, {}, [](const OutputErrorFit& f) { return f.record_misfit[0]; }).record_misfit[0],
      k1(*soft), name(soft), k1(*stiff), name(stiff));
  if (const auto ratio = as_by_another_mass(stiff->model, soft->model))
    text += fmt::format(", all parameters by one factor, {:.3g}, as another mass has it", *ratio);
  return text;
}

std::optional<std::string> change_within(const VibrationRecord& record, double misfit, const MassMaterial& model,
                                         const IdentificationSettings& settings) {
  constexpr double least_periods = 40.0;
  if (record.duration() * record.band_low < 4.0 * least_periods || driving_base(record).swept) return std::nullopt;
  const auto first = by_itself(quarter_of(record, 0), misfit, model, settings);
  const auto last = first ? by_itself(quarter_of(record, 3), misfit, model, settings) : std::nullopt;
  if (!last) return std::nullopt;
  return fmt::format(
      "test {}: the sample changes during the test: by themselves its first and last quarter leave {:.3g} and {:.3g} "
      "of "
      "the response, all of it {:.3g}; k1 {:.4g} and {:.4g} N/m",
      record.name, first->record_misfit[0], last->record_misfit[0], misfit, first->model.stiffness[0],
      last->model.stiffness[0]);
}

}  // namespace

std::vector<std::string> changes_of_sample(std::span<const VibrationRecord> records, std::span<const double> misfit,
                                           const MassMaterial& model, const IdentificationSettings& settings) {
  std::vector<std::string> changes;
  if (const auto between = change_between(records, misfit, model, settings)) changes.push_back(*between);
  if (!changes.empty() || records.size() > 1) return changes;
  if (const auto within = change_within(records[0], misfit[0], model, settings)) changes.push_back(*within);
  return changes;
}

}  // namespace pfdm
