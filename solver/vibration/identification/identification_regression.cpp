#include "solver/vibration/identification/identification_regression.h"

#include "solver/linear/dense_algebra.h"
#include "solver/parallel.h"
#include "solver/vibration/identification/identification_conditioning.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int n_candidates = 24;  // rates that kernel terms are chosen from

/// Spectrum of f. For f = k(z) that of z: the linear part of k, up to the factor k1.
const VectorXcd& forcing_spectrum(const PreparedRecord& p, KernelForcing forcing, const VectorXcd& shaped) {
  switch (forcing) {
    case KernelForcing::displacement:
    case KernelForcing::stiffness: return p.powers.front();
    case KernelForcing::damping: return shaped;
    default: return p.velocity;
  }
}

double relative_misfit(const RecordSystem& s, const VectorXd& p) { return (s.A * p - s.q).norm() / s.q.norm(); }

/// Least of misfit(lambda) on [0, 4] within a tolerance: a grid, then golden sections about its best point.
double best_exponent(const std::function<double(double)>& misfit, double tolerance) {
  constexpr double step = 0.4;
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 10; ++i)
    if (const double m = misfit(step * i); m < least) {
      least = m;
      best = step * i;
    }
  double a = std::max(best - step, 0.0);
  double b = best + step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = b - golden * (b - a), right = a + golden * (b - a);
  double at_left = misfit(left), at_right = misfit(right);
  while (b - a > tolerance) {
    if (at_left < at_right) {
      b = std::exchange(right, left);
      at_right = at_left;
      left = b - golden * (b - a);
      at_left = misfit(left);
    } else {
      a = std::exchange(left, right);
      at_left = at_right;
      right = a + golden * (b - a);
      at_right = misfit(right);
    }
  }
  return 0.5 * (a + b);
}

MassMaterial bare_model(const ModelStructure& structure, double lambda, const IdentificationSettings& settings) {
  return {.mass = settings.mass,
          .damping_exponent = lambda,
          .reference_velocity = settings.reference_velocity,
          .forcing = structure.forcing};
}

/// [damping, z ... z^N], and -m (z'' + y'').
std::pair<std::vector<VectorXd>, VectorXd> plain_columns(const PreparedRecord& p, const VectorXcd& shaped) {
  std::vector<VectorXd> a{p.condition.samples(shaped)};
  for (const VectorXcd& power : p.powers) a.push_back(p.condition.samples(power));
  return {std::move(a), p.condition.samples(p.force)};
}

Regression plain_fit(std::span<const PreparedRecord> prepared, const ModelStructure& structure, double lambda,
                     const IdentificationSettings& settings) {
  const RecordSystem s = assemble(prepared, [&](const PreparedRecord& p) {
    return plain_columns(p, shaped_velocity(p, lambda, settings.reference_velocity));
  });
  const VectorXd x = scaled_least_squares(s.A, s.q);
  Regression result{.model = bare_model(structure, lambda, settings), .misfit = relative_misfit(s, x)};
  result.model.damping = x[0];
  result.model.stiffness.assign(x.data() + 1, x.data() + x.size());
  return result;
}

VectorXcd derivative(const PreparedRecord& p, VectorXcd spectrum) {
  for (Eigen::Index k = 0; k < spectrum.size(); ++k) spectrum[k] *= Complex(0.0, p.condition.omega()[k]);
  return spectrum;
}

