#include "mesh/generators/box_hexes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/generators/expected_cells.h"
#include "mesh/patch_rules.h"
#include "physics/error.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

using Position = std::array<Index, 3>;  // of a node in the grid

class BoxGrid {
 public:
  explicit BoxGrid(const BoxHexesSettings& settings) {
    double cells = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      nodes_[a] = axis_nodes(settings.origin[a], settings.axes[a], fmt::format("the box along {}", "xyz"[a]));
      cells *= static_cast<double>(nodes_[a].size());
    }
    require_memory_for(cells, "the box");
  }

  Index n_cells(std::size_t axis) const { return count_of(nodes_[axis]) - 1; }
  const std::vector<double>& nodes(std::size_t axis) const { return nodes_[axis]; }
  Vector lower() const { return {nodes_[0].front(), nodes_[1].front(), nodes_[2].front()}; }
  Vector upper() const { return {nodes_[0].back(), nodes_[1].back(), nodes_[2].back()}; }
  Vector node(Index i, Index j, Index k) const { return {nodes_[0][i], nodes_[1][j], nodes_[2][k]}; }
  Vector centre(Index i, Index j, Index k) const { return 0.5 * (node(i, j, k) + node(i + 1, j + 1, k + 1)); }
  Index id(Index i, Index j, Index k) const { return i + (n_cells(0) + 1) * (j + (n_cells(1) + 1) * k); }
  std::array<Position, 8> corners(Index i, Index j, Index k) const {
    return {{{i, j, k},
             {i + 1, j, k},
             {i + 1, j + 1, k},
             {i, j + 1, k},
             {i, j, k + 1},
             {i + 1, j, k + 1},
             {i + 1, j + 1, k + 1},
             {i, j + 1, k + 1}}};
  }

 private:
  std::array<std::vector<double>, 3> nodes_;
};

Index region_slot(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<Index>(found - names.begin());
  names.push_back(name);
  return static_cast<Index>(names.size() - 1);
}

bool lies_in(const SubRegion& region, const Vector& x) {
  return (x.array() >= region.lower.array()).all() && (x.array() <= region.upper.array()).all();
}

// The last of the regions in which x lies, counted from 1; 0 where only the base region is left.
std::size_t number_at(const BoxHexesSettings& settings, const Vector& x) {
  std::size_t i = settings.regions.size();
  while (i > 0 && !lies_in(settings.regions[i - 1], x)) --i;
  return i;
}

const std::string& region_at(const BoxHexesSettings& settings, const Vector& x) {
  const std::size_t i = number_at(settings, x);
  return i > 0 ? settings.regions[i - 1].name : settings.base_region;
}

template <class Function>
void for_each_cell(const BoxGrid& grid, Function&& function) {
  for (Index k = 0; k < grid.n_cells(2); ++k)
    for (Index j = 0; j < grid.n_cells(1); ++j)
      for (Index i = 0; i < grid.n_cells(0); ++i) function(i, j, k);
}

// The cells that no hole takes.
template <class Function>
void for_each_cell_left(const BoxHexesSettings& settings, const BoxGrid& grid, Function&& function) {
  for_each_cell(grid, [&](Index i, Index j, Index k) {
    const Vector centre = grid.centre(i, j, k);
    if (std::ranges::none_of(settings.holes, [&](const SubRegion& hole) { return lies_in(hole, centre); }))
      function(i, j, k);
  });
}

// Region names in the settings' order, so that their numbers do not depend on where the cells lie.
std::vector<std::string> names_in_use(const BoxHexesSettings& settings, const BoxGrid& grid) {
  std::vector<bool> used(settings.regions.size() + 1, false);
  for_each_cell_left(settings, grid,
                     [&](Index i, Index j, Index k) { used[number_at(settings, grid.centre(i, j, k))] = true; });
  std::vector<std::string> names;
  if (used[0]) names.push_back(settings.base_region);
  for (std::size_t i = 0; i < settings.regions.size(); ++i) {
    const std::string& name = settings.regions[i].name;
    if (!used[i + 1])
      throw InputError(fmt::format(
          "region \"{}\", number {} of the list, contains no cell's centre that later regions and holes leave to it",
          name, i + 1));
    region_slot(names, name);
  }
  return names;
}

