#include "solver/dynamics/spline_grid.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

SplineGrid::SplineGrid(const Vector& lower, const Vector& upper, Index wanted, Index most) {
  constexpr double finer = 0.8;
  const Vector extent = upper - lower;
  const auto set = [&](double width) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double length = extent[a];
      const Index n = std::max<Index>(1, static_cast<Index>(std::lround(length / width)));
      axes_[a] = {.from = lower[a], .width = length / n, .n = n};
    }
  };
  double width = extent.minCoeff();
  for (set(width); n_functions() > most && n_boxes() > 1;) set(width /= finer);
  for (std::array<Axis, 3> last = axes_; n_functions() <= wanted; last = axes_) {
    set(width *= finer);
    if (n_functions() <= wanted) continue;
    axes_ = last;
    return;
  }
}

Index SplineGrid::box_of(const Vector& x) const {
  Index box = 0;
  for (std::size_t a = 3; a-- > 0;) {
    const double at = std::floor((x[a] - axes_[a].from) / axes_[a].width);
    box = box * axes_[a].n + static_cast<Index>(std::clamp(at, 0.0, axes_[a].n - 1.0));
  }
  return box;
}

std::array<Index, 3> SplineGrid::place_of(Index box) const {
  return {box % axes_[0].n, box / axes_[0].n % axes_[1].n, box / axes_[0].n / axes_[1].n};
}

std::array<Index, SplineGrid::n_per_box> SplineGrid::functions_of(Index box) const {
  const auto [i, j, k] = place_of(box);
  std::array<Index, n_per_box> functions{};
  for (Index m = 0; m < n_per_box; ++m)
    functions[m] = ((k + m / 9) * (axes_[1].n + 2) + j + m / 3 % 3) * (axes_[0].n + 2) + i + m % 3;
  return functions;
}

SplineGrid::OnAxes SplineGrid::on_axes(Index box, const Vector& x) const {
  const std::array<Index, 3> place = place_of(box);
  OnAxes on{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double h = axes_[a].width, t = (x[a] - axes_[a].from) / h - place[a];
    on.value[a] = {0.5 * (1.0 - t) * (1.0 - t), 0.5 + t - t * t, 0.5 * t * t};
    on.slope[a] = {(t - 1.0) / h, (1.0 - 2.0 * t) / h, t / h};
  }
  return on;
}

std::array<double, SplineGrid::n_per_box> SplineGrid::values(Index box, const Vector& x) const {
  const auto [value, slope] = on_axes(box, x);
  std::array<double, n_per_box> values{};
  for (std::size_t m = 0; m < n_per_box; ++m) values[m] = value[0][m % 3] * value[1][m / 3 % 3] * value[2][m / 9];
  return values;
}

std::array<Vector, SplineGrid::n_per_box> SplineGrid::gradients(Index box, const Vector& x) const {
  const auto [value, slope] = on_axes(box, x);
  std::array<Vector, n_per_box> gradients;
  for (std::size_t m = 0; m < n_per_box; ++m) {
    const std::size_t i = m % 3, j = m / 3 % 3, k = m / 9;
    gradients[m] = Vector(slope[0][i] * value[1][j] * value[2][k], value[0][i] * slope[1][j] * value[2][k],
                          value[0][i] * value[1][j] * slope[2][k]);
  }
  return gradients;
}

}  // namespace pfdm
