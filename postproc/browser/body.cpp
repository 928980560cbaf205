#include "postproc/browser/body.h"

#include "mesh/bounding_box.h"
#include "physics/error.h"
#include "postproc/browser/body_part.h"
#include "postproc/fields/stored_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <unordered_map>

namespace pfdm {
namespace {

/// Points are parted further by every frame in which their corners are at different points of the file.
class PointParts {
 public:
  explicit PointParts(Body& body) : body_(body) {}

  /// `corners` as in the body, by the frame's numbers; `moved`: the displacement of its points.
  void add(const std::vector<Index>& corners, const std::vector<Vector>& moved) {
    std::vector<Index> first(body_.points.size(), -1);
    std::unordered_map<std::uint64_t, Index> parted;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Index& point = body_.corners[i];
      Index& seen = first[point];
      if (seen < 0) seen = corners[i];
      if (seen == corners[i]) continue;
      const auto key = (static_cast<std::uint64_t>(point) << 32U) | static_cast<std::uint32_t>(corners[i]);
      const auto [found, is_new] = parted.try_emplace(key, count_of(first));
      if (is_new) {
        split(point);
        first.push_back(corners[i]);
      }
      point = found->second;
    }
    std::vector<Vector> displacement;
    for (const Index in_frame : first)
      displacement.push_back(in_frame < 0 ? Vector(Vector::Zero()) : moved.at(in_frame));
    body_.displacement.push_back(std::move(displacement));
  }

 private:
  /// In the frames so far both parts have moved alike.
  void split(Index point) {
    body_.points.push_back(Vector(body_.points[point]));
    body_.place.push_back(Index{body_.place[point]});
    for (std::vector<Vector>& frame : body_.displacement) frame.push_back(Vector(frame[point]));
  }

  Body& body_;
};

std::vector<double> of_cells(const std::vector<double>& values, const std::vector<Index>& cells) {
  std::vector<double> chosen;
  chosen.reserve(cells.size());
  for (const Index cell : cells) chosen.push_back(values[cell]);
  return chosen;
}

std::vector<double> von_mises(const StoredCells& frame, const std::vector<Index>& cells) {
  std::array<std::vector<double>, 6> s;  // XX YY ZZ XY YZ XZ
  for (std::size_t k = 0; k < s.size(); ++k) s[k] = of_cells(frame.values("stress", static_cast<int>(k)), cells);
  std::vector<double> equivalent(cells.size());
  for (std::size_t i = 0; i < equivalent.size(); ++i) {
    const double a = s[0][i] - s[1][i], b = s[1][i] - s[2][i], c = s[2][i] - s[0][i];
    const double shear = s[3][i] * s[3][i] + s[4][i] * s[4][i] + s[5][i] * s[5][i];
    equivalent[i] = std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * shear);
  }
  return equivalent;
}

void add_fields(Body& body, const StoredCells& frame, const std::vector<Index>& cells) {
  constexpr const char* rise = "temperature_rise";
  if (body.fields.empty()) {
    if (frame.has("damage")) body.fields.push_back({.name = "damage", .si_unit = {}, .frames = {}});
    body.fields.push_back({.name = "stress, von Mises", .si_unit = "Pa", .frames = {}});
    body.fields.push_back({.name = fmt::format("stress {0}{0}", "xyz"[body.component]), .si_unit = "Pa", .frames = {}});
    if (frame.has(rise)) body.fields.push_back({.name = "temperature rise", .si_unit = "K", .frames = {}});
  }
  auto field = body.fields.begin();
  const auto add = [&](std::vector<double> values) { (field++)->frames.push_back(std::move(values)); };
  if (field->name == "damage") add(of_cells(frame.values("damage"), cells));
  add(von_mises(frame, cells));
  add(of_cells(frame.values("stress", body.component), cells));
  if (field != body.fields.end()) add(of_cells(frame.values(rise), cells));
}

