#include "postproc/displacements/field_thinning.h"

#include "mesh/bounding_box.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/displacements/field_outliers.h"
#include "postproc/displacements/field_squares.h"
#include "postproc/displacements/place_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace pfdm {
namespace {

constexpr double rounding_of_place = 1e-4;  // of the size of the mesh
constexpr std::size_t fewest = 3;           // places in a frame

bool is_masked(const std::vector<MaskedStrip>& strips, const Vector& x) {
  return std::ranges::any_of(strips, [&](const MaskedStrip& strip) {
    const Vector along = strip.to - strip.from;
    const double length = along.squaredNorm();
    const double share = length > 0.0 ? std::clamp(along.dot(x - strip.from) / length, 0.0, 1.0) : 0.0;
    return (x - strip.from - share * along).norm() < strip.within;
  });
}

/// What becomes of the recorded points.
class Selection {
 public:
  Selection(const RecordedField& recorded, const FieldSelection& how, const Mesh& mesh)
      : recorded_(recorded), how_(how), locator_(mesh) {
    const Box box = bounding_box(mesh.points);
    slack_ = rounding_of_place * (box.high - box.low).norm();
  }

  RecordedFrame kept(const RecordedFrame& frame, double spacing) {
    RecordedFrame inside{.name = frame.name, .displacement = frame.displacement, .points = {}, .u = {}};
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      const Vector x = recorded_.plane.at(frame.points[i]);
      const double beyond = distance_of(x);
      nearest_ = std::min(nearest_, beyond);
      if (beyond > slack_)
        ++n_outside;
      else if (is_masked(how_.masked, x))
        ++n_masked;
      else
        inside.points.push_back(frame.points[i]), inside.u.push_back(frame.u[i]);
    }
    if (!how_.drops_outliers) return inside;
    const std::vector<bool> is_outlier = outliers_of(inside, spacing, recorded_.n_components);
    RecordedFrame kept{.name = frame.name, .displacement = frame.displacement, .points = {}, .u = {}};
    for (std::size_t i = 0; i < inside.points.size(); ++i) {
      if (is_outlier[i]) {
        ++n_outliers;
        continue;
      }
      kept.points.push_back(inside.points[i]);
      kept.u.push_back(inside.u[i]);
    }
    return kept;
  }
  double nearest() const { return nearest_; }

  std::size_t n_outside = 0, n_masked = 0, n_outliers = 0;

 private:
  /// Frames mostly have the same points.
  double distance_of(const Vector& x) {
    const auto [found, is_new] = known_.try_emplace({x[0], x[1], x[2]}, 0.0);
    if (is_new) found->second = locator_.cell_at(x).second;
    return found->second;
  }

  const RecordedField& recorded_;
  const FieldSelection& how_;
  CellLocator locator_;
  double slack_ = 0.0, nearest_ = std::numeric_limits<double>::infinity();
  std::map<std::array<double, 3>, double> known_;
};

/// Side of the squares into which points fall, so that no frame has more than `most` of them; 0: each is its own.
double side_of_squares(const std::vector<RecordedFrame>& frames, double spacing, std::size_t most) {
  double side = 0.0;
  for (const RecordedFrame& frame : frames) {
    if (frame.points.size() <= most) continue;
    if (side == 0.0) side = 1.5 * spacing;
    for (;; side *= 1.05) {
      std::map<Square, int> squares;
      for (const Vector& p : frame.points) squares[square_of(p, side)] = 1;
      if (squares.size() <= most) break;
    }
  }
  return side;
}

std::vector<std::string> told_of(const Selection& s, const std::vector<RecordedFrame>& kept, double side) {
  std::vector<std::string> told;
  std::size_t n = 0;
  for (const RecordedFrame& frame : kept) n += frame.points.size();
  const auto tell = [&](std::size_t left_out, std::string_view why) {
    if (left_out > 0) told.push_back(fmt::format("{} points left out: {}", left_out, why));
  };
  tell(s.n_outside, "they lie outside of the body");
  tell(s.n_masked, "they lie in a masked strip");
  tell(s.n_outliers, "outliers from the points around them");
  if (side > 0.0)
    told.push_back(fmt::format("{} points of {} frames are averaged over squares of {}, also in what is computed", n,
                               kept.size(), quantity_text(side, "m", 3)));
  return told;
}

void require_points_in_body(const std::vector<RecordedFrame>& kept, const Selection& selection,
                            const std::string& name) {
  if (std::ranges::all_of(kept, [](const RecordedFrame& frame) { return frame.points.empty(); }) &&
      selection.nearest() > 0.0 && selection.n_outside > 0)
    throw InputError(fmt::format(
        "all points of \"{}\" lie outside of the body, the nearest by {}: see \"plane\" (origin and axes of x and y in "
        "the body), and the unit of the coordinates",
        name, quantity_text(selection.nearest(), "m", 3)));
}

void tell_of_squares(const FieldSquares& squares, std::vector<std::string>& told) {
  if (squares.n_carried() > 0)
    told.push_back(
        fmt::format("{} means lack points that other frames have, and are carried to the middle of all by the plane "
                    "through them",
                    squares.n_carried()));
  if (squares.n_own() > 0)
    told.push_back(fmt::format(
        "{} means lack more, or show no plane within the noise: each is computed at its own points", squares.n_own()));
}

}  // namespace

MeasuredField selected_field(const RecordedField& recorded, const FieldSelection& how, const Mesh& mesh,
                             std::vector<FieldPlace>& places) {
  MeasuredField field{.name = recorded.name,
                      .specimen = recorded.specimen,
                      .plane = recorded.plane,
                      .n_components = recorded.n_components,
                      .deviation = recorded.deviation,
                      .subset = recorded.subset,
                      .removes_rigid_motion = recorded.removes_rigid_motion,
                      .frames = {}};
  for (const RecordedFrame& frame : recorded.frames) field.spacing = std::max(field.spacing, spacing_of(frame.points));
  Selection selection(recorded, how, mesh);
  std::vector<RecordedFrame> kept;
  for (const RecordedFrame& frame : recorded.frames) kept.push_back(selection.kept(frame, field.spacing));
  require_points_in_body(kept, selection, recorded.name);
  const double side = side_of_squares(kept, field.spacing, how.most);
  field.pitch = side > 0.0 ? side : field.spacing;
  field.told = told_of(selection, kept, side);
  FieldSquares squares(field, kept, side, places);
  for (const RecordedFrame& frame : kept) {
    if (frame.points.size() < fewest)
      field.told.push_back(fmt::format("frame {} is left out: it has {} points", frame.name, frame.points.size()));
    else
      field.frames.push_back(squares.means(frame));
  }
  if (field.frames.empty())
    throw InputError(fmt::format("no frame of \"{}\" has {} points or more that count: {}", recorded.name, fewest,
                                 field.told.front()));
  tell_of_squares(squares, field.told);
  field.told.insert(field.told.begin(), recorded.told.begin(), recorded.told.end());
  return field;
}

}  // namespace pfdm
