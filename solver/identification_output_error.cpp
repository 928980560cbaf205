// refine_output and prediction_misfit of identification.h.

#include "solver/identification.h"
#include "solver/identification_conditioning.h"
#include "solver/identification_least_squares.h"
#include "solver/mass_material_simulation.h"
#include "solver/parallel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace pfdm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What is compared: the excited band and three harmonics of it.
Conditioner output_condition(const VibrationRecord& r, double crop) {
  const PassBand band{.low = 0.5 * r.band_low, .high = std::min(3.0 * r.band_high, 0.38 * r.rate), .skirt = 0.2};
  return {r.n(), r.rate, band, crop};
}

constexpr double tracking_width = 5.0;  // [Hz]

/// How far a sample may rely on the tracker, whose filter needs signal on both sides: 0 at the ends of the record, 1
/// from four of its time constants on.
double reliance(Eigen::Index i, const VibrationRecord& r) {
  const double distance = static_cast<double>(std::min(i, r.n() - 1 - i)) / r.rate * tracking_width;
  const double part = std::clamp((distance - 1.0) / 3.0, 0.0, 1.0);
  return part * part * (3.0 - 2.0 * part);
}

/// The base's acceleration as what drives the model. Noise on it would come through the nonlinear terms as a bias. Of a
/// sweep everything is kept that moves with the driving frequency or its harmonics, within the tracking width; the rest
/// is noise. Where the rest is no small part there is no sweep, and where it is next to nothing (below -60 dB) there is
/// no noise: then the record is left as it is.
VectorXd tracked_base(const VibrationRecord& r) {
  const PassBand band{.low = 0.8 * r.band_low, .high = 1.2 * r.band_high};
  VectorXd tracked = tracked_sweep(r.base, r.rate, band, tracking_width);
  const Eigen::Index edge = r.n() / 4;  // the ends are not tracked well
  const Eigen::Index n = r.n() - 2 * edge;
  const double rest = (tracked - r.base).segment(edge, n).norm() / r.base.segment(edge, n).norm();
  if (rest < 1e-3 || rest > 0.1) return r.base;
  for (Eigen::Index i = 0; i < r.n(); ++i) {
    const double weight = reliance(i, r);
    tracked[i] = weight * tracked[i] + (1.0 - weight) * r.base[i];
  }
  return tracked;
}

/// Parameters of size one without bounds: logarithms of what must be positive (k1, c, |beta|), a sigmoid of what has
/// two bounds (lambda; the logarithm of alpha), k_i relative to k1 at the displacement that occurs.
class Coordinates {
 public:
  Coordinates(const MassMaterial& start, double displacement, double low, double high)
      : terms_(start),
        displacement_(displacement),
        log_low_(std::log(2.0 * std::numbers::pi * low / 10.0)),
        log_high_(std::log(2.0 * std::numbers::pi * high * 10.0)) {}

  VectorXd from(const MassMaterial& m) const {
    std::vector<double> x{std::log(m.stiffness[0])};
    for (std::size_t i = 1; i < m.stiffness.size(); ++i)
      x.push_back(m.stiffness[i] * std::pow(displacement_, i) / m.stiffness[0]);
    x.push_back(std::log(std::max(m.damping, 1e-4 * std::sqrt(m.stiffness[0] * m.mass))));
    if (free_exponent()) x.push_back(inverse_sigmoid(m.damping_exponent / most_exponent));
    for (const HereditaryTerm& term : m.kernel) {
      x.push_back(std::log(std::abs(term.beta.real())));
      x.push_back(inverse_sigmoid((std::log(term.alpha.real()) - log_low_) / (log_high_ - log_low_)));
    }
    return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
  }