/// Frames that the page has room for: 12 bytes for a point and a cell, packed to about a half and a third more as text.
std::vector<BodyFrame> taken_frames(const BodySettings& settings, const Body& body) {
  constexpr double bytes_per_value = 2.0 * 0.5 * 4.0 / 3.0;
  constexpr double more_for_part = 4.0;  // a large body may have a large page
  const double of_one = bytes_per_value * 3.0 * static_cast<double>(body.points.size() + body.shape.size());
  const double room_in_bytes = settings.most_bytes * (body.is_surface.empty() ? 1.0 : more_for_part);
  const auto room = static_cast<std::size_t>(std::max(2.0, room_in_bytes / of_one));
  std::vector<BodyFrame> taken;
  for (const std::size_t i : chosen_steps(settings.progress, room)) taken.push_back(settings.frames.at(i));
  return taken;
}

}  // namespace

Body read_body(const BodySettings& settings) {
  const StoredCells mesh(settings.mesh);
  const std::vector<Vector> points = mesh.points();
  const auto [lower, upper] = bounding_box(points);
  const Vector cut_at = settings.cut_at.value_or(0.5 * (lower + upper));
  const BodyPart part = part_of(mesh, points, cut_at, settings.most_cells);
  Body body = resting_body(mesh, part);
  body.component = settings.component;
  body.cut_at = cut_at;
  PointParts parts(body);
  for (const BodyFrame& given : taken_frames(settings, body)) {
    const StoredCells frame(given.file);
    if (frame.n_cells() != mesh.n_cells())
      throw InputError(fmt::format("{}: it has {} cells, {} has {}", given.file.string(), frame.n_cells(),
                                   settings.mesh.string(), mesh.n_cells()));
    if (body.regions.empty()) body.regions = frame.regions();
    std::vector<Index> corners, faces;
    for (const Index cell : part.cells) frame.append_corners(cell, corners, faces);
    if (corners.size() != body.corners.size() || faces != body.faces)
      throw InputError(fmt::format("{}: its cells are not those of {}", given.file.string(), settings.mesh.string()));
    parts.add(corners, frame.displacement());
    add_fields(body, frame, part.cells);
    body.steps.push_back(given.step);
  }
  return body;
}

std::vector<std::size_t> chosen_steps(const std::vector<double>& progress, std::size_t count) {
  constexpr double share_of_steps = 0.2;  // of the way, so that steps without progress count too
  constexpr std::size_t n_jumps = 3;
  const std::size_t n = progress.size();
  std::vector<std::size_t> chosen(n);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  if (n <= std::max<std::size_t>(count, 2)) return chosen;
  std::vector<double> way(n, 0.0);
  std::vector<std::size_t> jumps(chosen.begin() + 1, chosen.end());
  for (std::size_t i = 1; i < n; ++i) way[i] = way[i - 1] + std::abs(progress[i] - progress[i - 1]);
  std::ranges::stable_sort(jumps, std::greater(), [&](std::size_t i) { return way[i] - way[i - 1]; });
  const double of_step = (way.back() > 0.0 ? share_of_steps * way.back() : 1.0) / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) way[i] += of_step * static_cast<double>(i);
  chosen = {0, n - 1};
  const auto add = [&](std::size_t i) {
    if (chosen.size() < count && std::ranges::find(chosen, i) == chosen.end()) chosen.push_back(i);
  };
  for (std::size_t k = 0; k < n_jumps; ++k)  // both sides of what happens at once
    for (const std::size_t i : {jumps[k % jumps.size()] - 1, jumps[k % jumps.size()]}) add(i);
  while (chosen.size() < count) {  // the one that is farthest from all
    const auto distance = [&](std::size_t i) {
      double nearest = way.back();
      for (const std::size_t c : chosen) nearest = std::min(nearest, std::abs(way[i] - way[c]));
      return nearest;
    };
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (distance(i) > distance(farthest)) farthest = i;
    add(farthest);
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace pfdm
