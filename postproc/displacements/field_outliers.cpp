#include "postproc/displacements/field_outliers.h"

#include "mesh/bounding_box.h"
#include "postproc/displacements/chi_square.h"
#include "solver/calibration/calibration_statistics.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm {
namespace {

constexpr double reach = 2.3;          // spacings
constexpr double astray = 6.0;         // standard deviations
constexpr double normal_mad = 1.4826;  // standard deviation over median of the magnitudes, of normal noise
constexpr std::size_t fewest_around = 6;
constexpr int passes = 3;
constexpr double side_of_surface = 3.5;  // spacings

using Neighbours = std::vector<std::vector<std::size_t>>;

/// Calls visit(j) for the other points within `side` of point i.
class PointSquares {
 public:
  PointSquares(const std::vector<Vector>& points, double side) : points_(points), side_(side) {
    for (std::size_t i = 0; i < points.size(); ++i) squares_[square_of(points[i], side)].push_back(i);
  }
  template <class Visit>
  void around(std::size_t i, const Visit& visit) const {
    const auto [a, b] = square_of(points_[i], side_);
    for (long da = -1; da <= 1; ++da)
      for (long db = -1; db <= 1; ++db)
        if (const auto found = squares_.find({a + da, b + db}); found != squares_.end())
          for (const std::size_t j : found->second)
            if (j != i && (points_[i] - points_[j]).head<2>().norm() < side_) visit(j);
  }

 private:
  const std::vector<Vector>& points_;
  double side_;
  std::map<Square, std::vector<std::size_t>> squares_;
};

/// Of each point, its displacement less that of the plane through the sound ones around it; 0 where they are too few.
std::vector<Vector> from_planes(const RecordedFrame& frame, const Neighbours& around,
                                const std::vector<bool>& astray_yet) {
  std::vector<Vector> residuals(frame.points.size(), Vector::Zero());
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), sums = normal;  // of 1, x, y; their products with u
    std::size_t n = 0;
    for (const std::size_t j : around[i]) {
      if (astray_yet[j]) continue;
      const Vector d = frame.points[j] - frame.points[i];
      const Vector basis(1.0, d[0], d[1]);
      normal += basis * basis.transpose();
      sums += basis * (frame.u[j] - frame.u[i]).transpose();
      ++n;
    }
    if (n < fewest_around) continue;
    const double scale = normal(1, 1) + normal(2, 2);
    normal(1, 1) += 1e-9 * scale;  // points along a line have no slope across it
    normal(2, 2) += 1e-9 * scale;
    residuals[i] = -(normal.ldlt().solve(sums)).row(0).transpose();
  }
  return residuals;
}

/// Sum of the squares of what the surface of second degree through the points leaves, over as many degrees of freedom.
std::pair<double, double> left_by_surface(const RecordedFrame& frame, const std::vector<std::size_t>& members,
                                          double spacing, int n_components) {
  const auto n = static_cast<Eigen::Index>(members.size());
  Eigen::MatrixXd basis(n, 6), u(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t member = members[static_cast<std::size_t>(i)];
    const Vector d = (frame.points[member] - frame.points[members.front()]) / spacing;
    basis.row(i) << 1.0, d[0], d[1], d[0] * d[0], d[0] * d[1], d[1] * d[1];
    u.row(i) = (frame.u[member] - frame.u[members.front()]).transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(basis);
  return {(u - basis * qr.solve(u)).squaredNorm(), static_cast<double>((n - qr.rank()) * n_components)};
}

}  // namespace

double noise_of(const RecordedFrame& frame, double spacing, int n_components) {
  if (!(spacing > 0.0)) return 0.0;
  std::map<Square, std::vector<std::size_t>> squares;
  for (std::size_t i = 0; i < frame.points.size(); ++i)
    squares[square_of(frame.points[i], side_of_surface * spacing)].push_back(i);
  std::vector<double> variances;
  for (const auto& [square, members] : squares) {
    const auto [left, freedom] = left_by_surface(frame, members, spacing, n_components);
    if (!(freedom > 0.0)) continue;
    variances.push_back(left / (freedom * chi_square_over_mean(freedom, 0.0)));
  }
  return variances.empty() ? 0.0 : std::sqrt(quantile(std::move(variances), 0.5));
}

Square square_of(const Vector& p, double side) {
  return {std::lround(std::floor(p[0] / side)), std::lround(std::floor(p[1] / side))};
}

double spacing_of(const std::vector<Vector>& points) {
  if (points.size() < 2) return 0.0;
  const Box box = bounding_box(points);
  const auto n = static_cast<double>(points.size());
  const double about = std::sqrt(std::max((box.high - box.low).head<2>().prod(), 0.0) / n);
  const double side = about > 0.0 ? 2.0 * about : (box.high - box.low).norm() / n;
  if (!(side > 0.0)) return 0.0;
  const PointSquares squares(points, side);
  std::vector<double> nearest;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(points.size() / 500, 1)) {
    double least = side;
    squares.around(i, [&](std::size_t j) { least = std::min(least, (points[i] - points[j]).head<2>().norm()); });
    nearest.push_back(least);
  }
  return quantile(std::move(nearest), 0.5);
}

std::vector<bool> outliers_of(const RecordedFrame& frame, double spacing, int n_components) {
  const std::size_t n = frame.points.size();
  std::vector<bool> is_outlier(n, false);
  if (!(spacing > 0.0)) return is_outlier;
  Neighbours around(n);
  const PointSquares squares(frame.points, reach * spacing);
  for (std::size_t i = 0; i < n; ++i) squares.around(i, [&](std::size_t j) { around[i].push_back(j); });
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<Vector> residuals = from_planes(frame, around, is_outlier);
    for (int k = 0; k < n_components; ++k) {
      std::vector<double> all;
      for (const Vector& r : residuals)
        if (r[k] != 0.0) all.push_back(std::abs(r[k]));
      if (all.empty()) continue;
      const double everywhere = quantile(std::move(all), 0.5);
      for (std::size_t i = 0; i < n; ++i) {
        if (!(std::abs(residuals[i][k]) > astray * normal_mad * everywhere)) continue;
        std::vector<double> here;
        for (const std::size_t j : around[i]) here.push_back(std::abs(residuals[j][k]));
        if (!here.empty() && std::abs(residuals[i][k]) > astray * normal_mad * quantile(std::move(here), 0.5))
          is_outlier[i] = true;
      }
    }
  }
  return is_outlier;
}

}  // namespace pfdm
