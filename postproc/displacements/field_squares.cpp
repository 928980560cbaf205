#include "postproc/displacements/field_squares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace pfdm {
namespace {

constexpr double most_missing = 0.25;        // of the points of a place
constexpr std::size_t fewest_of_plane = 4;   // points
constexpr double no_plane = 2.0;             // times the median scatter about the planes of a frame
constexpr double rounding_of_plane = 1e-12;  // of the largest displacement

std::array<double, 3> coordinates(const Vector& p) { return {p[0], p[1], p[2]}; }

Vector middle_of(const std::vector<Vector>& points) {
  Vector middle = Vector::Zero();
  for (const Vector& p : points) middle += p;
  return middle / static_cast<double>(points.size());
}

/// Whether few points of a place are missing, and few are there besides.
bool is_like(const std::vector<Vector>& points, const std::vector<Vector>& common) {
  std::set<std::array<double, 3>> due;
  for (const Vector& p : common) due.insert(coordinates(p));
  const auto found = std::ranges::count_if(points, [&](const Vector& p) { return due.contains(coordinates(p)); });
  const double least = (1.0 - most_missing) * static_cast<double>(std::max(common.size(), points.size()));
  return static_cast<double>(found) >= least;
}

}  // namespace

FieldSquares::FieldSquares(const FieldPlane& plane, const std::vector<RecordedFrame>& frames, double side,
                           std::vector<FieldPlace>& places)
    : plane_(plane), side_(side), places_(places) {
  if (!(side > 0.0)) return;
  std::map<Square, std::vector<Vector>> seen;  // in the order in which they come
  std::map<Point, std::size_t> n_frames;
  for (const RecordedFrame& frame : frames)
    for (const Vector& p : frame.points)
      if (n_frames[coordinates(p)]++ == 0) seen[square_of(p, side)].push_back(p);
  for (auto& [square, points] : seen) {
    std::erase_if(points, [&](const Vector& p) { return 2 * n_frames[coordinates(p)] < frames.size(); });
    if (!points.empty()) common_[square] = std::move(points);
  }
}

std::map<Square, FieldSquares::Members> FieldSquares::squares_of(const RecordedFrame& frame) const {
  std::map<Square, Members> squares;
  for (std::size_t i = 0; i < frame.points.size(); ++i)
    squares[side_ > 0.0 ? square_of(frame.points[i], side_) : Square{static_cast<long>(i), 0}].push_back(i);
  return squares;
}

std::size_t FieldSquares::number_of(const std::vector<Vector>& points) {
  std::vector<Point> key;
  key.reserve(points.size());
  for (const Vector& p : points) key.push_back(coordinates(p));
  std::ranges::sort(key);
  const auto [found, is_new] = known_.try_emplace(std::move(key), places_.size());
  if (is_new) {
    FieldPlace& place = places_.emplace_back();
    for (const Vector& p : points) place.points.push_back(plane_.at(p));
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
  double squares = 0.0;
  for (const std::size_t i : members) {
    const Eigen::Vector2d d = (frame.points[i] - mean.middle).head<2>();
    squares += (frame.u[i] - mean.u - mean.slopes.transpose() * d).squaredNorm();
  }
  mean.scatter = std::sqrt(squares / static_cast<double>(members.size() - 3));
  return mean;
}

FieldFrame FieldSquares::means(const RecordedFrame& frame) {
  FieldFrame data{
      .name = frame.name, .displacement = frame.displacement, .places = {}, .middle = {}, .u = {}, .n_points = {}};
  std::vector<std::pair<Square, Mean>> means;
  std::vector<double> scatters;
  double largest = 0.0;
  for (const auto& [square, members] : squares_of(frame)) {
    means.emplace_back(square, mean_of(frame, members));
    largest = std::max(largest, means.back().second.u.norm());
    if (std::isfinite(means.back().second.scatter)) scatters.push_back(means.back().second.scatter);
  }
  double most_scatter = 0.0;
  if (!scatters.empty()) {
    const auto middle = scatters.begin() + std::ssize(scatters) / 2;
    std::ranges::nth_element(scatters, middle);
    most_scatter = no_plane * *middle + rounding_of_plane * largest;
  }
  for (auto& [square, mean] : means) {
    data.places.push_back(place_of(square, most_scatter, mean));
    data.n_points.push_back(mean.n);
    data.middle.push_back(mean.middle);
    data.u.push_back(mean.u);
  }
  return data;
}

std::size_t FieldSquares::place_of(const Square& square, double most_scatter, Mean& mean) {
  const auto common = common_.find(square);
  const std::size_t n_before = places_.size();
  const bool is_carried =
      common != common_.end() && mean.scatter <= most_scatter && is_like(mean.points, common->second);
  if (!is_carried) {
    const std::size_t number = number_of(mean.points);
    const bool is_whole = common != common_.end() && common->second.size() == mean.points.size();
    if (side_ > 0.0 && !is_whole) n_own_ += places_.size() - n_before;
    return number;
  }
  const Vector middle = middle_of(common->second);
  if (middle != mean.middle) {
    ++n_carried_;
    const Eigen::Vector2d by = (middle - mean.middle).head<2>();
    mean.u += mean.slopes.transpose() * by;
    mean.n = 1.0 / (1.0 / mean.n + by.dot(mean.inverse * by));  // as known as the plane is there
    mean.middle = middle;
  }
  return number_of(common->second);
}

}  // namespace pfdm
