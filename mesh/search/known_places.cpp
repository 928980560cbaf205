#include "mesh/search/known_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Eigenvalues>

#include "mesh/bounding_box.h"

namespace pfdm {

struct KnownPlaces::Found {
  Index cell = -1, face = -1;
  Index a = -1, b = -1;  // the edge of the face
  double at_a = 0.0, at_b = 0.0, at_face = 0.0, at_middle = 0.0;
  Vector place = Vector::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

namespace {

constexpr double sliver = 1e-12;  // shares of a tetrahedron, and volumes over those of the cube of its edges

/// Weights of a, b and c at the point of their triangle that is nearest to x (Ericson, Real-Time Collision Detection,
/// 2005, 5.1.5).
std::array<double, 3> nearest_in_triangle(const Vector& x, const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0.0};
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {1.0 - d2 / (d2 - d6), 0.0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  const double along = d4 - d3, back = d5 - d6;
  if (va <= 0.0 && along >= 0.0 && back >= 0.0) return {0.0, back / (along + back), along / (along + back)};
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

/// Pseudo-inverse of a sum of w d d^T over neighbours: nothing along directions that none of them has.
Tensor inverse_of_span(const Tensor& sum) {
  constexpr double nothing = 1e-8;
  const Eigen::SelfAdjointEigenSolver<Tensor> modes(sum);
  Tensor inverse = Tensor::Zero();
  for (int i = 0; i < 3; ++i)
    if (const double value = modes.eigenvalues()[i]; value > nothing * modes.eigenvalues()[2])
      inverse += modes.eigenvectors().col(i) * modes.eigenvectors().col(i).transpose() / value;
  return inverse;
}

}  // namespace

KnownPlaces::KnownPlaces(const CellSoup& soup)
    : points_(soup.points),
      faces_(half_faces(soup)),
      first_face_(soup.shape.size() + 1, 0),
      tree_({}),
      point_tree_({}) {
  for (const Index cell : faces_.cell) ++first_face_[cell + 1];
  for (std::size_t c = 1; c < first_face_.size(); ++c) first_face_[c] += first_face_[c - 1];
  measure_cells();
  list_cells_of_points();
  std::vector<Box> cells = boxes();
  around_ = cells.empty() ? Box{Vector::Zero(), Vector::Zero()} : cells.front();
  for (const Box& box : cells) around_ = {around_.low.cwiseMin(box.low), around_.high.cwiseMax(box.high)};
  tree_ = BoxTree(std::move(cells));
  std::vector<Box> places;
  for (Index p = 0; p < n_points(); ++p) {
    if (first_of_point_[p] == first_of_point_[p + 1]) continue;  // of no cell
    point_of_box_.push_back(p);
    places.push_back({points_[p], points_[p]});
  }
  point_tree_ = BoxTree(std::move(places));
}

std::vector<Index> KnownPlaces::points_of_cell(Index cell) const {
  std::vector<Index> points;
  for (Index f = first_face_[cell]; f < first_face_[cell + 1]; ++f)
    for (const Index p : faces_.points_of(f)) points.push_back(p);
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

Vector KnownPlaces::middle_of_face(Index face) const {
  Vector sum = Vector::Zero();
  for (const Index p : faces_.points_of(face)) sum += points_[p];
  return sum / static_cast<double>(faces_.points_of(face).size());
}

// The volume's centroid, by the tetrahedra over the faces' fans.
void KnownPlaces::measure_cells() {
  for (Index c = 0; c + 1 < count_of(first_face_); ++c) {
    const std::vector<Index> corners = points_of_cell(c);
    Vector middle = Vector::Zero();
    for (const Index p : corners) middle += points_[p];
    middle /= static_cast<double>(corners.size());
    double six_volumes = 0.0;
    Vector moment = Vector::Zero();
    for (Index f = first_face_[c]; f < first_face_[c + 1]; ++f) {
      const auto ring = faces_.points_of(f);
      const Vector apex = middle_of_face(f) - middle;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector a = points_[ring[i]] - middle, b = points_[ring[(i + 1) % ring.size()]] - middle;
        const double six = a.cross(b).dot(apex);
        six_volumes += six;
        moment += six * 0.25 * (a + b + apex);
      }
    }
    middle_.push_back(middle);
    centroid_.push_back(six_volumes != 0.0 ? Vector(middle + moment / six_volumes) : middle);
  }
}

void KnownPlaces::list_cells_of_points() {
  first_of_point_.assign(points_.size() + 1, 0);
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<Index> next(first_of_point_.begin(), first_of_point_.end() - 1);
    if (pass == 1) cells_of_point_.resize(first_of_point_.back());
    for (Index c = 0; c < n_cells(); ++c)
      for (const Index p : points_of_cell(c)) {
        if (pass == 0)
          ++first_of_point_[p + 1];
        else
          cells_of_point_[next[p]++] = c;
      }
    for (std::size_t p = 1; pass == 0 && p < first_of_point_.size(); ++p) first_of_point_[p] += first_of_point_[p - 1];
  }
}

std::vector<Box> KnownPlaces::boxes() const {
  std::vector<Box> boxes;
  for (Index c = 0; c < n_cells(); ++c) {
    Box box{middle_[c], middle_[c]};
    for (const Index p : points_of_cell(c)) box = {box.low.cwiseMin(points_[p]), box.high.cwiseMax(points_[p])};
    boxes.push_back(box);
  }
  return boxes;
}

void KnownPlaces::look_in(Index cell, const Vector& x, Found& best) const {
  const Vector& middle = middle_[cell];
  for (Index f = first_face_[cell]; f < first_face_[cell + 1]; ++f) {
    const auto ring = faces_.points_of(f);
    const Vector apex = middle_of_face(f);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Index a = ring[i], b = ring[(i + 1) % ring.size()];
      const Vector& at_a = points_[a];
      const Vector& at_b = points_[b];
      Tensor edges;
      edges << at_a - middle, at_b - middle, apex - middle;
      const double six_volumes = edges.determinant();
      if (std::abs(six_volumes) > sliver * edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm()) {
        const Vector share = edges.inverse() * (x - middle);
        const double rest = 1.0 - share[0] - share[1] - share[2];
        if (share.minCoeff() >= -sliver && rest >= -sliver) {
          best = {cell, f, a, b, share[0], share[1], share[2], rest, x, 0.0};
          return;
        }
      }
      const auto [to_a, to_b, to_apex] = nearest_in_triangle(x, at_a, at_b, apex);
      const Vector place = to_a * at_a + to_b * at_b + to_apex * apex;
      if (const double distance = (x - place).norm(); distance < best.distance)
        best = {cell, f, a, b, to_a, to_b, to_apex, 0.0, place, distance};
    }
  }
}

KnownPlaces::Found KnownPlaces::find(const Vector& x) const {
  Found best;
  tree_.search(x, [&](Index cell) {
    look_in(cell, x, best);
    return best.distance;
  });
  return best;
}

Interpolation KnownPlaces::from_points(const Vector& x) const {
  const Found found = find(x);
  Interpolation result{.known = {found.a, found.b}, .weight = {found.at_a, found.at_b}, .outside = found.distance};
  const auto add_mean = [&](const auto& points, double weight) {
    for (const Index p : points) {
      result.known.push_back(p);
      result.weight.push_back(weight / static_cast<double>(points.size()));
    }
  };
  if (found.at_face != 0.0) add_mean(faces_.points_of(found.face), found.at_face);
  if (found.at_middle != 0.0) add_mean(points_of_cell(found.cell), found.at_middle);
  return result;
}

std::vector<Index> KnownPlaces::neighbours(Index cell) const {
  std::vector<Index> cells;
  for (const Index p : points_of_cell(cell))
    for (Index i = first_of_point_[p]; i < first_of_point_[p + 1]; ++i)
      if (cells_of_point_[i] != cell) cells.push_back(cells_of_point_[i]);
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

Interpolation KnownPlaces::from_cells(const Vector& x) const {
  const Found found = find(x);
  const Vector& centre = centroid_[found.cell];
  const std::vector<Index> around = neighbours(found.cell);
  Tensor sum = Tensor::Zero();
  for (const Index n : around) {
    const Vector d = (centroid_[n] - centre).normalized();
    sum += d * d.transpose();
  }
  const Vector along = inverse_of_span(sum) * (found.place - centre);
  Interpolation result{.known = {found.cell}, .weight = {1.0}, .outside = found.distance};
  for (const Index n : around) {
    const Vector d = centroid_[n] - centre;
    const double weight = d.dot(along) / d.squaredNorm();
    result.known.push_back(n);
    result.weight.push_back(weight);
    result.weight.front() -= weight;
  }
  return result;
}

Interpolation KnownPlaces::from_one_point(const Vector& x) const {
  Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  point_tree_.search(x, [&](Index box) {
    const Index p = point_of_box_[box];
    if (const double distance = (x - points_[p]).norm(); distance < least) least = distance, nearest = p;
    return least;
  });
  return {.known = {nearest}, .weight = {1.0}, .outside = find(x).distance};
}

Interpolation KnownPlaces::from_one_cell(const Vector& x) const {
  const Found found = find(x);
  return {.known = {found.cell}, .weight = {1.0}, .outside = found.distance};
}

Interpolation KnownField::at(Vector x, bool nearest) const {
  for (Eigen::Index a = 0; a < 3; ++a)
    if (!varies[a]) x[a] = fixed[a];
  Interpolation found = nearest ? (at_points ? places.from_one_point(x) : places.from_one_cell(x))
                                : (at_points ? places.from_points(x) : places.from_cells(x));
  for (Index& known : found.known) known = entry[known];
  return found;
}

double size_of(const std::vector<Vector>& points) {
  if (points.empty()) return 0.0;
  const auto [low, high] = bounding_box(points);
  return (high - low).norm();
}

std::vector<Index> counted_from_zero(std::size_t n) {
  std::vector<Index> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace pfdm
