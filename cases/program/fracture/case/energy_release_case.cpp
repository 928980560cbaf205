#include "cases/program/fracture/case/energy_release_case.h"

#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/amount.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

void read_tip(const ConfigTable& table, TipRegion& region) {
  region.follows = table.choice("tip", "fixed") == "foremost";
  for (const char* key : {"tip_damage", "corridor"})
    if (const auto value = table.find(key); value && !region.follows)
      throw value->error("this requires tip = \"foremost\"; the tip of this region is fixed");
  region.tip_damage = table.number("tip_damage", region.tip_damage);
  region.corridor = table.quantity("corridor", region.corridor);
}

// Of a sector about the axis z: the front is a circle about it, or the crack grows along it.
void require_sector(const ConfigTable& table, const TipRegion& region) {
  if (std::abs(region.front.y()) < 1.0 - 1e-9)
    throw table.at("front").error(
        "in a sector about the axis z (\"axisymmetric\") the front is [0, 1, 0]; leave it out");
  if (region.point.y() != 0.0 || !(region.point.x() > 0.0))
    throw table.at("point").error("in a sector about the axis z (\"axisymmetric\") y is 0, and x > 0 the radius");
  if (const auto length = table.find("reference_length"))
    throw length->error("there are no stress intensities in sectors about an axis, but G; leave this out");
}

TipRegion read_region(const ConfigTable& table, bool is_about_axis) {
  TipRegion region;
  region.is_about_axis = is_about_axis;
  if (is_about_axis) region.front = Vector::UnitY();
  region.name = read_plain_name(table.at("name"), "a column");
  region.point = read_point(table.at("point"));
  region.direction = read_direction(table.at("direction")).normalized();
  if (const auto front = table.find("front")) region.front = read_direction(*front).normalized();
  if (std::abs(region.front.dot(region.direction)) > 1e-9)
    throw table.error(
        "the crack front (front, [0, 0, 1] where it is not given; about an axis [0, 1, 0]) must be perpendicular to "
        "direction");
  if (is_about_axis) require_sector(table, region);
  const auto shape = table.find("shape");
  region.shape = shape ? &choose(*shape, region_shapes(), "shape of a region") : &region_shapes().front();
  region.inner = table.quantity("inner");
  region.outer = table.quantity("outer");
  if (!(region.outer > region.inner)) throw table.at("outer").error("it must be larger than inner");
  region.reference_length = table.quantity("reference_length", 0.0);
  read_tip(table, region);
  return region;
}

}  // namespace

std::vector<TipRegion> read_energy_release(const ConfigTable& output, std::span<const BoundaryCondition> boundary) {
  const bool is_about_axis =
      std::ranges::count(boundary, BoundaryCondition::Kind::axisymmetric, &BoundaryCondition::kind) > 0;
  std::vector<TipRegion> regions;
  for (const ConfigTable& table : output.tables("energy_release_rate")) {
    regions.push_back(read_region(table, is_about_axis));
    if (std::ranges::count(regions, regions.back().name, &TipRegion::name) > 1)
      throw table.at("name").error(fmt::format("two regions are called \"{}\"", regions.back().name));
  }
  return regions;
}

}  // namespace pfdm
