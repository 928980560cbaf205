#include "solver/vibration/identification/identification_stiffness.h"

#include "physics/error.h"
#include "solver/calibration/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXd;

/// Leakage of Hann's window near the resonance: a part of |H| that averaging does not make smaller.
constexpr double leakage = 3e-4;
/// Hann's window makes neighbouring frequencies depend on each other: noise bandwidth in bins.
constexpr double bins_per_value = 1.5;

struct Band {
  VectorXd omega;
  Eigen::VectorXcd H;
  VectorXd weight;  // one over the standard deviation of Re H and Im H
};

Band band_of(const Spectra& s, double low, double high) {
  const Eigen::VectorXcd H = frequency_response(s, ResponseEstimator::h1);
  const VectorXd gamma2 = coherence(s);
  std::vector<Eigen::Index> bins;
  for (Eigen::Index k = 1; k < s.frequency.size(); ++k)
    if (s.frequency[k] >= low && s.frequency[k] <= high) bins.push_back(k);
  Band band{.omega = 2.0 * std::numbers::pi * s.frequency(bins), .H = H(bins), .weight = VectorXd(std::ssize(bins))};
  for (Eigen::Index i = 0; i < band.omega.size(); ++i) {
    const double g2 = std::min(gamma2[bins[i]], 1.0);
    const double variance = (1.0 - g2) / (2.0 * g2 * s.averages) + 0.5 * leakage * leakage;
    band.weight[i] = 1.0 / (std::abs(band.H[i]) * std::sqrt(variance));
  }
  return band;
}

MassMaterial model_of(const VectorXd& x, double mass) {
  MassMaterial m{.mass = mass,
                 .stiffness = {std::exp(x[0])},
                 .damping = std::exp(x[1]),
                 .forcing = x.size() > 2 ? KernelForcing::velocity : KernelForcing::none};
  for (Eigen::Index i = 2; i + 1 < x.size(); i += 2) m.kernel.push_back({std::exp(x[i]), std::exp(x[i + 1])});
  std::ranges::sort(m.kernel, {}, [](const HereditaryTerm& term) { return term.alpha.real(); });
  return m;
}

VectorXd residuals(const VectorXd& x, const Band& band, double mass) {
  const MassMaterial m = model_of(x, mass);
  VectorXd r(2 * band.omega.size());
  for (Eigen::Index i = 0; i < band.omega.size(); ++i) {
    const double inertia = mass * band.omega[i] * band.omega[i];
    const Complex H = inertia / (complex_stiffness(m, band.omega[i]) - inertia);
    const Complex off = band.weight[i] * (H - band.H[i]);
    r[2 * i] = off.real();
    r[2 * i + 1] = off.imag();
  }
  return r;
}

LeastSquaresResult refine(const Band& band, double mass, const VectorXd& start) {
  return minimise({.residuals = [&](const VectorXd& x) { return std::optional(residuals(x, band, mass)); }}, start);
}

/// Stiffness where |H| is largest, 5 % of critical damping.
VectorXd plain_start(const Band& band, double mass) {
  Eigen::Index peak = 0;
  band.H.cwiseAbs().maxCoeff(&peak);
  const double omega = band.omega[peak];
  VectorXd start(2);
  start << std::log(mass * omega * omega), std::log(0.1 * mass * omega);
  return start;
}

/// The fit of one order less, a term of small weight added at several rates.
std::vector<VectorXd> starts(const Band& band, double mass, const VectorXd& smaller) {
  std::vector<VectorXd> result;
  const double low = std::log(band.omega[0]);
  const double high = std::log(band.omega[band.omega.size() - 1]);
  for (int i = 0; i < 6; ++i) {
    VectorXd x(smaller.size() + 2);
    x << smaller, low + (high - low) * (i + 0.5) / 6.0, std::log(0.05 * std::exp(plain_start(band, mass)[0]));
    result.push_back(std::move(x));
  }
  return result;
}

/// Densities of all records, by their number of segments; those of a strong test are scaled down to the first one's.
struct Averaged {
  Spectra spectra;
  double low = 0.0;  // what all of them excite [Hz]
  double high = std::numeric_limits<double>::infinity();
};

