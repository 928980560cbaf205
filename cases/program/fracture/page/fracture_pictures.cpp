#include "cases/program/fracture/page/fracture_pictures.h"

#include "cases/program/fracture/outcome/fracture_files.h"
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

std::vector<FrameOfCurve> frames_of(const std::vector<StoredStep>& steps, const std::vector<CurveRow>& curve) {
  std::vector<FrameOfCurve> frames;
  for (const StoredStep& stored : steps) {
    const auto row = std::ranges::find(curve, stored.step, &CurveRow::step);
    if (row != curve.end()) frames.push_back({stored.file, *row});
  }
  return frames;
}

/// The frame, before the last, by which about half of the last one's energy of cracks was spent.
const FrameOfCurve* frame_half_way(const std::vector<FrameOfCurve>& frames) {
  const auto spent = [](const FrameOfCurve& f) { return f.row.energy.fracture + f.row.energy.interface_dissipation; };
  const double half = 0.5 * spent(frames.back());
  const FrameOfCurve* best = nullptr;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i)
    if (best == nullptr || std::abs(spent(frames[i]) - half) < std::abs(spent(*best) - half)) best = &frames[i];
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

std::string name_of(int axis) { return std::string(1, axis_names[axis]); }

Vector centre_of(const FieldSlice::Cell& cell) {
  Vector sum = Vector::Zero();
  for (const Vector& corner : cell.corners) sum += corner;
  return sum / static_cast<double>(cell.corners.size());
}

/// The points from left to right.
Series series_of(std::vector<std::pair<double, double>> points) {
  std::ranges::sort(points);
  Series series;
  for (const auto& [x, y] : points) {
    series.x.push_back(x);
    series.y.push_back(y);
  }
  return series;
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
  Picture picture{.caption = fmt::format("Damage, plane {}{}, {}", name_of(across), name_of(up), state_of(row)),
                  .x_title = fmt::format("{} [{}]", name_of(across), unit.name),
                  .y_title = fmt::format("{} [{}]", name_of(up), unit.name),
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
    points.emplace_back(unit.factor * centre_of(cell)[along], cell.value);
  }
  return series_of(std::move(points));
}

Chart profiles_of_bar(const std::vector<FrameOfCurve>& frames, int along, int normal) {
  Chart chart{.caption = "Damage along the bar", .x = {}, .y = {.title = "damage d [-]"}, .series = {}};
  int colour = 0;
  for (const FrameOfCurve* f : {&frames.back(), frame_half_way(frames)}) {
    if (f == nullptr) continue;
    const StoredFrame frame(f->file);
    const DisplayUnit unit = display_unit((frame.upper() - frame.lower()).maxCoeff(), "m");
    chart.x.title = fmt::format("{} [{}]", name_of(along), unit.name);
    chart.series.push_back(profile_of(frame, along, normal, unit));
    chart.series.back().label = state_of(f->row);
    chart.series.back().colour = colour++;
  }
  return chart;
}

Vector size_of(const StoredFrame& frame) { return frame.upper() - frame.lower(); }

/// The axis along which an interface is thinnest; y of those that are much alike.
int axis_of_view(const StoredFrame& interfaces) {
  constexpr double alike = 0.9;
  const Vector size = size_of(interfaces);
  int axis = 1;
  for (const int other : {2, 0})
    if (size[other] < alike * size[axis]) axis = other;
  return axis;
}

/// The faces from far to near, so that near ones hide those behind them.
Picture view_of(const FrameOfCurve& f, int axis) {
  const int across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
  const Vector towards = Vector::Unit(across).cross(Vector::Unit(up));
  const StoredFrame frame(f.file);
  const DisplayUnit unit = display_unit(size_of(frame).maxCoeff(), "m");
  std::vector<FieldSlice::Cell> faces = frame.faces("damage");
  std::ranges::stable_sort(faces, {}, [&](const FieldSlice::Cell& face) { return centre_of(face).dot(towards); });
  Picture picture{.caption = fmt::format("Interface, seen along {}, {}", name_of(axis), state_of(f.row)),
                  .x_title = fmt::format("{} [{}]", name_of(across), unit.name),
                  .y_title = fmt::format("{} [{}]", name_of(up), unit.name),
                  .value_title = "damage of the interface [-]",
                  .cells = {},
                  .lines = {}};
  for (const FieldSlice::Cell& face : faces) {
    picture.cells.push_back({.corners = {}, .value = face.value});
    for (const Vector& corner : face.corners)
      picture.cells.back().corners.emplace_back(unit.factor * corner[across], unit.factor * corner[up]);
  }
  return picture;
}

/// Damage along the longest side of a narrow interface.
Chart profiles_of_strip(const std::vector<const FrameOfCurve*>& frames, int along) {
  Chart chart{.caption = fmt::format("Interface along {}", name_of(along)),
              .x = {},
              .y = {.title = "damage of the interface [-]"},
              .series = {}};
  for (const FrameOfCurve* f : frames) {
    const StoredFrame frame(f->file);
    const DisplayUnit unit = display_unit(size_of(frame).maxCoeff(), "m");
    chart.x.title = fmt::format("{} [{}]", name_of(along), unit.name);
    std::vector<std::pair<double, double>> points;
    for (const FieldSlice::Cell& face : frame.faces("damage"))
      points.emplace_back(unit.factor * centre_of(face)[along], face.value);
    chart.series.push_back(series_of(std::move(points)));
    chart.series.back().label = state_of(f->row);
    chart.series.back().colour = static_cast<int>(chart.series.size()) - 1;
  }
  return chart;
}

}  // namespace

std::vector<PageBlock> interface_pictures(const std::vector<CurveRow>& curve, const std::filesystem::path& results) {
  constexpr double narrow = 0.1;
  const std::vector<FrameOfCurve> frames = frames_of(stored_interfaces(results), curve);
  if (frames.empty()) return {};
  std::vector<const FrameOfCurve*> shown{&frames.back()};
  if (const FrameOfCurve* half = frame_half_way(frames)) shown.insert(shown.begin(), half);
  const StoredFrame last(frames.back().file);
  const int axis = axis_of_view(last);
  Vector::Index along = 0;
  Vector size = size_of(last);
  const double length = size.maxCoeff(&along);
  size[along] = 0.0;
  if (size.maxCoeff() < narrow * length) return {profiles_of_strip(shown, static_cast<int>(along))};
  std::vector<PageBlock> pictures;
  for (const FrameOfCurve* f : shown) pictures.emplace_back(view_of(*f, axis));
  return pictures;
}

std::vector<PageBlock> damage_pictures(const FractureCase& fracture, const std::vector<CurveRow>& curve,
                                       const std::filesystem::path& results) {
  const std::vector<FrameOfCurve> frames = frames_of(stored_steps(results), curve);
  const bool only_interfaces_break = !fracture.interfaces.empty() && curve.back().energy.fracture == 0.0;
  if (frames.empty() || only_interfaces_break) return {};
  const StoredFrame last(frames.back().file);
  const std::vector<int> axes = axes_of(last);
  if (axes.size() == 1) return {profiles_of_bar(frames, axes[0], (axes[0] + 1) % 3)};
  if (axes.size() == 2) return pictures_of_plate(frames, axes[0], axes[1]);
  return pictures_of_body(fracture, frames.back());
}

}  // namespace pfdm