// A slit on the grid: nodes [first, last] of the axes, first = last along the normal.
struct GridSlit {
  std::size_t normal = 0;
  Position first{}, last{};

  bool holds(const Position& p) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (p[a] < first[a] || p[a] > last[a]) return false;
    return true;
  }
  // Whether the body separates there: not on the crack front, the slit's edges within the box.
  bool opens(const Position& p, const BoxGrid& grid) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (a == normal) continue;
      const bool in_front = (p[a] == first[a] && first[a] > 0) || (p[a] == last[a] && last[a] < grid.n_cells(a));
      if (in_front) return false;
    }
    return holds(p);
  }
};

// The node at x, or the box's end beyond which x lies.
Index node_at(const BoxGrid& grid, const Slit& slit, std::size_t axis, double x) {
  const std::vector<double>& nodes = grid.nodes(axis);
  const double rounding = 1e-9 * (nodes.back() - nodes.front());
  if (x < nodes.front()) return 0;
  if (x > nodes.back()) return grid.n_cells(axis);
  const auto above = std::ranges::lower_bound(nodes, x - rounding);
  if (*above <= x + rounding) return static_cast<Index>(above - nodes.begin());
  throw InputError(fmt::format("slit \"{}\": {} = {} is not a plane of the grid; the nearest are {}", slit.name,
                               "xyz"[axis], quantity_text(x, "m", 6),
                               quantities_text({*(above - 1), *above}, "m", " and ", 6)));
}

GridSlit on_grid(const Slit& slit, const BoxGrid& grid) {
  const double rounding = 1e-9 * (grid.upper() - grid.lower()).norm();
  GridSlit result;
  int n_normals = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double lower = slit.lower[a], upper = slit.upper[a];
    if (!(upper >= lower - rounding))
      throw InputError(
          fmt::format("slit \"{}\": its lower corner lies above its upper one along {}", slit.name, "xyz"[a]));
    if (upper - lower <= rounding) result.normal = a, ++n_normals;
    result.first[a] = node_at(grid, slit, a, lower);
    result.last[a] = node_at(grid, slit, a, upper);
  }
  if (n_normals != 1)
    throw InputError(fmt::format("slit \"{}\": its corners must agree along exactly one axis, its normal", slit.name));
  for (std::size_t a = 0; a < 3; ++a) {
    const bool inside = result.first[a] > 0 && result.last[a] < grid.n_cells(a);
    const Index width = result.last[a] - result.first[a];
    if (a == result.normal && !inside)
      throw InputError(fmt::format("slit \"{}\" lies on or beyond the surface of the box", slit.name));
    if (a != result.normal && width < (inside ? 2 : 1))
      throw InputError(fmt::format(
          "slit \"{}\" is too narrow to open: it needs two cells across, or one at the surface of the box", slit.name));
  }
  return result;
}

// Points of the upper sides of the slits, behind those of the grid.
class SlitPoints {
 public:
  SlitPoints(const BoxHexesSettings& settings, const BoxGrid& grid, std::vector<Vector>& points) : grid_(grid) {
    for (const Slit& slit : settings.slits) {
      slits_.push_back(on_grid(slit, grid));
      const GridSlit& on = slits_.back();
      for (Index k = on.first[2]; k <= on.last[2]; ++k)
        for (Index j = on.first[1]; j <= on.last[1]; ++j)
          for (Index i = on.first[0]; i <= on.last[0]; ++i) add({i, j, k}, slit, points);
    }
  }

  // The point of node p that a cell at the given position, that of its lower corner, has.
  Index point(const Position& cell, const Position& p) const {
    const Index id = grid_.id(p[0], p[1], p[2]);
    const auto copy = copies_.find(id);
    if (copy == copies_.end()) return id;
    const auto& [slit, upper] = copy->second;
    const std::size_t normal = slits_[slit].normal;
    return upper >= 0 && cell[normal] >= p[normal] ? upper : id;
  }

