#include "postproc/displacements/field_residuals.h"

#include "postproc/displacements/chi_square.h"
#include "postproc/displacements/field_outliers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double surely = 3.5;       // standard normal: a chance of 2e-4 for each size
constexpr double fewest_sums = 8.0;  // that tell a variance
constexpr double long_range = 2.0;   // variance over that of parts a quarter as wide, beyond what chance makes of it

/// What a small rigid motion does to places: shifts, and rotations about their mean.
MatrixXd motions(const MeasuredField& field, const FieldFrame& frame, const VectorXd& roots) {
  const auto n = std::ssize(frame.places);
  const Eigen::Index c = field.n_components;
  Vector middle = Vector::Zero();
  for (const Vector& p : frame.middle) middle += p / static_cast<double>(n);
  MatrixXd modes = MatrixXd::Zero(n * c, field.n_rigid());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector p = frame.middle[static_cast<std::size_t>(i)] - middle;
    const auto set = [&](Eigen::Index component, Eigen::Index mode, double value) {
      modes(component * n + i, mode) = roots[i] * value;
    };
    for (Eigen::Index k = 0; k < c; ++k) set(k, k, 1.0);
    set(0, c, -p[1]);
    set(1, c, p[0]);
    if (c < 3) continue;
    set(2, 4, p[0]);
    set(0, 4, -p[2]);
    set(2, 5, p[1]);
    set(1, 5, -p[2]);
  }
  for (Eigen::Index m = 0; m < modes.cols(); ++m)
    if (const double length = modes.col(m).norm(); length > 0.0) modes.col(m) /= length;
  return modes;
}

/// Side of the subsets over spacing of the points; at least 1.
double overlap_of(const MeasuredField& field) {
  return field.spacing > 0.0 ? std::max(1.0, field.subset / field.spacing) : 1.0;
}

}  // namespace

MatrixXd frame_difference(const MeasuredField& field, const FieldFrame& frame, const std::vector<double>& computed) {
  MatrixXd difference(std::ssize(frame.places), field.n_components);
  for (std::size_t i = 0; i < frame.places.size(); ++i) {
    const Vector u = Vector::Map(&computed[3 * frame.places[i]]);
    for (int k = 0; k < field.n_components; ++k)
      difference(static_cast<Eigen::Index>(i), k) = field.plane.axis(k).dot(u) - frame.u[i][k];
  }
  return difference;
}

MatrixXd measured_of(const MeasuredField& field, const FieldFrame& frame) {
  return frame_difference(field, frame, std::vector<double>(3 * (1 + std::ranges::max(frame.places)), 0.0)) * -1.0;
}

RigidMotion::RigidMotion(const MeasuredField& field, const FieldFrame& frame)
    : roots_(VectorXd::Map(frame.n_points.data(), std::ssize(frame.n_points)).cwiseSqrt()) {
  const Eigen::Index n = std::ssize(frame.places) * field.n_components, m = field.n_rigid();
  modes_.resize(n, m);
  if (m == 0) return;
  qr_.compute(motions(field, frame, roots_));
  modes_ = qr_.householderQ() * MatrixXd::Identity(n, m);
}

VectorXd RigidMotion::weighted(const MatrixXd& difference) const {
  const MatrixXd by_place = roots_.asDiagonal() * difference;
  return VectorXd::Map(by_place.data(), by_place.size());
}

VectorXd RigidMotion::reduced(const MatrixXd& difference) const {
  VectorXd e = weighted(difference);
  if (modes_.cols() == 0) return e;
  e.applyOnTheLeft(qr_.householderQ().adjoint());
  return e.tail(e.size() - modes_.cols());
}

MatrixXd RigidMotion::projected(const MatrixXd& difference) const {
  const VectorXd e = weighted(difference), left = e - modes_ * (modes_.transpose() * e);
  return roots_.cwiseInverse().asDiagonal() * MatrixXd::Map(left.data(), difference.rows(), difference.cols());
}

namespace {

/// Sums of weighted residuals over the squares of one size.
struct Sums {
  double found = 0.0;     ///< sum of their squares
  double expected = 0.0;  ///< of independent residuals with a variance of 1
  double n = 0.0;         ///< of independent ones
  /// Ratios above are by chance in 2e-4.
  double limit() const { return chi_square_over_mean(std::max(n, 1.0), surely); }
  double ratio(double variance) const { return expected > 0.0 ? found / (expected * variance) : 1.0; }
};

/// Of all frames of a field, whose weighted residuals are e.
struct FrameResiduals {
  const MeasuredField& field;
  const std::vector<std::size_t>& frames;
  std::vector<MatrixXd> e;      // (places, components)
  std::vector<MatrixXd> modes;  // of the rigid motion

