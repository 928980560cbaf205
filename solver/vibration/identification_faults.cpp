#include "solver/vibration/identification_faults.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/identification_conditioning.h"
#include "solver/vibration/identification_responses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double clearly_less = 1.0 / 3.0;
constexpr int windows = 20;

struct Hypothesis {
  std::string fault;
  std::string undone;
  VibrationRecord (*undo)(VibrationRecord record, int samples);
  int samples = 0;
};

VibrationRecord with_base_turned(VibrationRecord r, int) {
  r.base = -r.base;
  return r;
}

VibrationRecord made_relative(VibrationRecord r, int) {
  r.relative -= r.base;
  return r;
}

/// The base later by so many samples.
VibrationRecord shifted(VibrationRecord r, int samples) {
  const Index n = r.n(), by = std::abs(samples);
  VectorXd base = VectorXd::Zero(n);
  if (samples > 0)
    base.tail(n - by) = r.base.head(n - by);
  else
    base.head(n - by) = r.base.tail(n - by);
  r.base = std::move(base);
  return r;
}

std::vector<Hypothesis> hypotheses() {
  std::vector<Hypothesis> all{
      {"the sign of one channel is reversed", "turned", with_base_turned},
      {"the relative channel holds the mass's own (absolute) acceleration", "the base's subtracted", made_relative}};
  for (const int samples : {1, -1, 2, -2})
    all.push_back({fmt::format("the {} channel is {} sample{} behind the other", samples > 0 ? "relative" : "base",
                               std::abs(samples), std::abs(samples) > 1 ? "s" : ""),
                   "moved", shifted, samples});
  return all;
}

/// Of the equation of motion, by least squares, which is quick; infinite where no terms dissipate.
double equation_misfit(const VibrationRecord& record, const ModelStructure& structure, int order,
                       const IdentificationSettings& settings) {
  const auto found = regress_separable(std::span(&record, 1), structure, order, settings);
  return found ? found->misfit : std::numeric_limits<double>::infinity();
}

/// Of the response that the model gives when it is fitted to the record.
double output_misfit(const VibrationRecord& record, const ModelStructure& structure, int order,
                     IdentificationSettings settings) {
  settings.replicates = 0;
  const auto start = regress_separable(std::span(&record, 1), structure, order, settings);
  if (!start) return std::numeric_limits<double>::infinity();
  const OutputErrorFit fit = refine_output(std::span(&record, 1), start->model, settings);
  return fit.record_misfit.empty() ? std::numeric_limits<double>::infinity() : fit.record_misfit.front();
}

/// By window, the part of the base's acceleration that the mass's motion accounts for; nothing of a base at rest that
/// the mass does not rest on, all where nothing happens at all.
std::vector<double> explained_by_motion(const VibrationRecord& record) {
  constexpr double least_level = 0.01;
  const PassBand band{.low = 0.5 * record.band_low, .high = std::min(3.0 * record.band_high, 0.38 * record.rate)};
  MatrixXd motion(record.n(), 3);
  for (int order = 0; order < 3; ++order) motion.col(order) = integrated(record.relative, record.rate, order, band);
  const VectorXd base = filtered(record.base, record.rate, band);
  const Index length = record.n() / windows;
  const double base_level = base.norm() / std::sqrt(windows), level = motion.col(0).norm() / std::sqrt(windows);
  std::vector<double> explained;
  for (int w = 0; w < windows; ++w) {
    const VectorXd y = base.segment(w * length, length);
    const MatrixXd A = motion.middleRows(w * length, length);
    if (!(y.norm() > least_level * base_level)) {
      explained.push_back(A.col(0).norm() > least_level * level ? 0.0 : 1.0);
      continue;
    }
    const double left = A.isZero(0.0) ? y.norm() : (A * scaled_least_squares(A, y) - y).norm();
    explained.push_back(1.0 - left * left / y.squaredNorm());
  }
  return explained;
}

std::optional<std::string> fault_of(const VibrationRecord& record, double misfit, const ModelStructure& structure,
                                    const IdentificationSettings& settings) {
  if (const auto dead = dead_part(record))
    return fmt::format("a channel is dead from {:.3g} to {:.3g} s", dead->first, dead->second);
  const int order = structure.forcing == KernelForcing::none ? 0 : 1;
  const double now = equation_misfit(record, structure, order, settings);
  double least = 0.8 * now;
  std::optional<Hypothesis> best;
  for (const Hypothesis& h : hypotheses()) {
    const double there = equation_misfit(h.undo(record, h.samples), structure, order, settings);
    if (!(there < least)) continue;
    least = there;
    best = h;
  }
  if (!best) return std::nullopt;
  const double after = output_misfit(best->undo(record, best->samples), structure, order, settings);
  if (!(after < 1.0) || (std::isfinite(misfit) && !(after < clearly_less * misfit))) return std::nullopt;
  return fmt::format("{}: {}, the misfit falls from {:.3g} to {:.3g}", best->fault, best->undone, misfit, after);
}

}  // namespace

std::optional<std::pair<double, double>> dead_part(const VibrationRecord& record) {
  constexpr double explained_if_dead = 0.1, explained_if_alive = 0.4;
  const std::vector<double> explained = explained_by_motion(record);
  int first = windows, last = -1;
  for (int w = 1; w + 1 < windows; ++w)  // the ends may be ramps
    if (explained[static_cast<std::size_t>(w)] < explained_if_dead) {
      first = std::min(first, w);
      last = w;
    }
  if (last <= first || !(std::ranges::max(explained) > explained_if_alive)) return std::nullopt;
  const auto samples = record.n() / windows;
  const double seconds = static_cast<double>(samples) / record.rate;
  return std::pair{first * seconds, last + 2 == windows ? record.duration() : (last + 1) * seconds};
}

std::vector<std::string> recognised_faults(std::span<const VibrationRecord> records, std::span<const double> misfit,
                                           const ModelStructure& structure, const IdentificationSettings& settings) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < records.size(); ++i)
    if (const auto fault = fault_of(records[i], misfit[i], structure, settings))
      faults.push_back(fmt::format("test {}: {}", records[i].name, *fault));
  return faults;
}

}  // namespace pfdm
