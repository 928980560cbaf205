#include "postproc/page/axes_drawing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr double label_size = 7.0, title_size = 7.5, tick_length = 2.5, label_offset = 4.5;  // [pt]
constexpr double half_a_digit = 0.36 * label_size;                                           // [pt]
const Pen frame_pen{.colour = {0.25, 0.25, 0.25}}, grid_pen{.colour = {0.88, 0.88, 0.88}, .width = 0.4};

double widest_label(const AxisTicks& ticks) {
  double widest = 0.0;
  for (const std::string& label : ticks.labels) widest = std::max(widest, text_width(label, label_size));
  return widest;
}

void line(Paper& paper, const PaperPoint& from, const PaperPoint& to, const Pen& pen) {
  paper.stroke(std::array{from, to}, pen);
}

void draw_x_axis(Paper& paper, const Axes& axes) {
  const Rectangle& w = axes.window;
  double free_from = -std::numeric_limits<double>::infinity();  // numbers that would touch are left out
  line(paper, {w.left, w.bottom}, {w.right(), w.bottom}, frame_pen);
  for (std::size_t i = 0; i < axes.x.positions.size(); ++i) {
    const double x = axes.at(axes.x.positions[i], 0.0).x();
    line(paper, {x, w.bottom}, {x, w.bottom - tick_length}, frame_pen);
    const double half_width = 0.5 * text_width(axes.x.labels[i], label_size);
    if (x - half_width < free_from) continue;
    if (half_width > 0.0) free_from = x + half_width + 2.0;
    paper.text(axes.x.labels[i], {x, w.bottom - label_offset - 2.0 * half_a_digit},
               {.size = label_size, .alignment = 0.5});
  }
  paper.text(axes.x_title, {w.left + 0.5 * w.width, w.bottom - 20.0},
             {.size = fitting_size(axes.x_title, title_size, w.width), .alignment = 0.5});
}

void draw_y_axis(Paper& paper, const Axes& axes) {
  const Rectangle& w = axes.window;
  double free_from = -std::numeric_limits<double>::infinity();
  line(paper, {w.left, w.bottom}, {w.left, w.top()}, frame_pen);
  for (std::size_t i = 0; i < axes.y.positions.size(); ++i) {
    const double y = axes.at(0.0, axes.y.positions[i]).y();
    line(paper, {w.left, y}, {w.left - tick_length, y}, frame_pen);
    if (y < free_from) continue;
    if (!axes.y.labels[i].empty()) free_from = y + label_size;
    paper.text(axes.y.labels[i], {w.left - label_offset, y - half_a_digit}, {.size = label_size, .alignment = 1.0});
  }
  paper.text(axes.y_title, {w.left - label_offset - widest_label(axes.y) - 5.0, w.bottom + 0.5 * w.height},
             {.size = fitting_size(axes.y_title, title_size, std::max(w.height, least_height_of_titles)),
              .angle = 0.5 * std::numbers::pi,
              .alignment = 0.5});
}

}  // namespace

PaperPoint Axes::at(double x_value, double y_value) const {
  return {window.left + window.width * (x_value - x.from) / (x.to - x.from),
          window.bottom + window.height * (y_value - y.from) / (y.to - y.from)};
}

double room_left_of(const AxisTicks& y) { return widest_label(y) + label_offset + title_size + 4.0; }

void draw_grid(Paper& paper, const Axes& axes) {
  const Rectangle& w = axes.window;
  for (const double value : axes.x.positions) {
    const double x = axes.at(value, 0.0).x();
    line(paper, {x, w.bottom}, {x, w.top()}, grid_pen);
  }
  for (const double value : axes.y.positions) {
    const double y = axes.at(0.0, value).y();
    line(paper, {w.left, y}, {w.right(), y}, grid_pen);
  }
}

void draw_axes(Paper& paper, const Axes& axes) {
  draw_x_axis(paper, axes);
  draw_y_axis(paper, axes);
}

}  // namespace pfdm
