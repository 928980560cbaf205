#include "solver/vibration/identification/identification_responses.h"

#include "solver/parallel.h"
#include "solver/vibration/identification/identification_initial_motion.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How far a sample may rely on the tracker, whose filter needs signal on both sides: 0 at the ends of the record, 1
/// from four of its time constants on.
double reliance(Eigen::Index i, const VibrationRecord& r) {
  const double distance = static_cast<double>(std::min(i, r.n() - 1 - i)) / r.rate * tracking_width;
  const double part = std::clamp((distance - 1.0) / 3.0, 0.0, 1.0);
  return part * part * (3.0 - 2.0 * part);
}

int most_substeps(const MassMaterial& model, std::span<const double> rates) {
  int substeps = 1;
  for (const double rate : rates) substeps = std::max(substeps, substeps_for(model, rate));
  return substeps;
}

/// Of a sweep everything is kept that moves with the driving frequency or its harmonics, within the tracking width; the
/// rest is noise. Where the rest is no small part there is no sweep, and where it is next to nothing (below -60 dB)
/// there is no noise: then the record is left as it is.
DrivingBase tracked_base(const VibrationRecord& r) {
  const PassBand band{.low = 0.8 * r.band_low, .high = 1.2 * r.band_high};
  VectorXd tracked = tracked_sweep(r.base, r.rate, band, tracking_width);
  const Eigen::Index edge = r.n() / 4;  // the ends are not tracked well
  const Eigen::Index n = r.n() - 2 * edge;
  const double rest = (tracked - r.base).segment(edge, n).norm() / r.base.segment(edge, n).norm();
  const bool swept = rest <= 0.1;
  if (rest < 1e-3 || !swept) return {r.base, swept};
  for (Eigen::Index i = 0; i < r.n(); ++i) {
    const double weight = reliance(i, r);
    tracked[i] = weight * tracked[i] + (1.0 - weight) * r.base[i];
  }
  return {std::move(tracked), true};
}

/// Those that were asked for last: every trial of a model asks for those of the same records.
class TrackedBases {
 public:
  DrivingBase of(const VibrationRecord& r) {
    if (const auto known = find(r)) return *known;
    const auto tracked = std::make_shared<const DrivingBase>(tracked_base(r));
    const std::scoped_lock lock(mutex_);
    known_.push_front({r.base, r.rate, r.band_low, r.band_high, tracked});
    Eigen::Index n_samples = 0;
    const auto last = std::ranges::find_if(
        known_, [&](const Known& known) { return (n_samples += known.base.size()) > most_samples; });
    known_.erase(last, known_.end());
    return *tracked;
  }

 private:
  static constexpr Eigen::Index most_samples = 2'000'000;
  struct Known {
    VectorXd base;
    double rate, low, high;
    std::shared_ptr<const DrivingBase> tracked;
    bool is_of(const VibrationRecord& r) const {
      return rate == r.rate && low == r.band_low && high == r.band_high && base.size() == r.n() && base == r.base;
    }
  };

  std::shared_ptr<const DrivingBase> find(const VibrationRecord& r) {
    const std::scoped_lock lock(mutex_);
    const auto known = std::ranges::find_if(known_, [&](const Known& candidate) { return candidate.is_of(r); });
    if (known == known_.end()) return nullptr;
    std::rotate(known_.begin(), known, known + 1);
    return known_.front().tracked;
  }

  std::mutex mutex_;
  std::deque<Known> known_;
};

}  // namespace

/// Noise on it would come through the nonlinear terms as a bias.
DrivingBase driving_base(const VibrationRecord& r) {
  static TrackedBases bases;
  return bases.of(r);
}

Conditioner output_condition(const VibrationRecord& r, double crop) {
  const PassBand band{.low = 0.5 * r.band_low, .high = std::min(3.0 * r.band_high, 0.38 * r.rate), .skirt = 0.2};
  return {r.n(), r.rate, band, crop};
}

VectorXd Responses::Output::compared(const Eigen::Ref<const VectorXd>& response) const {
  VectorXd all = condition(response);
  if (free.size() > 0) all -= free * (free.transpose() * all);
  return all;
}

