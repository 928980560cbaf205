#pragma once
// The axes of a chart or picture.

#include "postproc/page/chart_ticks.h"
#include "postproc/page/paper.h"

namespace pfdm {

struct Axes {
  Rectangle window;
  AxisTicks x, y;
  std::string x_title, y_title;

  /// Of values along the axes; of a logarithmic one, of its decimal logarithm.
  PaperPoint at(double x_value, double y_value) const;
};

/// What numbers and titles take beside the window [pt].
double room_left_of(const AxisTicks& y);
constexpr double room_below_axes = 24.0;
constexpr double least_height_of_titles = 48.0;  ///< beside a window that is flatter

/// Lines across the window at the marks.
void draw_grid(Paper& paper, const Axes& axes);
/// Lines along the lower and left edge, marks, numbers and titles.
void draw_axes(Paper& paper, const Axes& axes);

}  // namespace pfdm
