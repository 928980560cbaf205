#include "solver/vibration/identification/identification_added_term.h"

#include "solver/calibration/levenberg_marquardt.h"
#include "solver/linear/dense_algebra.h"
#include "solver/parallel.h"
#include "solver/vibration/identification/identification_conditioning.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pfdm {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int n_rates = 28;
constexpr double decay_ratios[] = {0.01, 0.03, 0.1, 0.3, 0.8};  // of pairs, over their frequency

/// Spectra of all records below each other, each record weighted.
struct Spectral {
  VectorXcd s;      // j omega [1/s]
  VectorXcd f;      // what drives the kernel
  MatrixXcd plain;  // damping, z ... z^N
  VectorXcd q;      // -m (z'' + y'')
};

VectorXd forcing_of(const States& states, const MassMaterial& m, const VectorXd& shaped) {
  switch (m.forcing) {
    case KernelForcing::displacement:
    case KernelForcing::stiffness: return states.displacement;
    case KernelForcing::damping: return shaped;
    default: return states.velocity;
  }
}

/// x/y by real divisions, which are several times as fast as that of complex numbers with its checks of overflow.
Eigen::ArrayXcd ratio(const Eigen::ArrayXcd& x, const Eigen::ArrayXcd& y) { return x * y.conjugate() / y.abs2(); }

/// 1/(s + alpha) of a real term; of a pair what Re beta and Im beta multiply: beta/(s + alpha) and its conjugate are
/// together (2 Re beta (s + a) + 2 Im beta w)/((s + a)^2 + w^2).
MatrixXcd columns_of(Complex alpha, const VectorXcd& s, const VectorXcd& f) {
  const Eigen::ArrayXcd moved = s.array() + alpha.real();
  if (alpha.imag() == 0.0) return ratio(f.array(), moved).matrix();
  const Eigen::ArrayXcd filtered = ratio(2.0 * f.array(), moved.square() + alpha.imag() * alpha.imag());
  MatrixXcd columns(s.size(), 2);
  columns.col(0) = filtered * moved;
  columns.col(1) = filtered * alpha.imag();
  return columns;
}

Spectral spectral(const VibrationRecord& r, const MassMaterial& m, const IdentificationSettings& settings) {
  const bool harmonics = m.stiffness.size() > 1;
  const PassBand band{
      .low = 0.9 * r.band_low, .high = std::min((harmonics ? 2.2 : 1.1) * r.band_high, 0.38 * r.rate), .skirt = 0.2};
  const Conditioner condition(r.n(), r.rate, band, settings.crop);
  const VectorXd& omega = condition.omega();
  std::vector<Eigen::Index> bins;
  for (Eigen::Index k = 0; k < omega.size(); ++k)
    if (band.gain(omega[k] / (2.0 * std::numbers::pi)) == 1.0) bins.push_back(k);
  const auto within = [&](const VectorXd& x) -> VectorXcd { return condition.spectrum(x)(bins); };
  const States states = integrate_states(r);
  const VectorXd v = states.velocity;
  const VectorXd shaped = v.array() * (v.array().abs() / m.reference_velocity).pow(m.damping_exponent);
  Spectral result{.s = Complex(0.0, 1.0) * omega(bins).cast<Complex>(),
                  .f = within(forcing_of(states, m, shaped)),
                  .plain = {},
                  .q = -settings.mass * within(r.relative + r.base)};
  const auto n = static_cast<Eigen::Index>(m.stiffness.size());
  result.plain.resize(result.q.size(), 1 + n);
  result.plain.col(0) = within(shaped);
  VectorXd power = VectorXd::Ones(r.n());
  for (Eigen::Index i = 0; i < n; ++i) {
    power.array() *= states.displacement.array();
    result.plain.col(1 + i) = within(power);
  }
  const double weight = 1.0 / result.q.norm();
  result.f *= weight, result.plain *= weight, result.q *= weight;
  return result;
}

Spectral joined(std::span<const VibrationRecord> records, const MassMaterial& m,
                const IdentificationSettings& settings) {
  std::vector<Spectral> parts(records.size());
  parallel_chunks(
      count_of(records), [&](pfdm::Index begin, pfdm::Index) { parts[begin] = spectral(records[begin], m, settings); },
      1);
  Eigen::Index n = 0;
  for (const Spectral& part : parts) n += part.q.size();
  Spectral all{.s = VectorXcd(n), .f = VectorXcd(n), .plain = MatrixXcd(n, parts[0].plain.cols()), .q = VectorXcd(n)};
  Eigen::Index at = 0;
  for (const Spectral& part : parts) {
    const Eigen::Index size = part.q.size();
    all.s.segment(at, size) = part.s;
    all.f.segment(at, size) = part.f;
    all.plain.middleRows(at, size) = part.plain;
    all.q.segment(at, size) = part.q;
    at += size;
  }
  return all;
}

/// Weights of all columns for given rates of the terms, and what they leave.
struct EquationFit {
  VectorXd x;  // of the plain columns, then of the terms'
  VectorXcd left;
};