  MassMaterial model(const VectorXd& x) const {
    MassMaterial m = terms_;
    Index at = 0;
    m.stiffness[0] = std::exp(x[at++]);
    for (std::size_t i = 1; i < m.stiffness.size(); ++i)
      m.stiffness[i] = x[at++] * m.stiffness[0] / std::pow(displacement_, i);
    m.damping = std::exp(x[at++]);
    if (free_exponent()) m.damping_exponent = most_exponent * sigmoid(x[at++]);
    const double sign = dissipative_sign(m.forcing);
    for (HereditaryTerm& term : m.kernel) {
      term.beta = sign * std::exp(x[at++]);
      term.alpha = std::exp(log_low_ + (log_high_ - log_low_) * sigmoid(x[at++]));
    }
    return m;
  }

 private:
  static constexpr double most_exponent = 4.0;
  static double sigmoid(double x) { return 1.0 / (1.0 + std::exp(-x)); }
  static double inverse_sigmoid(double y) {
    const double inside = std::clamp(y, 1e-3, 1.0 - 1e-3);
    return std::log(inside / (1.0 - inside));
  }
  bool free_exponent() const { return terms_.damping_exponent != 0.0; }

  MassMaterial terms_;
  double displacement_;
  double log_low_;
  double log_high_;
};

/// All records: measured output, what drives, and where each one's residuals stand.
class OutputError {
 public:
  OutputError(std::span<const VibrationRecord> records, const MassMaterial& start, double crop)
      : coordinates_(start, largest_displacement(records), lowest(records), highest(records)) {
    int substeps = 1;
    for (const VibrationRecord& r : records) substeps = std::max(substeps, substeps_for(start, r.rate));
    for (const VibrationRecord& r : records) {
      Output out{
          .condition = output_condition(r, crop), .base = nodes_of(tracked_base(r), r.rate, substeps), .measured = {}};
      out.measured = out.condition(r.relative);
      out.weight = std::sqrt(static_cast<double>(out.measured.size())) / out.measured.norm();
      out.first = n_residuals_;
      n_residuals_ += out.measured.size();
      outputs_.push_back(std::move(out));
    }
  }

  const Coordinates& coordinates() const { return coordinates_; }
  Index n_residuals() const { return n_residuals_; }

  /// Weighted conditioned responses of the models, a column each; NaN where one runs away.
  MatrixXd responses(const std::vector<MassMaterial>& models) const {
    constexpr std::size_t together = 8;  // of the simulation
    const std::size_t groups = (models.size() + together - 1) / together;
    MatrixXd result(n_residuals_, static_cast<Index>(models.size()));
    const auto n_tasks = static_cast<pfdm::Index>(groups * outputs_.size());
    parallel_chunks(
        n_tasks,
        [&](pfdm::Index begin, pfdm::Index) {
          const Output& out = outputs_[static_cast<std::size_t>(begin) / groups];
          const std::size_t first = static_cast<std::size_t>(begin) % groups * together;
          const std::span part = std::span(models).subspan(first, std::min(together, models.size() - first));
          const MatrixXd z = simulate_batch(part, out.base);
          for (Index k = 0; k < z.cols(); ++k) {
            auto to = result.col(static_cast<Index>(first) + k).segment(out.first, out.measured.size());
            if (z.col(k).allFinite())
              to = out.weight * out.condition(z.col(k));
            else
              to.setConstant(std::numeric_limits<double>::quiet_NaN());
          }
        },
        1);
    return result;
  }

  VectorXd residuals(const VectorXd& response) const {
    VectorXd r = response;
    for (const Output& out : outputs_) r.segment(out.first, out.measured.size()) -= out.weight * out.measured;
    return r;
  }

  MatrixXd jacobian(const VectorXd& x) const {
    constexpr double h = 1e-6;
    std::vector<MassMaterial> models{coordinates_.model(x)};
    for (Index k = 0; k < x.size(); ++k) {
      VectorXd moved = x;
      moved[k] += h;
      models.push_back(coordinates_.model(moved));
    }
    const MatrixXd y = responses(models);
    return (y.rightCols(x.size()).colwise() - y.col(0)) / h;
  }

