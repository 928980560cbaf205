#include "solver/vibration/identification/identification_initial_motion.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/signals/signals_fourier.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the motion that the record has on the whole.
InitialMotion usual_motion(const MassMaterial& model, const VibrationRecord& record) {
  const double acceleration = record.relative.norm() / std::sqrt(static_cast<double>(record.n()));
  const double omega = std::sqrt(std::abs(model.stiffness.front()) / model.mass);
  return {.displacement = acceleration / (omega * omega), .velocity = acceleration / omega};
}

/// Responses of one model to a record, from any initial motion.
class BegunResponses {
 public:
  BegunResponses(const MassMaterial& model, const VibrationRecord& record, double crop)
      : model_(model),
        base_(nodes_of(driving_base(record).acceleration, record.rate, substeps_for(model, record.rate))),
        condition_(output_condition(record, crop)),
        measured_(condition_(record.relative)),
        usual_(usual_motion(model, record)) {}

  /// The conditioned response, and its derivatives by the initial motion in units of the usual one.
  struct Linear {
    VectorXd response;
    MatrixXd slopes;  // (n, 2)
    bool is_bounded() const { return response.allFinite() && slopes.allFinite(); }
  };
  Linear about(const InitialMotion& start) const {
    constexpr double h = 1e-3;
    const std::array<InitialMotion, 3> starts{start,
                                              {start.displacement + h * usual_.displacement, start.velocity},
                                              {start.displacement, start.velocity + h * usual_.velocity}};
    const MatrixXd z = simulate_starts(model_, base_, starts);
    Linear linear{.response = condition_(z.col(0)), .slopes = MatrixXd(measured_.size(), 2)};
    for (Eigen::Index i = 0; i < 2; ++i) linear.slopes.col(i) = (condition_(z.col(i + 1)) - linear.response) / h;
    return linear;
  }

  InitialMotion moved(const InitialMotion& start, const VectorXd& step) const {
    return {.displacement = start.displacement + step[0] * usual_.displacement,
            .velocity = start.velocity + step[1] * usual_.velocity};
  }
  const VectorXd& measured() const { return measured_; }
  const InitialMotion& usual() const { return usual_; }

 private:
  const MassMaterial& model_;
  BaseNodes base_;
  Conditioner condition_;
  VectorXd measured_;
  InitialMotion usual_;
};

/// Whether an initial motion that takes off so much of the squares is more than chance and worth the while.
bool is_significant(double before, double after, const VectorXd& measured) {
  constexpr double least_part = 0.1, least_ratio = 30.0, least_response = 1e-3;
  const double gain = before - after, n = static_cast<double>(measured.size());
  return gain > least_part * before && gain > least_ratio * 2.0 * after / (n - 2.0) &&
         gain > least_response * least_response * measured.squaredNorm();
}

}  // namespace

MatrixXd free_motions(const MassMaterial& model, const VibrationRecord& record, double crop) {
  const BegunResponses responses(model, record, crop);
  MatrixXd slopes = responses.about(record.start).slopes;
  slopes.col(0) /= responses.usual().displacement;
  slopes.col(1) /= responses.usual().velocity;
  return slopes;
}

MatrixXd orthonormal(const MatrixXd& A) {
  constexpr double dependent = 1e-9;
  MatrixXd Q(A.rows(), 0);
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    VectorXd column = A.col(k).normalized();
    for (int twice = 0; twice < 2; ++twice) column -= (Q * (Q.transpose() * column)).eval();
    if (!(column.norm() > dependent)) continue;
    Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
    Q.col(Q.cols() - 1) = column.normalized();
  }
  return Q;
}

std::optional<InitialMotion> begun_motion(const MassMaterial& model, const VibrationRecord& record, double crop) {
  constexpr int most_steps = 6;  // one is enough of a linear model
  constexpr double settled = 1e-10;
  const BegunResponses responses(model, record, crop);
  const VectorXd& measured = responses.measured();
  InitialMotion start;
  double before = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    const auto linear = responses.about(start);
    if (!linear.is_bounded()) return std::nullopt;
    const VectorXd left = measured - linear.response;
    if (i == 0) before = left.squaredNorm();
    const VectorXd step = scaled_least_squares(linear.slopes, left);
    const double after = (left - linear.slopes * step).squaredNorm();
    if (i == 0 && !is_significant(before, after, measured)) return std::nullopt;
    start = responses.moved(start, step);
    if (left.squaredNorm() - after <= settled * after) break;
  }
  return start;
}

std::optional<MassMaterial> ringing_model(const VibrationRecord& record, double mass, double crop) {
  constexpr double quiet = 0.05, most_left = 0.5;
  if (!(record.base.norm() < quiet * record.relative.norm())) return std::nullopt;
  const VectorXd power = fourier(record.relative).cwiseAbs2();
  const double bin = record.rate / static_cast<double>(record.n());
  const auto first = static_cast<Eigen::Index>(std::ceil(record.band_low / bin));
  const Eigen::Index n = std::min(static_cast<Eigen::Index>(record.band_high / bin), power.size() - 1) - first + 1;
  if (n < 1) return std::nullopt;
  Eigen::Index strongest = 0;
  power.segment(first, n).maxCoeff(&strongest);
  const double omega = 2.0 * std::numbers::pi * bin * static_cast<double>(first + strongest);
  double least = most_left;
  std::optional<MassMaterial> nearest;
  for (const double ratio : {0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2}) {
    const MassMaterial model{.mass = mass, .stiffness = {mass * omega * omega}, .damping = 2.0 * ratio * mass * omega};
    const double left = prediction_misfit(model, record, crop);
    if (!(left < least)) continue;
    least = left;
    nearest = model;
  }
  return nearest;
}

double update_starts(std::span<VibrationRecord> records, const MassMaterial& model, double crop) {
  double largest = 0.0;
  for (VibrationRecord& record : records) {
    const InitialMotion start = begun_motion(model, record, crop).value_or(InitialMotion{});
    if (start.is_rest() && record.start.is_rest()) continue;
    const InitialMotion usual = usual_motion(model, record);
    const auto size = [&](double z, double v) { return std::hypot(z / usual.displacement, v / usual.velocity); };
    const double change = size(start.displacement - record.start.displacement, start.velocity - record.start.velocity);
    largest = std::max(largest, change / std::max(size(start.displacement, start.velocity),
                                                  size(record.start.displacement, record.start.velocity)));
    record.start = start;
  }
  return largest;
}

}  // namespace pfdm
