#include "mesh/generators/sphere_sector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/error.h"
#include "physics/portable_math.h"

namespace pfdm {
namespace {

constexpr double pi = std::numbers::pi;

class SectorGrid {
 public:
  explicit SectorGrid(const SphereSectorSettings& settings) : half_azimuth_(0.5 * settings.azimuth) {
    check_sector(settings.azimuth, settings.inner_radius);
    std::vector<AxisBlock> radial;
    for (const Shell& shell : settings.shells) radial.push_back(shell.radial);
    radii_ = axis_nodes(settings.inner_radius, radial, "the sector along its radius");
    polar_ = axis_nodes(0.0, settings.polar, "the sector along the polar angle");
    snap_polar_end();
    if (24.0 * static_cast<double>(radii_.size()) * static_cast<double>(polar_.size()) >
        std::numeric_limits<Index>::max())
      throw InputError("the sector would have too many cells to number");
    place_points();
  }

  Index n_radial() const { return count_of(radii_) - 1; }
  Index n_polar() const { return count_of(polar_) - 1; }
  const std::vector<Vector>& points() const { return points_; }
  bool is_half() const { return polar_.back() < pi; }

  void add_cell(CellSoup& soup, Index i, Index j, Index region) const;
  std::vector<PatchRule> patches() const;

 private:
  struct Node {
    Index radial, polar, side;  // side 0: y < 0, 1: y > 0
  };

  // Rounding of degrees must not leave a gap at the axis or tilt the equator.
  void snap_polar_end() {
    double& end = polar_.back();
    for (const double whole : {0.5 * pi, pi})
      if (std::abs(end - whole) < 1e-6) {
        end = whole;
        return;
      }
    throw InputError(
        fmt::format("the sector's polar angles add up to {:.6g} degrees; 90 (half of a sphere) or 180 are allowed",
                    end * 180.0 / pi));
  }

  bool on_axis(Index polar) const { return polar == 0 || (polar == n_polar() && !is_half()); }
  bool is_centre(Index radial) const { return radial == 0 && radii_.front() == 0.0; }

  void place_points() {
    ids_.assign(2 * radii_.size() * polar_.size(), -1);
    for (Index i = 0; i <= n_radial(); ++i)
      for (Index j = 0; j <= n_polar(); ++j)
        for (Index side = 0; side < 2; ++side) place({i, j, side});
  }

  // The centre is one point, as are the two sides of a node on the axis.
  void place(const Node& node) {
    Index& id = ids_[slot(node)];
    if (is_centre(node.radial) && slot(node) > 0)
      id = 0;
    else if (on_axis(node.polar) && node.side == 1)
      id = ids_[slot({node.radial, node.polar, 0})];
    else {
      id = count_of(points_);
      points_.push_back(position(node));
    }
  }

  Vector position(const Node& node) const {
    const double r = radii_[node.radial], theta = polar_[node.polar];
    const double phi = node.side == 0 ? -half_azimuth_ : half_azimuth_;
    const bool quarter = node.polar == n_polar() && is_half();
    const double s = on_axis(node.polar) ? 0.0 : portable::sin(theta), c = quarter ? 0.0 : portable::cos(theta);
    return {r * s * portable::cos(phi), r * s * portable::sin(phi), r * c};
  }

  std::size_t slot(const Node& n) const {
    return 2 * (as_size(n.radial) * polar_.size() + as_size(n.polar)) + as_size(n.side);
  }
  Index point(Index radial, Index polar, Index side) const { return ids_[slot({radial, polar, side})]; }

  double half_azimuth_;
  std::vector<double> radii_, polar_;  // of the nodes [m], [rad]
  std::vector<Index> ids_;             // point of each node
  std::vector<Vector> points_;
};

// Hexahedra, of which points coincide on the axis and at the centre. VTK's order: the first triangle of a wedge looks
// outwards, the base of a pyramid to its apex.
void SectorGrid::add_cell(CellSoup& soup, Index i, Index j, Index region) const {
  const auto p = [&](Index di, Index dj, Index side) { return point(i + di, j + dj, side); };
  const bool tip = is_centre(i), first = on_axis(j), last = on_axis(j + 1);
  const auto add = [&](CellShape shape, std::initializer_list<Index> points) {
    soup.add_cell(shape, std::vector<Index>(points), region);
  };
  if (tip && first) return add(CellShape::tetrahedron, {p(1, 0, 0), p(1, 1, 1), p(1, 1, 0), p(0, 0, 0)});
  if (tip && last) return add(CellShape::tetrahedron, {p(1, 1, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 0)});
  if (tip) return add(CellShape::pyramid, {p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0), p(0, 0, 0)});
  if (first) return add(CellShape::wedge, {p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(0, 0, 0), p(0, 1, 0), p(0, 1, 1)});
  if (last) return add(CellShape::wedge, {p(1, 1, 0), p(1, 0, 1), p(1, 0, 0), p(0, 1, 0), p(0, 0, 1), p(0, 0, 0)});
  add(CellShape::hexahedron,
      {p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1), p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)});
}

std::vector<PatchRule> SectorGrid::patches() const {
  const auto looks_along = [](const Vector& wanted) {
    return [wanted](const Vector&, const Vector& normal, std::span<const Index>) {
      return normal.dot(wanted) > 1.0 - 1e-9;
    };
  };
  const auto looks_out = [](double sign) {
    return [sign](const Vector& centre, const Vector& normal, std::span<const Index>) {
      return sign * normal.dot(centre) > 0.5 * centre.norm();
    };
  };
  const double s = portable::sin(half_azimuth_), c = portable::cos(half_azimuth_);
  std::vector<PatchRule> rules{{"front", looks_along({-s, -c, 0.0})}, {"back", looks_along({-s, c, 0.0})}};
  if (is_half()) rules.push_back({"equator", looks_along({0.0, 0.0, -1.0})});
  rules.push_back({"outer", looks_out(1.0)});
  if (radii_.front() > 0.0) rules.push_back({"inner", looks_out(-1.0)});
  return rules;
}

std::vector<std::string> names_of(const std::vector<Shell>& shells) {
  std::vector<std::string> names;
  for (const Shell& shell : shells)
    if (std::ranges::find(names, shell.region) == names.end()) names.push_back(shell.region);
  return names;
}

}  // namespace

Mesh make_sphere_sector(const SphereSectorSettings& settings) {
  const SectorGrid grid(settings);
  CellSoup soup;
  soup.points = grid.points();
  soup.region_names = names_of(settings.shells);
  Index i = 0;
  for (const Shell& shell : settings.shells) {
    const Index region =
        static_cast<Index>(std::ranges::find(soup.region_names, shell.region) - soup.region_names.begin());
    for (const Index end = i + shell.radial.n; i < end; ++i)
      for (Index j = 0; j < grid.n_polar(); ++j) grid.add_cell(soup, i, j, region);
  }
  return assemble_mesh(std::move(soup), grid.patches());
}

}  // namespace pfdm
