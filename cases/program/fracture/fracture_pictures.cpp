#include "cases/program/fracture/fracture_pictures.h"

#include "cases/program/fracture/fracture_results.h"
#include "cases/program/session/report_parts.h"
#include "postproc/fields/field_slice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr std::string_view axis_names = "xyz";

/// A frame and the row of the curve that belongs to it.
struct FrameOfCurve {
  std::filesystem::path file;
  CurveRow row;
};

std::vector<FrameOfCurve> frames_of(const std::filesystem::path& results, const std::vector<CurveRow>& curve) {
  std::vector<FrameOfCurve> frames;
  for (const StoredStep& stored : stored_steps(results)) {
    const auto row = std::ranges::find(curve, stored.step, &CurveRow::step);
    if (row != curve.end()) frames.push_back({stored.file, *row});
  }
  return frames;
}

/// The frame, before the last, by which about half of the last one's surface energy was dissipated.
const FrameOfCurve* frame_half_way(const std::vector<FrameOfCurve>& frames) {
  const double half = 0.5 * frames.back().row.energy.fracture;
  const FrameOfCurve* best = nullptr;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i)
    if (best == nullptr || std::abs(frames[i].row.energy.fracture - half) < std::abs(best->row.energy.fracture - half))
      best = &frames[i];
  return best;
}

/// A plane across the axis meets all cells.
bool one_cell_thick(const StoredFrame& frame, int axis) {
  const Vector middle = 0.5 * (frame.lower() + frame.upper());
  return static_cast<Index>(frame.slice(middle, Vector::Unit(axis), "damage").cells.size()) == frame.n_cells();
}

/// The axes along which a body has more than one cell.
std::vector<int> axes_of(const StoredFrame& frame) {
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (!one_cell_thick(frame, axis)) axes.push_back(axis);
  return axes;
}

std::string state_of(const CurveRow& row) {
  return fmt::format("displacement {}, step {}", shown(row.displacement, "m"), row.step);
}

/// The plane's axes are `across` to the right and `up`.
Picture picture_of(const StoredFrame& frame, const Vector& point, int across, int up, const CurveRow& row) {
  const int normal = 3 - across - up;
  const FieldSlice slice = frame.slice(point, Vector::Unit(normal), "damage");
  const Vector lower = frame.lower(), upper = frame.upper();
  const DisplayUnit unit = display_unit((upper - lower).maxCoeff(), "m");
  const auto flat = [&](const Vector& p) { return Eigen::Vector2d(unit.factor * Eigen::Vector2d(p[across], p[up])); };
  Picture picture{.caption = fmt::format("Damage, plane {}{}, {}", axis_names[static_cast<std::size_t>(across)],
                                         axis_names[static_cast<std::size_t>(up)], state_of(row)),
                  .x_title = fmt::format("{} [{}]", axis_names[static_cast<std::size_t>(across)], unit.name),
                  .y_title = fmt::format("{} [{}]", axis_names[static_cast<std::size_t>(up)], unit.name),
                  .value_title = "damage d [-]",
                  .cells = {},
                  .lines = {}};
  for (const FieldSlice::Cell& cell : slice.cells) {
    picture.cells.push_back({.corners = {}, .value = cell.value});
    for (const Vector& corner : cell.corners) picture.cells.back().corners.push_back(flat(corner));
  }
  for (const auto& border : slice.borders) picture.lines.push_back({flat(border[0]), flat(border[1])});
  return picture;
}

std::vector<PageBlock> pictures_of_body(const FractureCase& fracture, const FrameOfCurve& last) {
  const StoredFrame frame(last.file);
  const Vector middle = 0.5 * (frame.lower() + frame.upper());
  const Vector point = fracture.output.slices_through.value_or(middle);
  return {picture_of(frame, point, 0, 2, last.row), picture_of(frame, point, 1, 2, last.row)};
}

std::vector<PageBlock> pictures_of_plate(const std::vector<FrameOfCurve>& frames, int across, int up) {
  std::vector<PageBlock> pictures;
  for (const FrameOfCurve* f : {frame_half_way(frames), &frames.back()}) {
    if (f == nullptr) continue;
    const StoredFrame frame(f->file);
    pictures.emplace_back(picture_of(frame, 0.5 * (frame.lower() + frame.upper()), across, up, f->row));
  }
  return pictures;
}

/// Damage of the cells along a bar's axis.
Series profile_of(const StoredFrame& frame, int along, int normal, const DisplayUnit& unit) {
  const FieldSlice slice = frame.slice(0.5 * (frame.lower() + frame.upper()), Vector::Unit(normal), "damage");
  std::vector<std::pair<double, double>> points;
  for (const FieldSlice::Cell& cell : slice.cells) {
    double sum = 0.0;
    for (const Vector& corner : cell.corners) sum += corner[along];
    points.emplace_back(unit.factor * sum / static_cast<double>(cell.corners.size()), cell.value);
  }
  std::ranges::sort(points);
  Series series;
  for (const auto& [x, d] : points) {
    series.x.push_back(x);
    series.y.push_back(d);
  }
  return series;
}

Chart profiles_of_bar(const std::vector<FrameOfCurve>& frames, int along, int normal) {
  Chart chart{.caption = "Damage along the bar", .x = {}, .y = {.title = "damage d [-]"}, .series = {}};
  int colour = 0;
  for (const FrameOfCurve* f : {&frames.back(), frame_half_way(frames)}) {
    if (f == nullptr) continue;
    const StoredFrame frame(f->file);
    const DisplayUnit unit = display_unit((frame.upper() - frame.lower()).maxCoeff(), "m");
    chart.x.title = fmt::format("{} [{}]", axis_names[static_cast<std::size_t>(along)], unit.name);
    chart.series.push_back(profile_of(frame, along, normal, unit));
    chart.series.back().label = state_of(f->row);
    chart.series.back().colour = colour++;
  }
  return chart;
}

}  // namespace

std::vector<PageBlock> damage_pictures(const FractureCase& fracture, const std::vector<CurveRow>& curve,
                                       const std::filesystem::path& results) {
  const std::vector<FrameOfCurve> frames = frames_of(results, curve);
  if (frames.empty()) return {};
  const StoredFrame last(frames.back().file);
  const std::vector<int> axes = axes_of(last);
  if (axes.size() == 1) return {profiles_of_bar(frames, axes[0], (axes[0] + 1) % 3)};
  if (axes.size() == 2) return pictures_of_plate(frames, axes[0], axes[1]);
  return pictures_of_body(fracture, frames.back());
}

}  // namespace pfdm