Responses::Responses(std::span<const VibrationRecord> records, double crop, const MassMaterial& about) {
  for (const VibrationRecord& r : records)
    outputs_.push_back(
        {.condition = output_condition(r, crop), .base = {}, .rate = r.rate, .measured = {}, .start = r.start});
  const auto prepare = [&](pfdm::Index begin, pfdm::Index) {
    const VibrationRecord& r = records[begin];
    Output& out = outputs_[begin];
    out.base = driving_base(r).acceleration;
    out.measured = out.condition(r.relative);
    out.weight = std::sqrt(static_cast<double>(out.measured.size())) / out.measured.norm();
    if (out.start.is_rest()) return;
    out.free = orthonormal(free_motions(about, r, crop));
    out.measured = out.compared(r.relative);
  };
  parallel_chunks(count_of(records), prepare, 1);
  for (Output& out : outputs_) {
    out.first = size_;
    size_ += out.measured.size();
  }
}

Drives Responses::full_drives(const MassMaterial& model) const {
  std::vector<double> rates;
  for (const Output& out : outputs_) rates.push_back(out.rate);
  const int substeps = most_substeps(model, rates);
  Drives drives;
  for (const Output& out : outputs_) drives.push_back(nodes_of(out.base, out.rate, substeps));
  return drives;
}

Drives Responses::reduced_drives(const MassMaterial& model) const {
  constexpr double worth = 0.8;
  std::vector<double> rates;
  for (const Output& out : outputs_) {
    if (out.condition.rate() > worth * out.rate) return full_drives(model);
    rates.push_back(out.condition.rate());
  }
  const int substeps = most_substeps(model, rates);
  Drives drives;
  for (const Output& out : outputs_)
    drives.push_back(nodes_of(out.condition.reduced(out.base), out.condition.rate(), substeps));
  return drives;
}

MatrixXd Responses::simulated(std::span<const MassMaterial> models, const Drives& drives) const {
  std::vector<SimulationRun> runs;  // all models of the first record, of the second ...
  for (const BaseNodes& base : drives)
    for (const MassMaterial& m : models) runs.push_back({&m, &base, outputs_[&base - drives.data()].start});
  const auto groups = simulation_groups(runs);
  MatrixXd result(size_, static_cast<Eigen::Index>(models.size()));
  const auto fill = [&](const SimulationRun& run, const VectorXd& z) {
    const Output& out = outputs_[run.base - drives.data()];
    auto to = result.col(run.model - models.data()).segment(out.first, out.measured.size());
    if (z.allFinite())
      to = out.weight * out.compared(z);
    else
      to.setConstant(std::numeric_limits<double>::quiet_NaN());
  };
  parallel_chunks(
      count_of(groups),
      [&](pfdm::Index begin, pfdm::Index) {
        const auto& group = groups[begin];
        const std::vector<VectorXd> responses = simulate_group(group);
        for (std::size_t i = 0; i < group.size(); ++i) fill(group[i], responses[i]);
      },
      1);
  return result;
}

VectorXd Responses::residuals(VectorXd response) const {
  for (const Output& out : outputs_) response.segment(out.first, out.measured.size()) -= out.weight * out.measured;
  return response;
}

std::vector<double> Responses::misfits(const VectorXd& r) const {
  std::vector<double> result;
  for (const Output& out : outputs_)
    result.push_back(r.segment(out.first, out.measured.size()).norm() /
                     std::sqrt(static_cast<double>(out.measured.size())));
  return result;
}

std::vector<ResidualBlock> Responses::blocks() const {
  std::vector<ResidualBlock> result;
  for (const Output& out : outputs_) {
    const Eigen::Index n = out.measured.size();
    // Some periods, and what is left of the noise within the tracking width.
    const double length = std::max(200.0, 1.5 * out.condition.rate() / tracking_width);
    const auto count = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(static_cast<double>(n) / length), 1, 600);
    for (Eigen::Index i = 0; i < count; ++i)
      result.emplace_back(out.first + n * i / count, out.first + n * (i + 1) / count);
  }
  return result;
}

VectorXd predicted_response(const MassMaterial& model, const VibrationRecord& record, double crop) {
  const BaseNodes base = nodes_of(record.base, record.rate, substeps_for(model, record.rate));
  return simulate_batch(std::span(&model, 1), base, begun_motion(model, record, crop).value_or(InitialMotion{})).col(0);
}

double prediction_misfit(const MassMaterial& model, const VibrationRecord& record, double crop) {
  const Conditioner condition = output_condition(record, crop);
  const VectorXd z = predicted_response(model, record, crop);
  if (!z.allFinite()) return std::numeric_limits<double>::infinity();
  const VectorXd measured = condition(record.relative);
  return (condition(z) - measured).norm() / measured.norm();
}

}  // namespace pfdm
