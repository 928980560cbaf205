#include "mesh/box_hexes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/patch_rules.h"
#include "physics/error.h"

namespace pfdm {
namespace {

void append_block(std::vector<double>& nodes, const AxisBlock& block) {
  const double start = nodes.back();
  const double growth = block.n > 1 ? std::pow(block.ratio, 1.0 / (block.n - 1)) : 1.0;
  std::vector<double> ends(static_cast<std::size_t>(block.n));
  double sum = 0.0;
  for (Index i = 0; i < block.n; ++i) ends[i] = (sum += std::pow(growth, i));
  for (Index i = 0; i + 1 < block.n; ++i) nodes.push_back(start + block.length * ends[i] / sum);
  nodes.push_back(start + block.length);
}

std::vector<double> axis_nodes(double origin, const std::vector<AxisBlock>& blocks, char letter) {
  if (blocks.empty()) throw InputError(fmt::format("the box has no cells along {}", letter));
  std::vector<double> nodes{origin};
  for (const AxisBlock& block : blocks) {
    if (!(block.length > 0.0) || block.n < 1 || !(block.ratio > 0.0) || !std::isfinite(block.length * block.ratio))
      throw InputError(
          fmt::format("the box along {}: a block of length {:g} m, {} cells and ratio {:g}; all three must be "
                      "positive",
                      letter, block.length, block.n, block.ratio));
    append_block(nodes, block);
  }
  return nodes;
}

class BoxGrid {
 public:
  explicit BoxGrid(const BoxHexesSettings& settings) {
    double cells = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      nodes_[a] = axis_nodes(settings.origin[static_cast<Index>(a)], settings.axes[a], static_cast<char>('x' + a));
      cells *= static_cast<double>(nodes_[a].size());
    }
    if (cells * 24.0 > std::numeric_limits<Index>::max())
      throw InputError(fmt::format("the box would have about {:.3g} cells, too many to number", cells));
  }

  Index n_cells(std::size_t axis) const { return static_cast<Index>(nodes_[axis].size()) - 1; }
  Vector lower() const { return {nodes_[0].front(), nodes_[1].front(), nodes_[2].front()}; }
  Vector upper() const { return {nodes_[0].back(), nodes_[1].back(), nodes_[2].back()}; }
  Vector node(Index i, Index j, Index k) const { return {nodes_[0][i], nodes_[1][j], nodes_[2][k]}; }
  Vector centre(Index i, Index j, Index k) const { return 0.5 * (node(i, j, k) + node(i + 1, j + 1, k + 1)); }
  Index id(Index i, Index j, Index k) const { return i + (n_cells(0) + 1) * (j + (n_cells(1) + 1) * k); }
  std::array<Index, 8> corners(Index i, Index j, Index k) const {
    return {id(i, j, k),     id(i + 1, j, k),     id(i + 1, j + 1, k),     id(i, j + 1, k),
            id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)};
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

const std::string& region_at(const BoxHexesSettings& settings, const Vector& x) {
  for (auto r = settings.regions.rbegin(); r != settings.regions.rend(); ++r)
    if ((x.array() >= r->lower.array()).all() && (x.array() <= r->upper.array()).all()) return r->name;
  return settings.base_region;
}

template <class Function>
void for_each_cell(const BoxGrid& grid, Function&& function) {
  for (Index k = 0; k < grid.n_cells(2); ++k)
    for (Index j = 0; j < grid.n_cells(1); ++j)
      for (Index i = 0; i < grid.n_cells(0); ++i) function(i, j, k);
}

// Region names in the settings' order, so that their numbers do not depend on where the cells lie.
std::vector<std::string> names_in_use(const BoxHexesSettings& settings, const BoxGrid& grid) {
  std::vector<std::string> candidates{settings.base_region};
  for (const SubRegion& region : settings.regions) region_slot(candidates, region.name);
  std::vector<bool> used(candidates.size(), false);
  for_each_cell(grid, [&](Index i, Index j, Index k) {
    used[static_cast<std::size_t>(region_slot(candidates, region_at(settings, grid.centre(i, j, k))))] = true;
  });
  std::vector<std::string> names;
  for (std::size_t r = 0; r < candidates.size(); ++r) {
    if (used[r])
      names.push_back(candidates[r]);
    else if (r > 0)
      throw InputError(fmt::format("region \"{}\" of the box contains no cell's centre", candidates[r]));
  }
  return names;
}

}  // namespace

Mesh make_box_hexes(const BoxHexesSettings& settings) {
  const BoxGrid grid(settings);
  CellSoup soup;
  for (Index k = 0; k <= grid.n_cells(2); ++k)
    for (Index j = 0; j <= grid.n_cells(1); ++j)
      for (Index i = 0; i <= grid.n_cells(0); ++i) soup.points.push_back(grid.node(i, j, k));
  soup.region_names = names_in_use(settings, grid);
  for_each_cell(grid, [&](Index i, Index j, Index k) {
    const Index region = region_slot(soup.region_names, region_at(settings, grid.centre(i, j, k)));
    soup.add_cell(CellShape::hexahedron, grid.corners(i, j, k), region);
  });
  return assemble_mesh(std::move(soup), box_patches(grid.lower(), grid.upper()));
}

}  // namespace pfdm
