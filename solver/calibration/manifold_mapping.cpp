#include "solver/calibration/manifold_mapping.h"

#include "solver/calibration/calibration_scale.h"
#include "solver/calibration/held_parameter.h"
#include "solver/linear/dense_algebra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace pfdm {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

constexpr double told_apart = 0.1;    // singular values of differences of norm one, relative to the largest
constexpr double least_gain = 0.5;    // of the sum of squares, in units of FitSettings::cost_tolerance
constexpr double finest_gain = 1e-8;  // whatever the tolerance
constexpr double rough = 0.5;   // of the step of differences: what lies nearer differs by the unevenness of the curves
constexpr double nearby = 5.0;  // standard errors, up to which a difference is taken for a derivative
constexpr double longest_test = 0.2;   // of the logarithms of the parameters
constexpr double of_roughness = 0.02;  // of the sum of squares: what steps may promise in vain
constexpr int most_steps_back = 3;     // in succession
constexpr int points_a_parameter = 2, more_points = 4;

VectorXd as_vector(const std::vector<double>& v) { return VectorXd::Map(v.data(), std::ssize(v)); }

// The columns of A of norm one, and what makes an orthonormal basis of them.
struct Columns {
  explicit Columns(const MatrixXd& A) : matrix(A), svd(singular_values(A)) {
    while (rank < svd.values.size() && svd.values[rank] > told_apart * svd.values[0]) ++rank;
    basis = matrix * svd.V.leftCols(rank) * svd.values.head(rank).cwiseInverse().asDiagonal();
  }
  MatrixXd matrix;
  SingularValues svd;
  Eigen::Index rank = 0;
  MatrixXd basis;

  VectorXd without(const VectorXd& x) const { return x - basis * (basis.transpose() * x); }
};

// S of the header.
class Correction {
 public:
  Correction() = default;
  /// Differences of the fine and of the coarse residuals, (n, k), at the same points.
  Correction(MatrixXd fine, MatrixXd coarse) {
    for (Eigen::Index j = 0; j < coarse.cols(); ++j) {
      const double size = coarse.col(j).norm();
      coarse.col(j) /= size;
      fine.col(j) /= size;
    }
    coarse_.emplace(coarse);
    image_ = fine * coarse_->svd.V.leftCols(coarse_->rank) *
             coarse_->svd.values.head(coarse_->rank).cwiseInverse().asDiagonal();
    if (image_.norm() > 0.0) fine_.emplace(image_);
  }

  VectorXd operator()(const VectorXd& x) const {
    if (!coarse_) return x;
    const VectorXd rest = coarse_->without(x);
    return image_ * (coarse_->basis.transpose() * x) + (fine_ ? fine_->without(rest) : rest);
  }

 private:
  std::optional<Columns> coarse_, fine_;
  MatrixXd image_;  // of the basis of the coarse columns
};

MatrixXd side_by_side(const std::vector<VectorXd>& columns) {
  MatrixXd all(columns.front().size(), std::ssize(columns));
  for (std::size_t k = 0; k < columns.size(); ++k) all.col(k) = columns[k];
  return all;
}

double of_priors(const std::vector<FitParameter>& parameters, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t j = 0; j < parameters.size(); ++j) sum += prior_term(parameters[j], values[j]);
  return sum;
}

// The points that the fine model has been asked at, and the mapped model about the best of them.
class MappedModel {
 public:
  MappedModel(const FitProblem& fine, const CoarseModel& coarse, const FitSettings& settings)
      : fine_(fine), coarse_(coarse), scaled_(fine, settings), least_distance_(rough * settings.step) {}

  /// Whether the fine model has an answer there.
  bool ask(const std::vector<double>& values) {
    ++n_asked_;
    const auto residuals = fine_.residuals(values);
    const auto smooth = fine_.averaged ? fine_.averaged(values) : residuals;
    if (!residuals || !smooth) return false;
    asked_.push_back({values, as_vector(*residuals), as_vector(*smooth)});
    if (asked_.size() == 1 || sum(asked_.back()) < sum(asked_[best_])) best_ = asked_.size() - 1;
    return true;
  }
  bool last_is_best() const { return best_ + 1 == asked_.size(); }
  int n_asked() const { return n_asked_; }
  const std::vector<double>& best() const { return asked_[best_].values; }
  double least_sum() const { return sum(asked_[best_]); }
  const ScaledModel& scaled() const { return scaled_; }
  /// From the best point to those by which the fine model is known, (k, n), of scaled parameters.
  MatrixXd known_directions() const {
    std::vector<VectorXd> known;
    for (std::size_t k = 0; k < asked_.size(); ++k)
      if (!is_too_near(k)) known.emplace_back(scaled_.from(asked_[k].values) - scaled_.from(best()));
    return known.empty() ? MatrixXd(std::ssize(best()), 0) : side_by_side(known);
  }
  FitIteration iteration(std::size_t k) const {
    return {std::sqrt(asked_[k].residuals.squaredNorm() / static_cast<double>(asked_[k].residuals.size())),
            asked_[k].values};
  }
  std::size_t n_points() const { return asked_.size(); }

