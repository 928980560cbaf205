#include "postproc/page/picture_drawing.h"

#include "postproc/page/axes_drawing.h"
#include "postproc/page/page_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double number_size = 7.0, colours_title_size = 7.5;                  // [pt]
constexpr double room_left = 34.0, room_above = 4.0, room_for_colours = 42.0;  // [pt]

struct ColourPoint {
  double value;  // 0 to 1
  Colour colour;
};
/// From pale blue-grey to dark red, as damage is shown in the cases' pictures.
constexpr std::array<ColourPoint, 5> colours{{{0.0, {0.93, 0.94, 0.96}},
                                              {0.25, {0.62, 0.76, 0.88}},
                                              {0.5, {0.99, 0.85, 0.45}},
                                              {0.75, {0.91, 0.37, 0.20}},
                                              {1.0, {0.40, 0.00, 0.10}}}};

Colour colour_at(double part) {
  part = std::clamp(part, 0.0, 1.0);
  std::size_t i = 1;
  while (i + 1 < colours.size() && part > colours[i].value) ++i;
  const ColourPoint &a = colours[i - 1], &b = colours[i];
  const double s = (part - a.value) / (b.value - a.value);
  const auto mix = [s](double from, double to) { return from + s * (to - from); };
  return {mix(a.colour.red, b.colour.red), mix(a.colour.green, b.colour.green), mix(a.colour.blue, b.colour.blue)};
}

Axes axes_for(const Rectangle& place, const Picture& picture) {
  Eigen::AlignedBox2d box;
  for (const Picture::Cell& cell : picture.cells)
    for (const Eigen::Vector2d& p : cell.corners) box.extend(p);
  if (box.isEmpty()) box = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 1.0)};
  const double width = place.width - room_left - room_for_colours, height = place.height - room_below_axes - room_above;
  const double scale = std::min(width / box.sizes().x(), height / box.sizes().y());
  const Eigen::Vector2d size = picture.stretched ? Eigen::Vector2d(width, height) : scale * box.sizes();
  const auto ticks = [&](int axis, double spacing) {
    return axis_ticks({.title = {}, .from = box.min()[axis], .to = box.max()[axis]}, 0.0, 0.0,
                      std::max(2, static_cast<int>(size[axis] / spacing)));
  };
  const double middle = place.top() - room_above - 0.5 * std::max(size.y(), least_height_of_titles);
  return {.window = {place.left + room_left, middle - 0.5 * size.y(), size.x(), size.y()},
          .x = ticks(0, 40.0),
          .y = ticks(1, 25.0),
          .x_title = picture.x_title,
          .y_title = picture.y_title};
}

void draw_colours(Paper& paper, const Rectangle& window, const Picture& picture) {
  constexpr int steps = 64;
  const double height = std::max(window.height, least_height_of_titles);
  const Rectangle bar{window.right() + 8.0, window.bottom + 0.5 * (window.height - height), 7.0, height};
  for (int i = 0; i < steps; ++i) {
    const double y0 = bar.bottom + bar.height * i / steps, y1 = bar.bottom + bar.height * (i + 1) / steps;
    paper.fill(std::array<PaperPoint, 4>{{{bar.left, y0}, {bar.right(), y0}, {bar.right(), y1}, {bar.left, y1}}},
               colour_at((i + 0.5) / steps));
  }
  const AxisTicks ticks = axis_ticks({.title = {}, .from = picture.least, .to = picture.most}, 0.0, 0.0,
                                     std::max(1, static_cast<int>(bar.height / 20.0)));
  for (std::size_t i = 0; i < ticks.positions.size(); ++i) {
    const double y = bar.bottom + bar.height * (ticks.positions[i] - picture.least) / (picture.most - picture.least);
    paper.text(ticks.labels[i], {bar.right() + 3.0, y - 2.5}, {.size = number_size});
  }
  paper.text(picture.value_title, {bar.right() + 25.0, bar.bottom + 0.5 * bar.height},
             {.size = fitting_size(picture.value_title, colours_title_size, bar.height),
              .angle = 0.5 * std::numbers::pi,
              .alignment = 0.5});
}

}  // namespace

void draw_picture(Paper& paper, const Rectangle& place, const Picture& picture) {
  const Axes axes = axes_for(below_caption(paper, place, picture.caption), picture);
  const auto on_paper = [&](const std::vector<Eigen::Vector2d>& points) {
    std::vector<PaperPoint> result;
    result.reserve(points.size());
    for (const Eigen::Vector2d& p : points) result.push_back(axes.at(p.x(), p.y()));
    return result;
  };
  for (const Picture::Cell& cell : picture.cells)
    paper.fill(on_paper(cell.corners), colour_at((cell.value - picture.least) / (picture.most - picture.least)));
  for (const auto& line : picture.lines) paper.stroke(on_paper(line), {.colour = {}, .width = 0.6});
  draw_axes(paper, axes);
  draw_colours(paper, axes.window, picture);
}

}  // namespace pfdm
