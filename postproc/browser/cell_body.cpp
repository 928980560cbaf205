#include "postproc/browser/cell_body.h"

#include "mesh/bounding_box.h"
#include "physics/error.h"
#include "physics/pseudo_inverse.h"
#include "postproc/browser/body_part.h"
#include "postproc/fields/stored_cells.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

/// Each once, without a cell itself.
std::vector<Index> cells_around(Index cell, const std::vector<Index>& corners,
                                const std::vector<std::vector<Index>>& cells_of_point) {
  std::vector<Index> around;
  for (const Index p : corners) around.insert(around.end(), cells_of_point[p].begin(), cells_of_point[p].end());
  std::ranges::sort(around);
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::erase(around, cell);
  return around;
}

std::vector<Vector> vectors_of(const StoredCells& frame, const std::string& array) {
  std::vector<Vector> vectors(static_cast<std::size_t>(frame.n_cells()));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> values = frame.values(array, axis);
    for (std::size_t c = 0; c < vectors.size(); ++c) vectors[c][axis] = values[c];
  }
  return vectors;
}

/// Of the body's points the displacement of those in the file.
void add_motion(Body& body, const StoredCells& frame, const BodyPart& part, const std::string& array) {
  std::vector<std::vector<Index>> cells(static_cast<std::size_t>(frame.n_cells()));
  std::vector<Index> faces, in_file;
  for (Index c = 0; c < frame.n_cells(); ++c) {
    frame.append_corners(c, cells[c], faces);
    std::ranges::sort(cells[c]);  // those of a polyhedron are there for each face
    cells[c].erase(std::unique(cells[c].begin(), cells[c].end()), cells[c].end());
  }
  for (const Index c : part.cells) frame.append_corners(c, in_file, faces);
  const std::vector<Vector> moved = displacement_of_points(frame.points(), cells, vectors_of(frame, array));
  std::vector<Vector> displacement(body.points.size(), Vector::Zero());
  for (std::size_t i = 0; i < in_file.size(); ++i) displacement[body.corners[i]] = moved[in_file[i]];
  body.displacement.push_back(std::move(displacement));
}

}  // namespace

std::vector<Vector> displacement_of_points(const std::vector<Vector>& points,
                                           const std::vector<std::vector<Index>>& cells,
                                           const std::vector<Vector>& displacement) {
  std::vector<std::vector<Index>> cells_of_point(points.size());
  std::vector<Vector> centre(cells.size(), Vector::Zero());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const Index p : cells[c]) {
      cells_of_point[p].push_back(static_cast<Index>(c));
      centre[c] += points[p] / static_cast<double>(cells[c].size());
    }
  std::vector<Vector> moved(points.size(), Vector::Zero());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Tensor squares = Tensor::Zero(), differences = Tensor::Zero();
    for (const Index n : cells_around(static_cast<Index>(c), cells[c], cells_of_point)) {
      const Vector d = centre[n] - centre[c];
      squares += d * d.transpose();
      differences += (displacement[n] - displacement[c]) * d.transpose();
    }
    constexpr double nothing = 1e-9;
    const Tensor gradient = differences * pseudo_inverse(squares, nothing);
    for (const Index p : cells[c])
      moved[p] +=
          (displacement[c] + gradient * (points[p] - centre[c])) / static_cast<double>(cells_of_point[p].size());
  }
  return moved;
}

Body read_cell_body(const CellBodySettings& settings) {
  const StoredCells first(settings.frames.front().file);
  const auto [lower, upper] = bounding_box(first.points());
  const Vector middle = 0.5 * (lower + upper);
  const BodyPart part = part_of(first, first.points(), middle, settings.most_cells);
  Body body = resting_body(first, part);
  body.cut_at = middle;
  body.cut_axis = -1;
  body.component = settings.component;
  body.vibrates = !settings.real.empty();
  body.regions = first.regions();
  for (const CellFieldShown& shown : settings.fields)
    body.fields.push_back({.name = shown.name, .si_unit = shown.si_unit, .frames = {}});
  for (const BodyFrame& given : settings.frames) {
    const StoredCells frame(given.file);
    if (frame.n_cells() != first.n_cells())
      throw InputError(fmt::format("{}: it has {} cells, {} has {}", given.file.string(), frame.n_cells(),
                                   settings.frames.front().file.string(), first.n_cells()));
    for (std::size_t k = 0; k < settings.fields.size(); ++k) {
      const std::vector<double> values = frame.values(settings.fields[k].array);
      std::vector<double>& kept = body.fields[k].frames.emplace_back();
      for (const Index cell : part.cells) kept.push_back(values[cell]);
    }
    body.steps.push_back(given.step);
  }
  if (!body.vibrates) {
    body.displacement.assign(body.steps.size(), std::vector<Vector>(body.points.size(), Vector::Zero()));
    return body;
  }
  const StoredCells last(settings.frames.back().file);
  for (const std::string& array : {settings.real, settings.imaginary}) add_motion(body, last, part, array);
  return body;
}

}  // namespace pfdm
