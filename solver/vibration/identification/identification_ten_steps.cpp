// The report's iteration (A4.3) for kernels of higher order, as
// it is described. Stiffness and damping by least squares with v given; v as what is left; its kernel as a Prony series
// of M1 terms from the frequency response of v on f; the M terms of the most energy; v from them; and again. Kept for
// comparison: after the first least squares v is orthogonal to the stiffness and damping columns, so that the iteration
// hardly moves.

#include "solver/vibration/identification/identification_ten_steps.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/identification/identification_conditioning.h"
#include "solver/vibration/signals/signals_spectra.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Steps 1 and 2: everything in the same band.
struct Signals {
  Conditioner condition;
  VectorXcd f;  // spectrum within the band
  MatrixXd A;   // damping, z ... z^N
  VectorXd q;   // -m (z'' + y'')
  VectorXd forcing;
  double low = 0.0;  // [Hz]
  double high = 0.0;
};

VectorXd forcing_of(const States& s, const ModelStructure& structure, double lambda, double reference) {
  switch (structure.forcing) {
    case KernelForcing::displacement:
    case KernelForcing::stiffness: return s.displacement;
    case KernelForcing::damping: return s.velocity.array() * (s.velocity.array().abs() / reference).pow(lambda);
    default: return s.velocity;
  }
}

Signals prepare(const VibrationRecord& r, const ModelStructure& structure, double lambda,
                const IdentificationSettings& settings) {
  const PassBand band{.low = 0.9 * r.band_low, .high = std::min(1.1 * r.band_high, 0.38 * r.rate), .skirt = 0.2};
  Signals s{.condition = Conditioner(r.n(), r.rate, band, settings.crop),
            .f = {},
            .A = {},
            .q = {},
            .forcing = {},
            .low = r.band_low,
            .high = r.band_high};
  const States states = integrate_states(r);
  s.f = s.condition.spectrum(forcing_of(states, structure, lambda, settings.reference_velocity));
  s.forcing = s.condition.samples(s.f);
  s.q = -settings.mass * s.condition(r.relative + r.base);
  s.A.resize(s.q.size(), 1 + structure.stiffness_order);
  const Eigen::ArrayXd v = states.velocity.array();
  s.A.col(0) = s.condition((v * (v.abs() / settings.reference_velocity).pow(lambda)).matrix());
  VectorXd power = VectorXd::Ones(r.n());
  for (int i = 1; i <= structure.stiffness_order; ++i) {
    power.array() *= states.displacement.array();
    s.A.col(i) = s.condition(power);
  }
  return s;
}

/// Roots of x^n + a_1 x^(n-1) + ... + a_n.
VectorXcd roots(const VectorXd& a) {
  const Eigen::Index n = a.size();
  MatrixXd companion = MatrixXd::Zero(n, n);
  companion.row(0) = -a.transpose();
  for (Eigen::Index i = 1; i < n; ++i) companion(i, i - 1) = 1.0;
  return eigenvalues(companion);
}

MatrixXd stacked(const MatrixXcd& A) {
  MatrixXd result(2 * A.rows(), A.cols());
  result << A.real(), A.imag();
  return result;
}

/// A19, A20: coefficients of the sampled kernel's transfer function, linear least squares over the band.
VectorXcd prony_poles(const VectorXcd& G, const VectorXd& angle, int order) {
  MatrixXcd X(G.size(), 2 * order);
  for (Eigen::Index k = 0; k < G.size(); ++k)
    for (int i = 0; i < order; ++i) {
      X(k, i) = -G[k] * std::polar(1.0, -angle[k] * (i + 1));
      X(k, order + i) = std::polar(1.0, -angle[k] * i);
    }
  const VectorXd p = scaled_least_squares(stacked(X), stacked(G));
  return roots(p.head(order));
}