  /// Nothing where the coarse model has no answer at a point of the fine one.
  std::optional<FitProblem> problem() const {
    if (coarse_.meet) coarse_.meet(best());
    const Residuals& coarse = smooth_coarse();
    const auto at_best = coarse(best());
    if (!at_best) return std::nullopt;
    const VectorXd coarse_here = as_vector(*at_best), fine_here = asked_[best_].residuals;
    FitProblem mapped = coarse_.problem;
    mapped.jacobian = {};
    mapped.averaged = {};
    mapped.residuals = [=, coarse = coarse,
                        correction = std::make_shared<const Correction>(correction_about_best(coarse_here))](
                           std::span<const double> p) -> std::optional<std::vector<double>> {
      const auto c = coarse(p);
      if (!c) return std::nullopt;
      const VectorXd r = fine_here + (*correction)(as_vector(*c) - coarse_here);
      return std::vector<double>(r.begin(), r.end());
    };
    for (std::size_t j = 0; j < mapped.parameters.size(); ++j) mapped.parameters[j].start = best()[j];
    return mapped;
  }

 private:
  struct Asked {
    std::vector<double> values;
    VectorXd residuals, smooth;  // the latter as the problem has them averaged
  };
  const Residuals& smooth_coarse() const {
    return coarse_.problem.averaged ? coarse_.problem.averaged : coarse_.problem.residuals;
  }
  double sum(const Asked& asked) const {
    return asked.residuals.squaredNorm() + of_priors(fine_.parameters, asked.values);
  }
  /// By the latest points that are not too near, as many as there are parameters at most.
  Correction correction_about_best(const VectorXd& coarse_here) const {
    std::vector<VectorXd> fine, coarse;
    for (std::size_t k = asked_.size(); k-- > 0 && fine.size() < fine_.parameters.size();) {
      if (is_too_near(k)) continue;
      const auto there = smooth_coarse()(asked_[k].values);
      if (!there || as_vector(*there) == coarse_here) continue;
      fine.emplace_back(asked_[k].smooth - asked_[best_].smooth);
      coarse.emplace_back(as_vector(*there) - coarse_here);
    }
    return fine.empty() ? Correction() : Correction(side_by_side(fine), side_by_side(coarse));
  }
  bool is_too_near(std::size_t k) const { return scaled_.distance(asked_[k].values, best()) < least_distance_; }

  const FitProblem& fine_;
  const CoarseModel& coarse_;
  ScaledModel scaled_;
  double least_distance_;
  std::vector<Asked> asked_;
  std::size_t best_ = 0;
  int n_asked_ = 0;
};

// A step, in scaled parameters, of one standard error in the direction that the data determine least, of those that no
// difference of the fine model knows if there are such; not shorter than the step of differences.
VectorXd step_to_test(const MappedModel& model, const FitResult& result, double shortest) {
  MatrixXd J = result.derivatives;
  for (Eigen::Index j = 0; j < J.cols(); ++j) J.col(j) *= model.scaled().scale(static_cast<std::size_t>(j));
  const double noise = result.noise_is_known ? 1.0 : result.rms;
  const SingularValues svd = singular_values(J);
  const VectorXd sizes = svd.values.cwiseMax(noise / longest_test);
  // In coordinates in which the standard error is 1 in all directions.
  const MatrixXd known = 1.0 / noise * sizes.asDiagonal() * svd.V.transpose() * model.known_directions();
  std::vector<VectorXd> near;
  for (const VectorXd column : known.colwise())
    if (column.norm() < nearby) near.emplace_back(column.normalized());
  MatrixXd unknown = MatrixXd::Identity(J.cols(), J.cols());
  if (!near.empty()) {
    const Columns columns(side_by_side(near));
    if (columns.rank < J.cols()) unknown -= columns.basis * columns.basis.transpose();
  }
  const MatrixXd steps = noise * svd.V * sizes.cwiseInverse().asDiagonal() * unknown;
  const VectorXd step = steps * singular_values(steps).V.col(0);
  return step * (std::clamp(step.norm(), shortest, longest_test) / step.norm());
}

