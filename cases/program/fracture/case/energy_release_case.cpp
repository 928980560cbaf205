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

TipRegion read_region(const ConfigTable& table) {
  TipRegion region;
  region.name = read_plain_name(table.at("name"), "a column");
  region.point = read_point(table.at("point"));
  region.direction = read_direction(table.at("direction")).normalized();
  if (const auto front = table.find("front")) region.front = read_direction(*front).normalized();
  if (std::abs(region.front.dot(region.direction)) > 1e-9)
    throw table.error("the crack front (front, [0, 0, 1] where it is not given) must be perpendicular to direction");
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

std::vector<TipRegion> read_energy_release(const ConfigTable& output) {
  std::vector<TipRegion> regions;
  for (const ConfigTable& table : output.tables("energy_release_rate")) {
    regions.push_back(read_region(table));
    if (std::ranges::count(regions, regions.back().name, &TipRegion::name) > 1)
      throw table.at("name").error(fmt::format("two regions are called \"{}\"", regions.back().name));
  }
  return regions;
}

}  // namespace pfdm