/// One kernel term: v' + alpha v = beta f with v = q - c d - k(z) (A12, A13 in A11) gives
///   q' = -alpha q + c d' + sum k_i (z^i)' + alpha c d + sum alpha k_i z^i + beta f,
/// linear in alpha and products of the parameters. For f = z or z' and linear stiffness it is A14.
Regression third_order_fit(std::span<const PreparedRecord> prepared, const ModelStructure& structure, double lambda,
                           const IdentificationSettings& settings) {
  const bool linear_damping = lambda == 0.0;
  const RecordSystem s = assemble(prepared, [&](const PreparedRecord& p) {
    const VectorXcd shaped = shaped_velocity(p, lambda, settings.reference_velocity);
    std::vector<VectorXd> a{p.condition.samples(-p.force), p.condition.samples(derivative(p, shaped))};
    for (const VectorXcd& power : p.powers) a.push_back(p.condition.samples(derivative(p, power)));
    for (const VectorXcd& power : p.powers) a.push_back(p.condition.samples(power));
    // z' is the column of (z)' already; z'|z'|^lambda is one more.
    if (!linear_damping) a.push_back(p.condition.samples(shaped));
    return std::pair{std::move(a), p.condition.samples(derivative(p, p.force))};
  });
  const VectorXd x = scaled_least_squares(s.A, s.q);
  const auto n = static_cast<Eigen::Index>(structure.stiffness_order);
  Regression result{.model = bare_model(structure, lambda, settings), .misfit = relative_misfit(s, x)};
  MassMaterial& m = result.model;
  const double alpha = x[0];
  const double c = x[1];
  double k1 = x[2] - (linear_damping ? alpha * c : 0.0);  // the column z' holds k1 + alpha c, + beta if f = z'
  double beta = 0.0;
  if (structure.forcing == KernelForcing::velocity) {
    k1 = x[2 + n] / alpha;
    beta = x[2] - k1 - (linear_damping ? alpha * c : 0.0);
  } else if (structure.forcing == KernelForcing::damping) {
    beta = x[2 + 2 * n] - alpha * c;
  } else {
    beta = x[2 + n] - alpha * k1;  // the column z holds alpha k1 + beta for f = z, (alpha + beta) k1 for k(z)
    if (structure.forcing == KernelForcing::stiffness) beta /= k1;
  }
  m.damping = c;
  m.stiffness.assign(x.data() + 2, x.data() + 2 + n);
  m.stiffness.front() = k1;
  m.kernel.push_back({alpha, beta});
  return result;
}

/// Upper triangle of the QR decomposition of [A q], columns of A brought to norm 1: any subset of the columns can be
/// fitted from it alone.
struct Reduced {
  MatrixXd R;
  VectorXd norms;
  double total = 0.0;
};

Reduced reduce(const RecordSystem& s) {
  Reduced r;
  r.norms = s.A.colwise().norm().cwiseMax(1e-300);
  MatrixXd all(s.A.rows(), s.A.cols() + 1);
  all.leftCols(s.A.cols()) = s.A * r.norms.cwiseInverse().asDiagonal();
  all.rightCols(1) = s.q;
  r.total = s.q.norm();
  r.R = upper_triangle(all);
  return r;
}

struct SubsetFit {
  VectorXd x;
  double misfit = std::numeric_limits<double>::infinity();
};

SubsetFit fit_subset(const Reduced& r, const std::vector<Eigen::Index>& columns) {
  MatrixXd A(r.R.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) A.col(i) = r.R.col(columns[i]);
  const VectorXd q = r.R.rightCols(1);
  SubsetFit fit;
  fit.x = least_squares(A, q);
  fit.misfit = (A * fit.x - q).norm() / r.total;
  for (std::size_t i = 0; i < columns.size(); ++i) fit.x[i] /= r.norms[columns[i]];
  return fit;
}

/// All increasing choices of `order` numbers below n.
void for_each_choice(int n, int order, const std::function<void(const std::vector<int>&)>& visit) {
  std::vector<int> choice(order);
  const std::function<void(int, int)> choose = [&](int depth, int from) {
    if (depth == order) return visit(choice);
    for (int i = from; i < n; ++i) {
      choice[depth] = i;
      choose(depth + 1, i + 1);
    }
  };
  choose(0, 0);
}

/// Rates from well below to well above what is excited; beyond, a term cannot be distinguished from stiffness or
/// damping.
VectorXd candidate_rates(std::span<const PreparedRecord> prepared) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const PreparedRecord& p : prepared) {
    low = std::min(low, p.low);
    high = std::max(high, p.high);
  }
  const double first = std::log(2.0 * std::numbers::pi * low / 4.0);
  const double last = std::log(2.0 * std::numbers::pi * high * 4.0);
  return VectorXd::LinSpaced(n_candidates, first, last).array().exp();
}