  /// Norm of the residuals of each record over that of its measured output.
  std::vector<double> misfits(const VectorXd& r) const {
    std::vector<double> result;
    for (const Output& out : outputs_)
      result.push_back(r.segment(out.first, out.measured.size()).norm() /
                       std::sqrt(static_cast<double>(out.measured.size())));
    return result;
  }

  /// First and last residual of blocks, within a record each, longer than what residuals have in common: some periods,
  /// and what is left of the noise within the tracking width.
  std::vector<std::pair<Index, Index>> blocks() const {
    std::vector<std::pair<Index, Index>> result;
    for (const Output& out : outputs_) {
      const Index n = out.measured.size();
      const double length = std::max(200.0, 1.5 * out.condition.rate() / tracking_width);
      const auto count = std::clamp<Index>(static_cast<Index>(static_cast<double>(n) / length), 1, 600);
      for (Index i = 0; i < count; ++i) result.emplace_back(out.first + n * i / count, out.first + n * (i + 1) / count);
    }
    return result;
  }

 private:
  struct Output {
    Conditioner condition;
    BaseNodes base;
    VectorXd measured;
    double weight = 1.0;
    Index first = 0;
  };

  static double largest_displacement(std::span<const VibrationRecord> records) {
    double z = 0.0;
    for (const VibrationRecord& r : records) {
      const VectorXd all = integrate_states(r).displacement;
      const Index edge = all.size() / 20;
      z = std::max(z, all.segment(edge, all.size() - 2 * edge).lpNorm<Eigen::Infinity>());
    }
    return z;
  }
  static double lowest(std::span<const VibrationRecord> records) {
    return std::ranges::min_element(records, {}, &VibrationRecord::band_low)->band_low;
  }
  static double highest(std::span<const VibrationRecord> records) {
    return std::ranges::max_element(records, {}, &VibrationRecord::band_high)->band_high;
  }

  Coordinates coordinates_;
  std::vector<Output> outputs_;
  Index n_residuals_ = 0;
};

/// A regression may overshoot what holds the mass: softer in its nonlinear part, it starts from somewhere.
VectorXd bounded_start(const OutputError& error, MassMaterial start) {
  for (int i = 0; i < 8; ++i) {
    const VectorXd x = error.coordinates().from(start);
    if (error.responses({error.coordinates().model(x)}).allFinite()) return x;
    for (std::size_t k = 1; k < start.stiffness.size(); ++k) start.stiffness[k] *= i < 6 ? 0.5 : 0.0;
  }
  return error.coordinates().from(start);
}

/// Replicates of the parameters: blocks of residuals drawn with replacement, one Gauss-Newton step from the estimate
/// for each draw. Blocks keep what neighbouring residuals have in common; white-noise intervals would be several times
/// too narrow because the residuals are band-limited.
MatrixXd bootstrap(const OutputError& error, const VectorXd& x, const VectorXd& r, const MatrixXd& J,
                   const IdentificationSettings& settings) {
  const auto blocks = error.blocks();
  const Index p = x.size();
  std::vector<MatrixXd> normal;
  std::vector<VectorXd> gradient;
  for (const auto& [begin, end] : blocks) {
    const auto part = J.middleRows(begin, end - begin);
    normal.emplace_back(part.transpose() * part);
    gradient.emplace_back(part.transpose() * r.segment(begin, end - begin));
  }
  std::mt19937_64 engine(settings.seed);
  MatrixXd replicates(p, settings.replicates);
  for (int i = 0; i < settings.replicates; ++i) {
    MatrixXd A = MatrixXd::Zero(p, p);
    VectorXd g = VectorXd::Zero(p);
    for (std::size_t draw = 0; draw < blocks.size(); ++draw) {
      const std::size_t k = engine() % blocks.size();
      A += normal[k];
      g += gradient[k];
    }
    A.diagonal().array() += 1e-14 * A.diagonal().maxCoeff();
    replicates.col(i) = x - A.ldlt().solve(g);
  }
  return replicates;
}