  /// Part: square, component, and frame (alone) or 0.
  Sums over_squares(double side, bool over_frames) const {
    std::map<std::array<long, 4>, std::array<double, 2>> parts;  // sum of residuals, variance
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const FieldFrame& frame = field.frames[frames[f]];
      std::map<Square, std::vector<Eigen::Index>> squares;
      for (std::size_t i = 0; i < frame.middle.size(); ++i)
        squares[square_of(frame.middle[i], side)].push_back(static_cast<Eigen::Index>(i));
      for (const auto& [square, members] : squares)
        for (Eigen::Index k = 0; k < e[f].cols(); ++k) {
          double sum = 0.0;
          VectorXd by_modes = VectorXd::Zero(modes[f].cols());
          for (const Eigen::Index i : members) {
            sum += e[f](i, k);
            by_modes += modes[f].row(k * e[f].rows() + i).transpose();
          }
          auto& part = parts[{square.first, square.second, k, over_frames ? 0 : static_cast<long>(f)}];
          part[0] += sum;
          part[1] += static_cast<double>(members.size()) - by_modes.squaredNorm();
        }
    }
    Sums sums;
    double squares = 0.0;
    for (const auto& [where, part] : parts) {
      sums.found += part[0] * part[0];
      sums.expected += part[1];
      squares += part[1] * part[1];
    }
    if (squares > 0.0) sums.n = sums.expected * sums.expected / squares;  // as many of one size
    sums.n -= static_cast<double>(field.n_rigid()) * (over_frames ? 1.0 : static_cast<double>(frames.size()));
    return sums;
  }
};

/// Sides of squares, growing until there would be fewer than four of them.
std::vector<double> sides_of(const MeasuredField& field, const std::vector<std::size_t>& frames) {
  Vector low = Vector::Constant(1e300), high = -low;
  for (const std::size_t f : frames)
    for (const Vector& p : field.frames[f].middle) low = low.cwiseMin(p), high = high.cwiseMax(p);
  std::vector<double> sides;
  const double a = high[0] - low[0] + field.pitch, b = high[1] - low[1] + field.pitch;
  for (double side = 2.0 * field.pitch; side > 0.0; side *= std::sqrt(2.0)) {
    if (std::ceil(a / side) * std::ceil(b / side) < 4.0 || side > 0.51 * std::max(a, b)) break;
    sides.push_back(side);
  }
  return sides;
}

}  // namespace

FieldScatter scatter_of(const MeasuredField& field, const std::vector<std::size_t>& frames,
                        const std::vector<MatrixXd>& left, double taken) {
  FieldScatter scatter{.freedom = -taken};
  FrameResiduals residuals{field, frames, {}, {}};
  double squares = 0.0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const FieldFrame& frame = field.frames[frames[f]];
    const VectorXd roots = VectorXd::Map(frame.n_points.data(), std::ssize(frame.n_points)).cwiseSqrt();
    residuals.e.emplace_back(roots.asDiagonal() * left[f]);
    residuals.modes.push_back(RigidMotion(field, frame).modes());
    squares += residuals.e.back().squaredNorm();
    scatter.freedom += static_cast<double>(field.n_data(frame));
  }
  const double variance = squares / std::max(scatter.freedom, 1.0);
  scatter.deviation = std::sqrt(variance);
  if (!(variance > 0.0)) return scatter;
  for (const bool over_frames : {false, true}) {
    if (over_frames && frames.size() < 2) continue;
    std::vector<double> ratios;
    const std::vector<double> sides = sides_of(field, frames);
    for (const double side : sides) {
      const Sums sums = residuals.over_squares(side, over_frames);
      const double ratio = sums.n >= fewest_sums ? sums.ratio(variance) : 1.0;
      ratios.push_back(ratio);
      if (!(ratio > sums.limit()) || !(std::sqrt(ratio) > scatter.inflation)) continue;
      scatter.inflation = std::sqrt(ratio);
      scatter.over = side;
      scatter.over_frames = over_frames;
      const double smaller =
          ratios[ratios.size() > 4 ? ratios.size() - 5 : 0];  // of squares a quarter as wide, or the least
      scatter.is_long_ranged = side > 0.5 * sides.back() && ratio > long_range * sums.limit() * std::max(smaller, 1.0);
    }
  }
  if (const double overlap = overlap_of(field); !(field.deviation > 0.0) && overlap > scatter.inflation) {
    scatter.inflation = overlap;
    scatter.over = field.subset;
    scatter.over_frames = scatter.is_long_ranged = false;
  }
  return scatter;
}

std::string too_few_for_noise(const std::string& field, std::size_t n_data) {
  return fmt::format(
      "field \"{}\" has {} data, and fewer than {} do not tell their noise: state it by \"deviation\" of the field",
      field, n_data, fewest_for_noise);
}

double stated_deviation(const MeasuredField& field) { return field.deviation * overlap_of(field); }

}  // namespace pfdm
