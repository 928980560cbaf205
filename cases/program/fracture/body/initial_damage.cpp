#include "cases/program/fracture/body/initial_damage.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

FlatSurface read_disc(const ConfigTable& table) {
  return disc(read_point(table.at("centre")), read_direction(table.at("normal")), table.quantity("radius"));
}

FlatSurface read_points(const ConfigTable& table, const ConfigValue& list) {
  std::vector<Vector> points;
  for (const ConfigValue& entry : list.list()) points.push_back(read_point(entry));
  const auto front = table.find("front");
  if (points.size() == 2) {
    const Vector along = front ? read_direction(*front) : Vector::UnitZ();
    return list.in_context([&] { return strip(points[0], points[1], along); });
  }
  if (front) throw front->error("this belongs to a crack between two points; one of three or more is a polygon");
  if (points.size() < 2) throw list.error("expected two points, or the corners of a polygon");
  return list.in_context([&] { return polygon(points); });
}

InitialCrack read_crack(const ConfigTable& table) {
  const auto points = table.find("points");
  if (!points) return {read_disc(table), table};
  for (const char* key : {"centre", "normal", "radius"})
    if (const auto value = table.find(key)) throw value->error("this belongs to a disc; the crack has points already");
  return {read_points(table, *points), table};
}

/// Which regions of the mesh have an initial damage.
std::vector<bool> initially_damaged(const InitialDamage& initial, const FractureModel& model, const Mesh& mesh) {
  std::vector<bool> damaged(mesh.region_names.size(), initial.regions.empty());
  for (const ConfigValue& region : initial.regions) {
    const std::size_t r = mesh.region_index(region.one_of(mesh.region_names, "region of the mesh"));
    if (!model.regions[r].damageable)
      throw region.error(fmt::format("region \"{}\" cannot be damaged", mesh.region_names[r]));
    damaged[r] = true;
  }
  return damaged;
}

}  // namespace

std::optional<InitialDamage> read_initial_damage(const ConfigTable& root, const FractureModel& model) {
  if (!root.has("initial")) return std::nullopt;
  const ConfigTable table = root.table("initial");
  if (model.irreversibility == Irreversibility::history)
    throw table.at(table.has("cracks") ? "cracks" : "damage")
        .error(
            "this requires the irreversibility \"bounds\" or \"crack_set\": the driving energy of an initial damage is "
            "not known");
  InitialDamage initial;
  for (const ConfigTable& crack : table.tables("cracks")) initial.cracks.push_back(read_crack(crack));
  if (table.has("damage") || initial.cracks.empty()) initial.damage = read_parameter(table.at("damage"));
  if (const auto regions = table.find("regions")) {
    initial.regions = regions->list();
    if (initial.regions.empty()) throw regions->error("the list is empty; name a region, or leave the key out");
  }
  return initial;
}

CellField<double> damage_at_the_start(const InitialDamage& initial, const FractureModel& model, const Mesh& mesh) {
  const std::vector<bool> regions = initially_damaged(initial, model, mesh);
  const auto can_be = [&](Index c) { return regions[mesh.region[c]] && model.in_cell(mesh, c).damageable; };
  CellField<double> damage(mesh.n_cells(), 0.0);
  if (initial.damage)
    for (Index c = 0; c < mesh.n_cells(); ++c)
      if (can_be(c)) damage[c] = initial.damage->at(mesh.cell_centre[c]);
  for (const InitialCrack& crack : initial.cracks) {
    std::vector<Index> cells = cells_on(mesh, crack.surface);
    std::erase_if(cells, [&](Index c) { return !can_be(c); });
    if (cells.empty()) throw crack.where.error("the crack goes through no cell that can be damaged");
    for (const Index c : cells) damage[c] = 1.0;
  }
  return damage;
}

}  // namespace pfdm