 private:
  struct Copy {
    std::size_t slit;
    Index point;  // -1 on the front
  };

  void add(const Position& p, const Slit& slit, std::vector<Vector>& points) {
    const bool opens = slits_.back().opens(p, grid_);
    const Copy copy{slits_.size() - 1, opens ? count_of(points) : -1};
    if (!copies_.emplace(grid_.id(p[0], p[1], p[2]), copy).second)
      throw InputError(fmt::format("slit \"{}\" meets another slit", slit.name));
    if (opens) points.push_back(grid_.node(p[0], p[1], p[2]));
  }

  const BoxGrid& grid_;
  std::vector<GridSlit> slits_;
  std::map<Index, Copy> copies_;
};

// The surface that a hole leaves: the faces on the hull of the cells that it takes.
PatchRule hole_patch(const SubRegion& hole, const BoxGrid& grid, double rounding) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Vector lower = Vector::Constant(none), upper = Vector::Constant(-none);
  for_each_cell(grid, [&](Index i, Index j, Index k) {
    if (!lies_in(hole, grid.centre(i, j, k))) return;
    lower = lower.cwiseMin(grid.node(i, j, k));
    upper = upper.cwiseMax(grid.node(i + 1, j + 1, k + 1));
  });
  if (!(lower.x() < upper.x()))
    throw InputError(fmt::format("hole \"{}\" of the box contains no cell's centre", hole.name));
  return patch_within(hole.name, lower, upper, rounding);
}

std::vector<PatchRule> patches_of(const BoxHexesSettings& settings, const BoxGrid& grid) {
  const double rounding = 1e-9 * (grid.upper() - grid.lower()).norm();
  std::vector<PatchRule> patches;
  for (const SurfacePart& part : settings.patches)
    patches.push_back(patch_within(part.name, part.lower, part.upper, rounding));
  for (const SubRegion& hole : settings.holes) patches.push_back(hole_patch(hole, grid, rounding));
  std::vector<PatchRule> sides = box_patches(grid.lower(), grid.upper());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    PatchRule& side = sides[i];
    side.name = settings.sides[i];
    side.required = settings.holes.empty() && settings.patches.empty();
    patches.push_back(std::move(side));
  }
  for (const Slit& slit : settings.slits) patches.push_back(patch_within(slit.name, slit.lower, slit.upper, rounding));
  return patches;
}

// Points that no cell has go.
void drop_unused_points(CellSoup& soup) {
  std::vector<Index> number(soup.points.size(), -1);
  for (const Index p : soup.cell_points) number[p] = 0;
  Index n_used = 0;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    soup.points[n_used] = soup.points[p];
    number[p] = n_used++;
  }
  soup.points.resize(n_used);
  for (Index& p : soup.cell_points) p = number[p];
}

}  // namespace

Mesh make_box_hexes(const BoxHexesSettings& settings) {
  const BoxGrid grid(settings);
  CellSoup soup;
  for (Index k = 0; k <= grid.n_cells(2); ++k)
    for (Index j = 0; j <= grid.n_cells(1); ++j)
      for (Index i = 0; i <= grid.n_cells(0); ++i) soup.points.push_back(grid.node(i, j, k));
  soup.region_names = names_in_use(settings, grid);
  const SlitPoints slits(settings, grid, soup.points);
  for_each_cell_left(settings, grid, [&](Index i, Index j, Index k) {
    const Index region = region_slot(soup.region_names, region_at(settings, grid.centre(i, j, k)));
    std::array<Index, 8> corners;
    std::ranges::transform(grid.corners(i, j, k), corners.begin(), [&](const Position& p) {
      return slits.point({i, j, k}, p);
    });
    soup.add_cell(CellShape::hexahedron, corners, region);
  });
  if (!settings.holes.empty()) drop_unused_points(soup);
  return assemble_mesh(std::move(soup), patches_of(settings, grid));
}

}  // namespace pfdm