EquationFit fit_equation(const Spectral& data, std::span<const Complex> alphas) {
  Eigen::Index n_columns = data.plain.cols();
  for (const Complex alpha : alphas) n_columns += alpha.imag() == 0.0 ? 1 : 2;
  MatrixXcd A(data.plain.rows(), n_columns);
  A.leftCols(data.plain.cols()) = data.plain;
  Eigen::Index at = data.plain.cols();
  for (const Complex alpha : alphas) {
    const MatrixXcd columns = columns_of(alpha, data.s, data.f);
    A.middleCols(at, columns.cols()) = columns;
    at += columns.cols();
  }
  const VectorXd norms = A.colwise().norm().cwiseMax(1e-300);
  A = A * norms.cwiseInverse().cast<Complex>().asDiagonal();
  MatrixXd normal = (A.adjoint() * A).real();
  normal.diagonal().array() += 1e-10;  // terms may be alike
  const VectorXd x = solve_symmetric(normal, (A.adjoint() * data.q).real());
  return {.x = x.cwiseQuotient(norms), .left = A * x.cast<Complex>() - data.q};
}

/// Rates as logarithms of their parts.
VectorXd logarithms(std::span<const Complex> alphas) {
  std::vector<double> x;
  for (const Complex alpha : alphas) {
    x.push_back(std::log(alpha.real()));
    if (alpha.imag() != 0.0) x.push_back(std::log(alpha.imag()));
  }
  return Eigen::Map<const VectorXd>(x.data(), std::ssize(x));
}

std::vector<Complex> rates_of(const VectorXd& x, std::span<const Complex> like) {
  std::vector<Complex> alphas;
  Eigen::Index at = 0;
  for (const Complex alpha : like) {
    const double real = std::exp(x[at++]);
    alphas.emplace_back(real, alpha.imag() != 0.0 ? std::exp(x[at++]) : 0.0);
  }
  return alphas;
}

/// All rates moved to where the equation leaves least (the weights are linear: Golub, Pereyra 1973).
std::vector<Complex> refined_rates(const Spectral& data, const std::vector<Complex>& alphas) {
  const auto residuals = [&](const VectorXd& x) -> std::optional<VectorXd> {
    const VectorXcd left = fit_equation(data, rates_of(x, alphas)).left;
    VectorXd parts(2 * left.size());
    parts << left.real(), left.imag();
    return parts;
  };
  const VectorXd start = logarithms(alphas);
  LeastSquaresProblem problem{.residuals = residuals};
  for (const double x : start) problem.bounds.emplace_back(x - 2.0, x + 2.0);
  const LeastSquaresResult found =
      minimise(problem, start, {.maximum_iterations = 20, .tolerance = 1e-4, .cost_tolerance = 1e-6});
  return rates_of(found.x, alphas);
}

std::vector<Complex> candidates(const ExcitedRange& range, TermKind kind) {
  std::vector<Complex> result;
  const double reach = kind == TermKind::pair ? 1.5 : 4.0;
  const double low = 2.0 * std::numbers::pi * range.low / reach, high = 2.0 * std::numbers::pi * range.high * reach;
  for (int i = 0; i < n_rates; ++i) {
    const double rate = low * std::pow(high / low, i / (n_rates - 1.0));
    if (kind == TermKind::real) {
      result.emplace_back(rate);
      continue;
    }
    for (const double decay : decay_ratios) result.emplace_back(decay * rate, rate);
  }
  return result;
}

/// Real terms keep the dissipative sign.
MassMaterial model_of(const EquationFit& fit, std::span<const Complex> alphas, MassMaterial model) {
  Eigen::Index at = 0;
  model.damping = fit.x[at++];
  for (double& k : model.stiffness) k = fit.x[at++];
  // f = k(z) counts as z here, up to the factor k_1.
  const double scale = model.forcing == KernelForcing::stiffness ? 1.0 / model.stiffness[0] : 1.0;
  model.kernel.clear();
  for (const Complex alpha : alphas) {
    const double real = scale * fit.x[at++];
    const bool pair = alpha.imag() != 0.0;
    model.kernel.push_back(
        {alpha, pair ? Complex(real, scale * fit.x[at++]) : Complex(dissipative_sign(model.forcing) * std::abs(real))});
  }
  return model;
}

}  // namespace

std::optional<AddedTerm> with_added_term(std::span<const VibrationRecord> records, const MassMaterial& model,
                                         TermKind kind, const IdentificationSettings& settings) {
  const Spectral data = joined(records, model, settings);
  std::vector<Complex> alphas, best;
  for (const HereditaryTerm& term : model.kernel) alphas.push_back(term.alpha);
  alphas.emplace_back();
  double least = std::numeric_limits<double>::infinity();
  for (const Complex alpha : candidates(excited_range(records), kind)) {
    alphas.back() = alpha;
    const EquationFit fit = fit_equation(data, alphas);
    if (!(fit.left.norm() < least && fit.x[1] > 0.0)) continue;
    least = fit.left.norm();
    best = alphas;
  }
  if (best.empty()) return std::nullopt;
  best = refined_rates(data, best);
  const EquationFit fit = fit_equation(data, best);
  if (!(fit.x[1] > 0.0)) return std::nullopt;
  return AddedTerm{.model = model_of(fit, best, model), .left = fit.left.norm()};
}

}  // namespace pfdm