RecordSystem candidate_system(std::span<const PreparedRecord> prepared, const ModelStructure& structure, double lambda,
                              const VectorXd& rates, double reference_velocity) {
  return assemble(prepared, [&](const PreparedRecord& p) {
    const VectorXcd shaped = shaped_velocity(p, lambda, reference_velocity);
    auto columns = plain_columns(p, shaped);
    const VectorXcd& f = forcing_spectrum(p, structure.forcing, shaped);
    for (const double alpha : rates) {
      VectorXcd filtered = f;
      for (Eigen::Index k = 0; k < filtered.size(); ++k) filtered[k] /= Complex(alpha, p.condition.omega()[k]);
      columns.first.push_back(p.condition.samples(filtered));
    }
    return columns;
  });
}

/// The best `order` of the candidate rates whose terms all dissipate.
std::optional<Regression> choose_terms(const Reduced& reduced, const VectorXd& rates, const ModelStructure& structure,
                                       int order, double lambda, const IdentificationSettings& settings) {
  const Eigen::Index n_plain = 1 + structure.stiffness_order;
  const double sign = dissipative_sign(structure.forcing);
  SubsetFit best;
  std::vector<int> best_choice;
  for_each_choice(static_cast<int>(rates.size()), order, [&](const std::vector<int>& choice) {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index i = 0; i < n_plain; ++i) columns.push_back(i);
    for (const int i : choice) columns.push_back(n_plain + i);
    const SubsetFit fit = fit_subset(reduced, columns);
    if (fit.misfit >= best.misfit || !(fit.x[1] > 0.0)) return;
    if (order > 0 && !((sign * fit.x.tail(order).array()) > 0.0).all()) return;
    best = fit;
    best_choice = choice;
  });
  if (!std::isfinite(best.misfit)) return std::nullopt;
  Regression result{.model = bare_model(structure, lambda, settings), .misfit = best.misfit};
  result.model.damping = best.x[0];
  result.model.stiffness.assign(best.x.data() + 1, best.x.data() + n_plain);
  const double scale = structure.forcing == KernelForcing::stiffness ? 1.0 / result.model.stiffness.front() : 1.0;
  for (std::size_t i = 0; i < best_choice.size(); ++i)
    result.model.kernel.push_back({rates[best_choice[i]], scale * best.x[n_plain + i]});
  return result;
}

}  // namespace

Regression regress_states(std::span<const VibrationRecord> records, const ModelStructure& structure,
                          const IdentificationSettings& settings) {
  const std::vector<PreparedRecord> prepared = prepare_all(records, structure, settings);
  const bool kernel = structure.forcing != KernelForcing::none;
  const auto fit = [&](double lambda) {
    return kernel ? third_order_fit(prepared, structure, lambda, settings)
                  : plain_fit(prepared, structure, lambda, settings);
  };
  if (!structure.nonlinear_damping) return fit(0.0);
  return fit(best_exponent([&](double lambda) { return fit(lambda).misfit; }, 1e-3));
}

std::optional<Regression> regress_separable(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                            int kernel_order, const IdentificationSettings& settings) {
  const std::vector<PreparedRecord> prepared = prepare_all(records, structure, settings);
  const VectorXd rates = kernel_order > 0 ? candidate_rates(prepared) : VectorXd();
  const auto fit = [&](double lambda) {
    const Reduced reduced = reduce(candidate_system(prepared, structure, lambda, rates, settings.reference_velocity));
    return choose_terms(reduced, rates, structure, kernel_order, lambda, settings);
  };
  if (!structure.nonlinear_damping) return fit(0.0);
  // Where the output error starts; it need not be near.
  if (kernel_order == 0)
    return fit(best_exponent([&](double l) { return plain_fit(prepared, structure, l, settings).misfit; }, 0.05));
  std::optional<Regression> best;
  for (const double lambda : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
    auto tried = fit(lambda);
    if (tried && (!best || tried->misfit < best->misfit)) best = std::move(tried);
  }
  return best;
}

}  // namespace pfdm
