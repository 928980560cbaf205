#include "mesh/generators/axis_blocks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

void append_block(std::vector<double>& nodes, const AxisBlock& block) {
  const double start = nodes.back();
  const double growth = block.n > 1 ? portable::pow(block.ratio, 1.0 / (block.n - 1)) : 1.0;
  std::vector<double> ends(block.n);
  double sum = 0.0;
  for (Index i = 0; i < block.n; ++i) ends[i] = (sum += portable::pow(growth, i));
  for (Index i = 0; i + 1 < block.n; ++i) nodes.push_back(start + block.length * ends[i] / sum);
  nodes.push_back(start + block.length);
}

}  // namespace

std::vector<double> axis_nodes(double origin, const std::vector<AxisBlock>& blocks, std::string_view where) {
  if (blocks.empty()) throw InputError(fmt::format("{} has no cells", where));
  std::vector<double> nodes{origin};
  for (const AxisBlock& block : blocks) {
    if (!(block.length > 0.0) || block.n < 1 || !(block.ratio > 0.0) || !std::isfinite(block.length * block.ratio))
      throw InputError(fmt::format("{}: a block of length {:g}, {} cells and ratio {:g}; all three must be positive",
                                   where, block.length, block.n, block.ratio));
    append_block(nodes, block);
  }
  return nodes;
}

void check_sector(double azimuth, double inner_radius) {
  constexpr double pi = std::numbers::pi;
  if (!(azimuth > 0.0) || azimuth > 0.25 * pi * (1.0 + 1e-12))
    throw InputError(fmt::format("the sector is {:g} degrees wide in azimuth; more than 0 and at most 45 are allowed",
                                 azimuth * 180.0 / pi));
  if (!(inner_radius >= 0.0))
    throw InputError(fmt::format("the sector's inner radius is {}; it must be zero or positive",
                                 quantity_text(inner_radius, "m", 6)));
}

}  // namespace pfdm