// One descent on the mapped model after the other, until none leads further down.
class Descent {
 public:
  Descent(const FitProblem& fine, const CoarseModel& coarse, const FitSettings& settings)
      : fine_(fine), coarse_(coarse), settings_(settings), model_(fine, coarse, settings) {
    further_.cost_tolerance *= 0.1;
    further_.ends_on_grid = true;
    further_.iterated = {};
  }

  MappedFit run() {
    first_ = coarse_.fitted ? *coarse_.fitted : fit(coarse_.problem, on_grid(settings_));
    if (!model_.ask(first_.values())) return failed("the fine model does not converge where the coarse one fits best");
    tell();
    while (true) {
      std::optional<FitProblem> mapped = model_.problem();
      if (!mapped) return failed("the coarse model does not converge where the fine one does");
      const FitResult next = fit(*mapped, further_);
      if (leads_down(next)) {
        if (is_exhausted())
          return failed(fmt::format("no minimum after {} points of the fine model", model_.n_asked()));
        if (step_to(next.values())) continue;
        if (next.sum_of_squares < (1.0 - of_roughness) * model_.least_sum())
          return failed("what it gains the fine model does not");
        return done(std::move(*mapped));
      }
      if (!has_moved_ || !test(next)) return done(std::move(*mapped));
    }
  }

 private:
  bool leads_down(const FitResult& next) const {
    const double sum = next.sum_of_squares + of_priors(fine_.parameters, next.values());
    return sum < (1.0 - std::max(finest_gain, least_gain * settings_.cost_tolerance)) * model_.least_sum() &&
           model_.scaled().distance(next.values(), model_.best()) > settings_.least_step;
  }
  bool is_exhausted() const {
    return model_.n_asked() >= points_a_parameter * static_cast<int>(fine_.parameters.size()) + more_points;
  }
  /// False where one such step after the other has led up.
  bool step_to(const std::vector<double>& values) {
    if (model_.ask(values) && model_.last_is_best()) {
      n_back_ = 0;
      has_moved_ = true;
      tell();
      return true;
    }
    return ++n_back_ < most_steps_back;
  }
  /// Asks the fine model beside its best point. False if that tells nothing new.
  bool test(const FitResult& result) {
    has_moved_ = false;
    const VectorXd step = step_to_test(model_, result, settings_.step);
    for (const double sign : {1.0, -1.0}) {
      const auto point = model_.scaled().within_bounds(model_.scaled().from(model_.best()) + sign * step);
      if (point && model_.ask(*point)) return true;
    }
    return false;
  }
  void tell() const {
    if (settings_.iterated) settings_.iterated(model_.iteration(model_.n_points() - 1));
  }

  MappedFit failed(std::string why) const {
    MappedFit fit{.result = {}, .mapped = {}, .failure = std::move(why), .best = {}};
    if (model_.n_points() > 0) fit.best = model_.best();
    return fit;
  }
  MappedFit done(FitProblem mapped) const {
    FitSettings here = further_;
    here.maximum_iterations = 0;
    here.ends_on_grid = false;
    MappedFit found{.result = fit(mapped, here), .mapped = {}, .failure = {}, .best = model_.best()};
    found.mapped = std::move(mapped);
    found.result.converged = true;
    found.result.message = fmt::format("no lower residuals of the fine model, after {} evaluations", model_.n_asked());
    found.result.evaluations = model_.n_asked();
    found.result.starts = first_.starts;
    found.result.screened = first_.screened;
    found.result.path.clear();
    for (std::size_t k = 0; k < model_.n_points(); ++k) found.result.path.push_back(model_.iteration(k));
    return found;
  }

  const FitProblem& fine_;
  const CoarseModel& coarse_;
  const FitSettings& settings_;
  FitSettings further_ = from_one_start(settings_);
  MappedModel model_;
  FitResult first_;
  bool has_moved_ = true;  // since the last test
  int n_back_ = 0;
};

}  // namespace

MappedFit fit_by_mapping(const FitProblem& fine, const CoarseModel& coarse, const FitSettings& settings) {
  return Descent(fine, coarse, settings).run();
}

}  // namespace pfdm