Averaged average(std::span<const VibrationRecord> records) {
  Averaged all;
  const SegmentSettings segments{.length = segment_length(records).value_or(SegmentSettings{}.length)};
  for (const VibrationRecord& r : records) {
    const Spectra s = spectra(r.base, r.relative, r.rate, segments);
    all.low = std::max(all.low, r.band_low);
    all.high = std::min(all.high, r.band_high);
    Spectra& sum = all.spectra;
    if (sum.segments == 0) {
      sum = s;
      continue;
    }
    if (s.frequency[1] != sum.frequency[1]) throw InputError("records of different sampling rates cannot be averaged");
    const double total = sum.averages + s.averages;
    const double kept = sum.averages / total;
    const double added = s.averages / total * sum.Sxx.sum() / s.Sxx.sum();
    sum.Sxx = kept * sum.Sxx + added * s.Sxx;
    sum.Syy = kept * sum.Syy + added * s.Syy;
    sum.Sxy = kept * sum.Sxy + added * s.Sxy;
    sum.averages = total;
    sum.segments += s.segments;
  }
  return all;
}

struct Best {
  VectorXd x;
  double norm = std::numeric_limits<double>::infinity();
  bool converged = false;
};

Best best_of_order(const Band& band, double mass, int order) {
  Best best;
  std::vector<VectorXd> tried{plain_start(band, mass)};
  if (order > 0) tried = starts(band, mass, best_of_order(band, mass, order - 1).x);
  for (const VectorXd& start : tried) {
    const LeastSquaresResult found = refine(band, mass, start);
    const double norm = std::sqrt(2.0 * found.cost);
    if (norm < best.norm) best = {found.x, norm, found.converged};
  }
  return best;
}

}  // namespace

std::optional<Eigen::Index> segment_length(std::span<const VibrationRecord> records) {
  constexpr Eigen::Index least_segments = 16;
  constexpr double least_frequencies = 100.0;
  constexpr Eigen::Index longest = SegmentSettings{}.length;
  const double rate = records.front().rate;
  Eigen::Index samples = std::numeric_limits<Eigen::Index>::max();
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  for (const VibrationRecord& r : records) {
    if (r.rate != rate) return std::nullopt;
    samples = std::min(samples, r.n());
    low = std::max(low, r.band_low);
    high = std::min(high, r.band_high);
  }
  Eigen::Index length = longest;
  while (length > 1 && samples < least_segments * length) length /= 2;
  const double frequencies = (high - low) * static_cast<double>(length) / rate;
  if (length < longest && !(frequencies >= least_frequencies)) return std::nullopt;
  return length;
}

StiffnessFit fit_stiffness(const Spectra& s, double mass, double low, double high, int order) {
  const Band band = band_of(s, low, high);
  if (band.omega.size() < 4 * (order + 1)) throw InputError("too few frequencies lie in the band that is excited");
  const Best best = best_of_order(band, mass, order);
  const double n = 2.0 * static_cast<double>(band.omega.size()) / bins_per_value;
  StiffnessFit fit;
  fit.model = model_of(best.x, mass);
  fit.converged = best.converged;
  fit.chi2 = best.norm * best.norm / (2.0 * static_cast<double>(band.omega.size()));
  fit.bic = best.norm * best.norm / bins_per_value + static_cast<double>(best.x.size()) * std::log(n);
  return fit;
}

StiffnessIdentification identify_stiffness(std::span<const VibrationRecord> records,
                                           const IdentificationSettings& settings) {
  const Averaged all = average(records);
  StiffnessIdentification result;
  double least = std::numeric_limits<double>::infinity();
  const int first = settings.kernel_order.value_or(0);
  for (int order = first; order <= settings.kernel_order.value_or(settings.maximum_kernel_order); ++order) {
    StiffnessFit fit = fit_stiffness(all.spectra, settings.mass, all.low, all.high, order);
    result.orders.push_back({order, fit.bic, std::sqrt(fit.chi2)});
    if (fit.bic >= least) break;
    least = fit.bic;
    result.fit = std::move(fit);
  }
  return result;
}

StiffnessFit fit_stiffness(std::span<const VibrationRecord> records, int order,
                           const IdentificationSettings& settings) {
  const Averaged all = average(records);
  return fit_stiffness(all.spectra, settings.mass, all.low, all.high, order);
}

}  // namespace pfdm