/// Energy of a term between 0 and t2 (A15, A16), g = 2 Re[beta exp(-alpha t)] for a pair.
double energy(const HereditaryTerm& term, double t2) {
  const double a = term.alpha.real();
  const double part = (1.0 - std::exp(-2.0 * a * t2)) / (2.0 * a);
  if (!term.is_pair()) return std::norm(term.beta) * part;
  const Complex oscillating = term.beta * term.beta * (1.0 - std::exp(-2.0 * term.alpha * t2)) / (2.0 * term.alpha);
  return 2.0 * std::norm(term.beta) * part + 2.0 * oscillating.real();
}

/// Step 6: the frequency response of v on f within the band.
struct BandResponse {
  VectorXd frequency;  // [Hz]
  VectorXcd G;
};

BandResponse band_response(const Signals& s, const VectorXd& v) {
  SegmentSettings segments;
  segments.length = std::min<Eigen::Index>(2048, s.forcing.size());
  const Spectra spectra_fv = spectra(s.forcing, v, s.condition.rate(), segments);
  const VectorXcd all = frequency_response(spectra_fv, ResponseEstimator::h1);
  std::vector<Eigen::Index> bins;
  for (Eigen::Index k = 0; k < all.size(); ++k)
    if (spectra_fv.frequency[k] >= s.low && spectra_fv.frequency[k] <= s.high) bins.push_back(k);
  return {spectra_fv.frequency(bins), all(bins)};
}

/// Weights of the terms, linear, in continuous time (the sum over samples would count g(0) in full).
void weigh(std::vector<HereditaryTerm>& terms, const BandResponse& measured) {
  MatrixXcd basis(measured.G.size(), 2 * std::ssize(terms));
  for (Eigen::Index k = 0; k < measured.G.size(); ++k)
    for (Eigen::Index i = 0; i < std::ssize(terms); ++i) {
      const Complex jw(0.0, 2.0 * std::numbers::pi * measured.frequency[k]);
      const HereditaryTerm& term = terms[i];
      const Complex one = 1.0 / (jw + term.alpha);
      const Complex other = term.is_pair() ? 1.0 / (jw + std::conj(term.alpha)) : Complex(0.0);
      basis(k, 2 * i) = one + other;
      basis(k, 2 * i + 1) = Complex(0.0, 1.0) * (term.is_pair() ? one - other : Complex(0.0));
    }
  const VectorXd beta = scaled_least_squares(stacked(basis), stacked(measured.G));
  for (std::size_t i = 0; i < terms.size(); ++i)
    terms[i].beta = {beta[2 * i], terms[i].is_pair() ? beta[2 * i + 1] : 0.0};
}

/// Step 7: stable poles only, one of each pair, and their weights. Step 8: those of the most energy are kept.
std::vector<PronyTerm> prony_series(const BandResponse& measured, double rate, int order, int prony_order) {
  std::vector<HereditaryTerm> terms;
  for (const Complex pole : prony_poles(measured.G, 2.0 * std::numbers::pi / rate * measured.frequency, prony_order)) {
    if (std::abs(pole) >= 1.0 || pole.imag() < 0.0 || (pole.imag() == 0.0 && pole.real() <= 0.0)) continue;
    terms.push_back({-std::log(pole) * rate, 0.0});
  }
  weigh(terms, measured);
  std::vector<PronyTerm> series;
  series.reserve(terms.size());
  for (const HereditaryTerm& term : terms) series.push_back({.term = term, .energy = energy(term, ten_step_duration)});
  std::ranges::sort(series, std::ranges::greater(), &PronyTerm::energy);
  int n = 0;
  for (PronyTerm& term : series) {
    const int states = term.term.is_pair() ? 2 : 1;
    if (n + states > order) continue;
    term.kept = true;
    n += states;
  }
  return series;
}

std::vector<HereditaryTerm> kept_terms(const std::vector<PronyTerm>& series) {
  std::vector<HereditaryTerm> kept;
  for (const PronyTerm& term : series)
    if (term.kept) kept.push_back(term.term);
  return kept;
}

