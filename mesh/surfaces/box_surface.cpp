#include "mesh/surfaces/box_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace pfdm {
namespace {

constexpr int n_samples = 400;       // of the size along an axis
constexpr double max_stretch = 2.0;  // longest step over the shortest wanted one

// The smallest size wanted on the four sides parallel to the axis, at one coordinate along it: it is found beside
// the centres of the particles.
double smallest_size(const Vector& lower, const Vector& upper, const SizeField& size, int axis, double coordinate) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const SizeSource& source : size.sources())
    for (const int across : {(axis + 1) % 3, (axis + 2) % 3})
      for (const double side : {lower[across], upper[across]}) {
        Vector x = source.centre;
        x[axis] = coordinate;
        x[across] = side;
        smallest = std::min(smallest, size(x));
      }
  return std::isfinite(smallest) ? smallest : size(lower);
}

std::vector<double> nodes_from_sizes(double lower, double upper, const std::vector<double>& sizes) {
  // Equal parts of the integral of 1/h (trapezoidal rule on the samples).
  const double step = (upper - lower) / n_samples;
  std::vector<double> count{0.0};
  for (std::size_t i = 1; i < sizes.size(); ++i)
    count.push_back(count.back() + 0.5 * step * (1.0 / sizes[i - 1] + 1.0 / sizes[i]));
  const auto n = std::max(1L, std::lround(count.back()));
  std::vector<double> nodes{lower};
  std::size_t i = 1;
  for (long k = 1; k < n; ++k) {
    const double target = count.back() * static_cast<double>(k) / static_cast<double>(n);
    while (count[i] < target) ++i;
    nodes.push_back(lower + step * (static_cast<double>(i - 1) + (target - count[i - 1]) / (count[i] - count[i - 1])));
  }
  nodes.push_back(upper);
  return nodes;
}

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const BoxNodes& nodes) : nodes_(nodes) {}

  // The side of the box where the axis has its first or last node; u and v follow the axis cyclically.
  void add_side(std::size_t axis, bool at_end) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<std::size_t, 3> at{};
    at[axis] = at_end ? nodes_[axis].size() - 1 : 0;
    const auto id = [&](std::size_t i, std::size_t j) {
      at[u] = i;
      at[v] = j;
      return point(at);
    };
    for (std::size_t i = 0; i + 1 < nodes_[u].size(); ++i)
      for (std::size_t j = 0; j + 1 < nodes_[v].size(); ++j)
        add_rectangle({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)}, (i + j) % 2 == 0, at_end);
  }

  TriangleSurface take() { return std::move(surface_); }

 private:
  Index point(const std::array<std::size_t, 3>& at) {
    const auto [entry, is_new] = ids_.try_emplace(at, count_of(surface_.points));
    if (is_new) surface_.points.emplace_back(nodes_[0][at[0]], nodes_[1][at[1]], nodes_[2][at[2]]);
    return entry->second;
  }

  void add_rectangle(const std::array<Index, 4>& q, bool rising, bool outwards) {
    const std::array<Triangle, 2> halves = rising ? std::array<Triangle, 2>{{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}}
                                                  : std::array<Triangle, 2>{{{q[0], q[1], q[3]}, {q[1], q[2], q[3]}}};
    for (Triangle t : halves) {
      if (!outwards) std::swap(t[1], t[2]);
      surface_.triangles.push_back(t);
    }
  }

  const BoxNodes& nodes_;
  std::map<std::array<std::size_t, 3>, Index> ids_;
  TriangleSurface surface_;
};

}  // namespace

BoxNodes uniform_box_nodes(const Vector& lower, const Vector& upper, double size) {
  BoxNodes nodes;
  for (int axis = 0; axis < 3; ++axis)
    nodes[axis] = nodes_from_sizes(lower[axis], upper[axis], std::vector<double>(n_samples + 1, size));
  return nodes;
}

BoxNodes graded_box_nodes(const Vector& lower, const Vector& upper, const SizeField& size) {
  std::array<std::vector<double>, 3> sizes;
  double smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= n_samples; ++i) {
      const double x = lower[axis] + (upper[axis] - lower[axis]) * i / n_samples;
      const double h = smallest_size(lower, upper, size, axis, x);
      sizes[axis].push_back(h);
      smallest = std::min(smallest, h);
    }
  BoxNodes nodes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (double& h : sizes[axis]) h = std::min(h, max_stretch * smallest);
    const auto a = static_cast<Index>(axis);
    nodes[axis] = nodes_from_sizes(lower[a], upper[a], sizes[axis]);
  }
  return nodes;
}

TriangleSurface box_surface(const BoxNodes& nodes) {
  SurfaceBuilder builder(nodes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    builder.add_side(axis, false);
    builder.add_side(axis, true);
  }
  return builder.take();
}

}  // namespace pfdm
