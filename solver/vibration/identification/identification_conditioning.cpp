#include "solver/vibration/identification/identification_conditioning.h"

#include "solver/parallel.h"
#include "solver/vibration/signals/signals_fourier.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace pfdm {
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

PreparedRecord prepare(const VibrationRecord& r, const ModelStructure& structure,
                       const IdentificationSettings& settings) {
  const bool harmonics = structure.stiffness_order > 1;
  const PassBand band{
      .low = 0.9 * r.band_low, .high = std::min((harmonics ? 2.2 : 1.1) * r.band_high, 0.38 * r.rate), .skirt = 0.2};
  PreparedRecord p{.condition = Conditioner(r.n(), r.rate, band, settings.crop),
                   .states = integrate_states(r),
                   .force = {},
                   .powers = {},
                   .velocity = {},
                   .low = r.band_low,
                   .high = r.band_high};
  p.force = -settings.mass * p.condition.spectrum(r.relative + r.base);
  p.velocity = p.condition.spectrum(p.states.velocity);
  VectorXd power = VectorXd::Ones(r.n());
  for (int i = 0; i < structure.stiffness_order; ++i) {
    power.array() *= p.states.displacement.array();
    p.powers.push_back(p.condition.spectrum(power));
  }
  p.weight = 1.0 / p.condition.samples(p.force).norm();
  return p;
}

}  // namespace

Conditioner::Conditioner(Eigen::Index n, double rate, const PassBand& band, double crop)
    : n_(n), length_(fast_length(n)) {
  const double df = rate / static_cast<double>(length_);
  const double highest = std::min(band.high * (1.0 + band.skirt), 0.5 * rate);
  reduced_ = std::min(fast_length(static_cast<Eigen::Index>(std::ceil(2.0 * highest / df)) + 2), length_);
  gain_.resize(reduced_ / 2 + 1);
  omega_.resize(gain_.size());
  for (Eigen::Index k = 0; k < gain_.size(); ++k) {
    gain_[k] = band.gain(df * static_cast<double>(k));
    omega_[k] = 2.0 * std::numbers::pi * df * static_cast<double>(k);
  }
  const double ratio = static_cast<double>(reduced_) / static_cast<double>(length_);
  rate_ = rate * ratio;
  n_reduced_ = std::min(static_cast<Eigen::Index>(std::floor(static_cast<double>(n - 1) * ratio)) + 1, reduced_);
  const double used = static_cast<double>(n) * ratio;
  first_ = static_cast<Eigen::Index>(std::ceil(crop * used));
  n_kept_ = static_cast<Eigen::Index>(std::floor((1.0 - crop) * used)) - first_;
}

VectorXcd Conditioner::spectrum(const Eigen::Ref<const VectorXd>& signal) const {
  VectorXd padded = VectorXd::Zero(length_);
  padded.head(n_) = signal;
  return fourier(padded).head(gain_.size());
}

VectorXd Conditioner::at_reduced_rate(const VectorXcd& spectrum) const {
  const double scale = static_cast<double>(reduced_) / static_cast<double>(length_);
  return inverse_fourier(scale * spectrum, reduced_);
}

VectorXd Conditioner::samples(const VectorXcd& spectrum) const {
  return at_reduced_rate(spectrum.cwiseProduct(gain_)).segment(first_, n_kept_);
}

VectorXd Conditioner::reduced(const Eigen::Ref<const VectorXd>& signal) const {
  return at_reduced_rate(spectrum(signal)).head(n_reduced_);
}

VectorXd Conditioner::operator()(const Eigen::Ref<const VectorXd>& signal) const {
  if (signal.size() == n_) return samples(spectrum(signal));
  assert(signal.size() == n_reduced_);
  VectorXd padded = VectorXd::Zero(reduced_);
  padded.head(n_reduced_) = signal;
  return inverse_fourier(fourier(padded).cwiseProduct(gain_), reduced_).segment(first_, n_kept_);
}

States integrate_states(const VibrationRecord& record) {
  const PassBand band{.low = 0.5 * record.band_low, .high = std::min(6.0 * record.band_high, 0.4 * record.rate)};
  return {.displacement = integrated(record.relative, record.rate, 2, band),
          .velocity = integrated(record.relative, record.rate, 1, band)};
}

std::vector<PreparedRecord> prepare_all(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                        const IdentificationSettings& settings) {
  std::vector<PreparedRecord> prepared;
  for (const VibrationRecord& record : records) prepared.push_back(prepare(record, structure, settings));
  return prepared;
}

VectorXcd shaped_velocity(const PreparedRecord& p, double lambda, double reference) {
  if (lambda == 0.0) return p.velocity;
  const Eigen::ArrayXd v = p.states.velocity.array();
  return p.condition.spectrum((v * (v.abs() / reference).pow(lambda)).matrix());
}

RecordSystem assemble(std::span<const PreparedRecord> prepared, const RecordColumns& columns) {
  std::vector<std::pair<std::vector<VectorXd>, VectorXd>> parts(prepared.size());
  parallel_chunks(
      count_of(prepared), [&](pfdm::Index begin, pfdm::Index) { parts[begin] = columns(prepared[begin]); }, 1);
  RecordSystem s;
  Eigen::Index n = 0;
  for (const PreparedRecord& p : prepared) n += p.condition.n_samples();
  Eigen::Index first = 0;
  s.q.resize(n);
  s.A.resize(n, static_cast<Eigen::Index>(parts.front().first.size()));
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    const PreparedRecord& p = prepared[i];
    const auto& [a, q] = parts[i];
    const Eigen::Index m = p.condition.n_samples();
    for (std::size_t k = 0; k < a.size(); ++k) s.A.col(k).segment(first, m) = p.weight * a[k];
    s.q.segment(first, m) = p.weight * q;
    first += m;
  }
  return s;
}

}  // namespace pfdm