/// Percentiles of the replicates of each value, and their correlations.
void set_intervals(OutputErrorFit& fit, const Coordinates& coordinates, const MatrixXd& replicates,
                   const IdentificationSettings& settings) {
  const auto n = static_cast<Index>(fit.estimates.size());
  MatrixXd values(n, replicates.cols());
  for (Index i = 0; i < replicates.cols(); ++i) {
    const auto named = named_values(coordinates.model(replicates.col(i)));
    for (Index k = 0; k < n; ++k) values(k, i) = named[static_cast<std::size_t>(k)].value;
  }
  for (Index k = 0; k < n; ++k) {
    VectorXd sorted = values.row(k);
    std::ranges::sort(sorted);
    const auto at = [&](double part) {
      return sorted[static_cast<Index>(std::lround(part * static_cast<double>(sorted.size() - 1)))];
    };
    fit.estimates[static_cast<std::size_t>(k)].lower = at(0.5 - 0.5 * settings.confidence);
    fit.estimates[static_cast<std::size_t>(k)].upper = at(0.5 + 0.5 * settings.confidence);
  }
  const MatrixXd centred = values.colwise() - values.rowwise().mean();
  const VectorXd norms = centred.rowwise().norm().cwiseMax(1e-300);
  fit.correlation =
      norms.cwiseInverse().asDiagonal() * (centred * centred.transpose()) * norms.cwiseInverse().asDiagonal();
}

/// The fastest term first would be as good: a convention, so that estimates can be compared.
void sort_terms(MassMaterial& m) {
  std::ranges::sort(m.kernel, {}, [](const HereditaryTerm& term) { return term.alpha.real(); });
}

}  // namespace

OutputErrorFit refine_output(std::span<const VibrationRecord> records, const MassMaterial& start,
                             const IdentificationSettings& settings) {
  MassMaterial sorted = start;
  sort_terms(sorted);
  const OutputError error(records, sorted, settings.crop);
  LeastSquaresProblem problem;
  problem.n_residuals = error.n_residuals();
  const VectorXd x0 = bounded_start(error, sorted);
  problem.n_parameters = x0.size();
  problem.residuals = [&](const VectorXd& x, VectorXd& r) {
    r = error.residuals(error.responses({error.coordinates().model(x)}).col(0));
  };
  problem.jacobian = [&](const VectorXd& x, MatrixXd& J) { J = error.jacobian(x); };
  const LeastSquaresResult found = minimise(problem, x0);

  OutputErrorFit fit;
  fit.converged = found.converged;
  fit.model = error.coordinates().model(found.parameters);
  fit.estimates = named_values(fit.model);
  const double n = static_cast<double>(error.n_residuals());
  for (const double norm : found.path) fit.path.push_back(norm / std::sqrt(n));
  VectorXd r(error.n_residuals());
  problem.residuals(found.parameters, r);
  if (!r.allFinite()) return fit;
  fit.record_misfit = error.misfits(r);
  fit.bic = n * std::log(r.squaredNorm() / n) + static_cast<double>(x0.size()) * std::log(n);
  if (settings.replicates > 1)
    set_intervals(fit, error.coordinates(),
                  bootstrap(error, found.parameters, r, error.jacobian(found.parameters), settings), settings);
  return fit;
}

VectorXd predicted_response(const MassMaterial& model, const VibrationRecord& record) {
  const BaseNodes base = nodes_of(record.base, record.rate, substeps_for(model, record.rate));
  return simulate_batch(std::span(&model, 1), base).col(0);
}

double prediction_misfit(const MassMaterial& model, const VibrationRecord& record, double crop) {
  const Conditioner condition = output_condition(record, crop);
  const VectorXd z = predicted_response(model, record);
  if (!z.allFinite()) return std::numeric_limits<double>::infinity();
  const VectorXd measured = condition(record.relative);
  return (condition(z) - measured).norm() / measured.norm();
}

}  // namespace pfdm
