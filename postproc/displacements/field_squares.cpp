#include "postproc/displacements/field_squares.h"

#include "postproc/displacements/chi_square.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double most_missing = 0.25;        // of the points of a place
constexpr std::size_t fewest_of_plane = 4;   // points
constexpr double normal_of_chance = 3.29;    // which noise exceeds once in 2,000 times
constexpr double rounding_of_plane = 1e-12;  // of the largest displacement

std::array<double, 3> coordinates(const Vector& p) { return {p[0], p[1], p[2]}; }

std::vector<std::array<double, 3>> sorted(const std::vector<Vector>& points) {
  std::vector<std::array<double, 3>> result;
  result.reserve(points.size());
  for (const Vector& p : points) result.push_back(coordinates(p));
  std::ranges::sort(result);
  return result;
}

Vector middle_of(const std::vector<Vector>& points) {
  Vector middle = Vector::Zero();
  for (const Vector& p : points) middle += p;
  return middle / static_cast<double>(points.size());
}

/// Whether few points of a place are missing, and few are there besides; both are sorted.
bool is_like(const std::vector<std::array<double, 3>>& points, const std::vector<std::array<double, 3>>& common) {
  const auto found =
      std::ranges::count_if(points, [&](const auto& p) { return std::ranges::binary_search(common, p); });
  const double least = (1.0 - most_missing) * static_cast<double>(std::max(common.size(), points.size()));
  return static_cast<double>(found) >= least;
}

}  // namespace

FieldSquares::FieldSquares(const MeasuredField& field, const std::vector<RecordedFrame>& frames, double side,
                           std::vector<FieldPlace>& places)
    : field_(field), side_(side), places_(places) {
  if (!(side > 0.0)) return;
  std::map<Square, std::vector<Vector>> seen;  // in the order in which they come
  std::map<Point, std::size_t> n_frames;
  for (const RecordedFrame& frame : frames)
    for (const Vector& p : frame.points)
      if (n_frames[coordinates(p)]++ == 0) seen[square_of(p, side)].push_back(p);
  for (auto& [square, points] : seen) {
    std::erase_if(points, [&](const Vector& p) { return 2 * n_frames[coordinates(p)] < frames.size(); });
    if (!points.empty()) common_[square] = {.sorted = sorted(points), .middle = middle_of(points), .points = points};
  }
}

std::map<Square, FieldSquares::Members> FieldSquares::squares_of(const RecordedFrame& frame) const {
  std::map<Square, Members> squares;
  for (std::size_t i = 0; i < frame.points.size(); ++i)
    squares[side_ > 0.0 ? square_of(frame.points[i], side_) : Square{static_cast<long>(i), 0}].push_back(i);
  return squares;
}

std::size_t FieldSquares::number_of(const std::vector<Point>& key, const std::vector<Vector>& points) {
  const auto [found, is_new] = known_.try_emplace(key, places_.size());
  if (is_new) {
    FieldPlace& place = places_.emplace_back();
    for (const Vector& p : points) place.points.push_back(field_.plane.at(p));
  }
  return found->second;
}

// With the plane of displacements by least squares.
FieldSquares::Mean FieldSquares::mean_of(const RecordedFrame& frame, const Members& members) {
  Mean mean;
  for (const std::size_t i : members) mean.points.push_back(frame.points[i]);
  mean.middle = middle_of(mean.points);
  for (const std::size_t i : members) mean.u += frame.u[i] / static_cast<double>(members.size());
  mean.n = static_cast<double>(members.size());
  if (members.size() < fewest_of_plane) return mean;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 3> sums = Eigen::Matrix<double, 2, 3>::Zero();
  for (const std::size_t i : members) {
    const Eigen::Vector2d d = (frame.points[i] - mean.middle).head<2>();
    normal += d * d.transpose();
    sums += d * (frame.u[i] - mean.u).transpose();
  }
  normal += 1e-9 * normal.trace() * Eigen::Matrix2d::Identity();  // points along a line have no slope across it
  mean.slopes = normal.ldlt().solve(sums);
  mean.inverse = normal.ldlt().solve(Eigen::Matrix2d::Identity());
  for (const std::size_t i : members) {
    const Eigen::Vector2d d = (frame.points[i] - mean.middle).head<2>();
    mean.squares += (frame.u[i] - mean.u - mean.slopes.transpose() * d).squaredNorm();
  }
  return mean;
}

FieldFrame FieldSquares::means(const RecordedFrame& frame) {
  FieldFrame data{
      .name = frame.name, .displacement = frame.displacement, .places = {}, .middle = {}, .u = {}, .n_points = {}};
  std::vector<std::pair<Square, Mean>> means;
  double largest = 0.0;
  for (const auto& [square, members] : squares_of(frame)) {
    means.emplace_back(square, mean_of(frame, members));
    largest = std::max(largest, means.back().second.u.norm());
  }
  const double noise =
      field_.deviation > 0.0 || side_ == 0.0 ? field_.deviation : noise_of(frame, field_.spacing, field_.n_components);
  for (auto& [square, mean] : means) {
    data.places.push_back(place_of(square, noise, rounding_of_plane * largest, mean));
    data.n_points.push_back(mean.n);
    data.middle.push_back(mean.middle);
    data.u.push_back(mean.u);
  }
  return data;
}

bool FieldSquares::is_plane(const Mean& mean, double noise, double rounding) const {
  if (mean.points.size() < fewest_of_plane) return false;
  const double freedom = static_cast<double>(mean.points.size() - 3) * field_.n_components;
  return mean.squares <=
         (noise * noise + rounding * rounding) * (freedom * chi_square_over_mean(freedom, normal_of_chance));
}

std::size_t FieldSquares::place_of(const Square& square, double noise, double rounding, Mean& mean) {
  const auto found = common_.find(square);
  const std::vector<Point> key = sorted(mean.points);
  const bool is_there = found != common_.end() && is_like(key, found->second.sorted);
  const bool is_whole = is_there && key == found->second.sorted;
  if (!is_whole && !(is_there && is_plane(mean, noise, rounding))) {
    n_own_ += side_ > 0.0 ? 1 : 0;
    return number_of(key, mean.points);
  }
  const Common& common = found->second;
  if (!is_whole) {
    ++n_carried_;
    const Eigen::Vector2d by = (common.middle - mean.middle).head<2>();
    mean.u += mean.slopes.transpose() * by;
    mean.n = 1.0 / (1.0 / mean.n + by.dot(mean.inverse * by));  // as known as the plane is there
  }
  mean.middle = common.middle;
  return number_of(common.sorted, common.points);
}

}  // namespace pfdm
