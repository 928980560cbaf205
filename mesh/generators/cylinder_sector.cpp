#include "mesh/generators/cylinder_sector.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

// Where a point of the flat grid comes to lie.
class Rolling {
 public:
  explicit Rolling(const CylinderSectorSettings& settings)
      : outer_(axis_nodes(settings.inner_radius, settings.radius, "the sector along its radius").back()),
        bottom_(settings.bottom),
        height_(axis_nodes(0.0, settings.height, "the sector along its height").back()),
        sphere_(settings.upper_sphere) {
    if (sphere_ != 0.0 && !(sphere_ > outer_))
      throw InputError(fmt::format(
          "the sphere of the sector's upper end has a radius of {}; it must be larger than that of the sector, {}",
          quantity_text(sphere_, "m", 6), quantity_text(outer_, "m", 6)));
  }

  Vector operator()(const Vector& flat) const {
    const double r = flat.x(), phi = flat.y() / outer_;
    return {r * portable::cos(phi), r * portable::sin(phi), bottom_ + (flat.z() - bottom_) * stretch(r)};
  }

  double outer_radius() const { return outer_; }

 private:
  double stretch(double r) const {
    return sphere_ > 0.0 ? 1.0 + r * r / (sphere_ + std::sqrt(sphere_ * sphere_ - r * r)) / height_ : 1.0;
  }

  double outer_, bottom_, height_, sphere_;
};

// The grid before it is rolled up: x is the radius, y the arc at the outer radius, z the height.
BoxHexesSettings flat_grid(const CylinderSectorSettings& settings, double outer_radius) {
  const double arc = settings.azimuth * outer_radius;
  const auto flat = [](const std::vector<SectorPart>& parts, double y, auto kind) {
    std::vector<decltype(kind)> boxes;
    boxes.reserve(parts.size());
    for (const SectorPart& p : parts)
      boxes.push_back({p.name, {p.inner_radius, -y, p.bottom}, {p.outer_radius, y, p.top}});
    return boxes;
  };
  return {.origin = {settings.inner_radius, -0.5 * arc, settings.bottom},
          .axes = {settings.radius, {{arc, 1, 1.0}}, settings.height},
          .regions = flat(settings.regions, arc, SubRegion{}),
          .base_region = settings.base_region,
          .slits = flat(settings.slits, arc, Slit{}),
          .holes = flat(settings.holes, arc, SubRegion{}),
          .patches = flat(settings.patches, 0.25 * arc, SurfacePart{}),  // none of front and back
          .sides = {"inner", "outer", "front", "back", "bottom", "top"}};
}

// Rolls the flat grid up. Of a cell on the axis the corners 3 and 7 fall on 0 and 4.
class RolledGrid {
 public:
  RolledGrid(const Mesh& flat, const Rolling& rolled) : flat_(flat), number_(flat.points.size(), -1) {
    soup_.region_names = flat.region_names;
    for (Index c = 0; c < flat.n_cells(); ++c) add_cell(c, rolled);
  }

  Mesh mesh() && {
    const std::vector<PatchRule> rules = patches();
    return assemble_mesh(std::move(soup_), rules);
  }

 private:
  void add_cell(Index cell, const Rolling& rolled);

  Index number(Index point, const Rolling& rolled) {
    Index& n = number_[point];
    if (n >= 0) return n;
    n = count_of(soup_.points);
    soup_.points.push_back(rolled(flat_.points[point]));
    return n;
  }

  // The points of a face without those that fall on others.
  std::vector<Index> points_of(Index face) const {
    std::set<Index> points;
    for (const Index p : flat_.points_of_face(face)) points.insert(number_[p]);
    return {points.begin(), points.end()};
  }

  std::vector<PatchRule> patches() const;

  const Mesh& flat_;
  CellSoup soup_;
  std::vector<Index> number_;  // of the flat grid's points in the soup
};

void RolledGrid::add_cell(Index cell, const Rolling& rolled) {
  const auto p = flat_.points_of_cell(cell);
  const bool on_axis = flat_.points[p[0]].x() == 0.0;
  if (on_axis) {
    number_[p[3]] = number(p[0], rolled);
    number_[p[7]] = number(p[4], rolled);
  }
  std::array<Index, 8> n;
  std::ranges::transform(p, n.begin(), [&](Index point) { return number(point, rolled); });
  if (on_axis)
    soup_.add_cell(CellShape::wedge, std::array{n[4], n[5], n[6], n[0], n[1], n[2]}, flat_.region[cell]);
  else
    soup_.add_cell(CellShape::hexahedron, n, flat_.region[cell]);
}

// Those of the flat grid; faces that the axis takes away have two points left.
std::vector<PatchRule> RolledGrid::patches() const {
  std::vector<PatchRule> rules;
  for (const Patch& patch : flat_.patches) {
    std::set<std::vector<Index>> faces;
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      if (std::vector<Index> face = points_of(f); face.size() > 2) faces.insert(std::move(face));
    if (faces.empty()) continue;
    rules.push_back(
        {patch.name, [faces = std::move(faces)](const Vector&, const Vector&, std::span<const Index> points) {
           std::vector<Index> face(points.begin(), points.end());
           std::ranges::sort(face);
           return faces.contains(face);
         }});
  }
  return rules;
}

}  // namespace

Mesh make_cylinder_sector(const CylinderSectorSettings& settings) {
  check_sector(settings.azimuth, settings.inner_radius);
  const Rolling rolled(settings);
  const Mesh flat = make_box_hexes(flat_grid(settings, rolled.outer_radius()));
  return RolledGrid(flat, rolled).mesh();
}

}  // namespace pfdm