VectorXd hereditary(const Signals& s, const MassMaterial& model) {
  VectorXcd v = s.f;
  for (Eigen::Index k = 0; k < v.size(); ++k) v[k] *= kernel_response(model, s.condition.omega()[k]);
  return s.condition.samples(v);
}

double largest_change(const VectorXd& now, const VectorXd& before) {
  return ((now - before).array() / before.array().abs().max(1e-300)).abs().maxCoeff();
}

VectorXd kernel_values(const MassMaterial& m) {
  std::vector<double> values;
  for (const HereditaryTerm& term : m.kernel)
    for (const double x : {term.alpha.real(), term.alpha.imag(), term.beta.real(), term.beta.imag()})
      values.push_back(x == 0.0 ? 1.0 : x);
  return Eigen::Map<VectorXd>(values.data(), std::ssize(values));
}

}  // namespace

TenSteps ten_steps(std::span<const VibrationRecord> records, const ModelStructure& structure, int order,
                   const IdentificationSettings& settings, int prony_order, int maximum_iterations) {
  const double lambda =
      structure.nonlinear_damping ? regress_separable(records, structure, 0, settings)->model.damping_exponent : 0.0;
  const Signals s = prepare(records.front(), structure, lambda, settings);
  TenSteps result;
  MassMaterial& m = result.regression.model;
  m = {.mass = settings.mass,
       .damping_exponent = lambda,
       .reference_velocity = settings.reference_velocity,
       .forcing = structure.forcing};
  VectorXd v = VectorXd::Zero(s.q.size());  // step 3
  VectorXd p;
  VectorXd kernel;
  for (int i = 0; i < maximum_iterations && !result.settled; ++i) {
    const VectorXd now = scaled_least_squares(s.A, s.q - v);      // step 4
    const BandResponse rest = band_response(s, s.q - s.A * now);  // steps 5, 6
    result.series = prony_series(rest, s.condition.rate(), order, prony_order);
    result.frequency = rest.frequency;
    result.response = rest.G;
    m.kernel = kept_terms(result.series);
    v = hereditary(s, m);
    const VectorXd found = kernel_values(m);
    result.settled = i > 0 && largest_change(now, p) < 1e-3 && found.size() == kernel.size() &&
                     (found.size() == 0 || largest_change(found, kernel) < 1e-2);  // step 9
    result.iterations.push_back({.damping = now[0],
                                 .stiffness = {now.data() + 1, now.data() + now.size()},
                                 .misfit = (s.A * now + v - s.q).norm() / s.q.norm()});
    p = now;
    kernel = found;
  }
  const TenStep& last = result.iterations.back();
  result.regression.misfit = last.misfit;
  m.damping = last.damping;
  m.stiffness = last.stiffness;
  if (structure.forcing == KernelForcing::stiffness)
    for (HereditaryTerm& term : m.kernel) term.beta /= m.stiffness.front();
  return result;
}

VectorXd impulse_response(std::span<const HereditaryTerm> terms, Eigen::Index n, double rate) {
  VectorXd g = VectorXd::Zero(n);
  for (const HereditaryTerm& term : terms)
    for (Eigen::Index k = 0; k < n; ++k)
      g[k] +=
          (term.is_pair() ? 2.0 : 1.0) * (term.beta * std::exp(-term.alpha * (static_cast<double>(k) / rate))).real();
  return g;
}

VectorXcd frequency_response(std::span<const HereditaryTerm> terms, const VectorXd& frequency) {
  VectorXcd G = VectorXcd::Zero(frequency.size());
  for (const HereditaryTerm& term : terms)
    for (Eigen::Index k = 0; k < frequency.size(); ++k) {
      const Complex jw(0.0, 2.0 * std::numbers::pi * frequency[k]);
      G[k] += term.beta / (jw + term.alpha);
      if (term.is_pair()) G[k] += std::conj(term.beta) / (jw + std::conj(term.alpha));
    }
  return G;
}

}  // namespace pfdm
