#include "postproc/browser/body_json.h"

#include "postproc/browser/packing.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

/// Puts parts beside and says where they are.
class Packer {
 public:
  /// `n_before`: parts that the page has already.
  Packer(std::vector<PagePart>& parts, std::size_t n_before) : parts_(parts), n_before_(n_before) {}

  Json add(const std::vector<std::vector<double>>& blocks) {
    const Quantised numbers = quantised(blocks);
    return {{"id", keep(packed(numbers))}, {"from", numbers.from}, {"to", numbers.to}};
  }
  Json add(const std::vector<Index>& numbers) {
    return {{"id", keep(packed(std::span(numbers)))}, {"n", numbers.size()}};
  }
  Json add(const std::vector<std::uint8_t>& octets) { return {{"id", keep(packed(std::span(octets)))}}; }

 private:
  std::string keep(std::string base64) {
    parts_.push_back({.id = fmt::format("part-{}", n_before_ + parts_.size()), .base64 = std::move(base64)});
    return parts_.back().id;
  }
  std::vector<PagePart>& parts_;
  std::size_t n_before_;
};

std::vector<double> component(const std::vector<Vector>& vectors, Eigen::Index axis) {
  std::vector<double> values;
  values.reserve(vectors.size());
  for (const Vector& v : vectors) values.push_back(v[axis]);
  return values;
}

Json unit_json(const DisplayUnit& unit) { return {{"factor", unit.factor}, {"name", unit.name}}; }

double largest(const std::vector<std::vector<double>>& blocks) {
  double most = 0.0;
  for (const auto& block : blocks)
    for (const double value : block)
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

Json field_json(const BodyField& field, Packer& packer) {
  const DisplayUnit unit = field.si_unit.empty() ? DisplayUnit{} : display_unit(largest(field.frames), field.si_unit);
  return {{"name", field.name}, {"unit", unit.name}, {"factor", unit.factor}, {"values", packer.add(field.frames)}};
}

Json vector_json(const Vector& v) { return Json::array({v.x(), v.y(), v.z()}); }

constexpr std::size_t room_of_whole = 4200000, room_of_part = 18000000;  // [byte]

template <class T>
void keep_only(std::vector<T>& frames, const std::vector<std::size_t>& kept) {
  std::vector<T> rest;
  for (const std::size_t i : kept) rest.push_back(std::move(frames[i]));
  frames = std::move(rest);
}

/// So many of the frames, evenly.
void thin_out(Body& body, std::vector<Index>& numbers, std::size_t count) {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < count; ++k) kept.push_back(k * (body.steps.size() - 1) / (count - 1));
  keep_only(body.steps, kept);
  keep_only(numbers, kept);
  if (!body.vibrates) keep_only(body.displacement, kept);
  for (BodyField& field : body.fields) keep_only(field.frames, kept);
}

std::size_t size_of(const std::vector<PagePart>& parts) {
  std::size_t size = 0;
  for (const PagePart& part : parts) size += part.base64.size();
  return size;
}

Json whole_json(const Body& body, std::vector<PagePart>& parts, std::size_t n_before) {
  Packer packer(parts, n_before);
  Json points = Json::array(), displacement = Json::array(), fields = Json::array();
  double most_moved = 0.0, longest = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    points.push_back(packer.add({component(body.points, axis)}));
    std::vector<std::vector<double>> moved;
    for (const auto& frame : body.displacement) moved.push_back(component(frame, axis));
    most_moved = std::max(most_moved, largest(moved));
    displacement.push_back(packer.add(moved));
    longest = std::max(longest, points.back()["to"].get<double>() - points.back()["from"].get<double>());
  }
  for (const BodyField& field : body.fields) fields.push_back(field_json(field, packer));
  return {{"regions", body.regions},
          {"n_points", body.points.size()},
          {"shape", packer.add(body.shape)},
          {"region", packer.add(body.region)},
          {"corners", packer.add(body.corners)},
          {"stream", packer.add(body.faces)},
          {"base", packer.add(body.place)},
          {"open", body.is_surface.empty() ? Json(nullptr) : packer.add(body.is_surface)},
          {"points", std::move(points)},
          {"displacement", std::move(displacement)},
          {"fields", std::move(fields)},
          {"frames", body.steps},
          {"cuts", body.is_surface.empty() ? "free" : "fixed"},
          {"cut_axis", body.cut_axis.value_or(body.component == 1 ? 2 : 1)},
          {"cut_at", vector_json(body.cut_at)},
          {"component", body.component},
          {"flat_axis", body.flat_axis},
          {"vibrates", body.vibrates},
          {"displacement_unit", unit_json(display_unit(most_moved, "m"))},
          {"length_unit", unit_json(display_unit(longest, "m"))}};
}

}  // namespace

Json body_json(Body body, std::vector<PagePart>& parts, std::size_t most_bytes, std::vector<Index>* kept) {
  const std::size_t room = most_bytes > 0 ? most_bytes : body.is_surface.empty() ? room_of_whole : room_of_part;
  std::vector<Index> numbers(body.steps.size());
  std::iota(numbers.begin(), numbers.end(), Index{0});
  while (true) {
    std::vector<PagePart> own;
    Json json = whole_json(body, own, parts.size());
    const std::size_t n = body.steps.size(), size = size_of(own);
    if (size <= room || n <= 2) {
      if (kept != nullptr) *kept = std::move(numbers);
      parts.insert(parts.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
      return json;
    }
    thin_out(body, numbers, std::clamp<std::size_t>(n * room / size, 2, n - 1));
  }
}

}  // namespace pfdm
