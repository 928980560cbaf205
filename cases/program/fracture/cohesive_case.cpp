#include "cases/program/fracture/cohesive_case.h"

#include "cases/program/input/amount.h"
#include "cases/program/input/path_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace pfdm {
namespace {

/// Those with an inner and an outer side: columns begin at the inner one.
std::vector<Band> two_sided(std::span<const Band> bands) {
  std::vector<Band> chosen;
  std::ranges::copy_if(bands, std::back_inserter(chosen),
                       [](const Band& band) { return band.neighbours[0] != band.neighbours[1]; });
  return chosen;
}

std::vector<Band> read_interfaces(const ConfigTable& table, std::span<const Band> bands) {
  const auto interfaces = table.find("interfaces");
  if (!interfaces) return two_sided(bands);
  std::vector<std::string> names;
  for (const Band& band : bands) names.push_back(band.region);
  std::vector<Band> chosen;
  for (const ConfigValue& entry : interfaces->list()) {
    const std::string name = entry.one_of(names, "band between two regions ([mesh.layers] or [regions.NAME] band)");
    chosen.push_back(*std::ranges::find(bands, name, &Band::region));
    if (chosen.back().neighbours[0] == chosen.back().neighbours[1])
      throw entry.error(
          fmt::format("\"{}\" has \"{}\" on both sides, so that no column begins at it; sample it by one of "
                      "[[cohesive.planes]]",
                      name, chosen.back().neighbours[0]));
  }
  return chosen;
}

CohesivePlane read_plane(const ConfigTable& table) {
  table.with_keys({"name", "point", "normal", "half_width"});
  return {.name = read_plain_name(table.at("name"), "a folder"),
          .point = read_point(table.at("point")),
          .normal = read_direction(table.at("normal")),
          .half_width = table.quantity("half_width", dimension::length, range::positive),
          .where = table};
}

}  // namespace

CohesiveSettings read_cohesive(const ConfigTable& root, std::span<const Band> bands, const Vector& axis) {
  CohesiveSettings settings{.bands = two_sided(bands), .planes = {}, .axis = axis};
  if (!root.has("cohesive")) return settings;
  const ConfigTable table = root.table("cohesive").with_keys({"interfaces", "planes"});
  settings.bands = read_interfaces(table, bands);
  for (const ConfigTable& plane : table.tables("planes")) {
    settings.planes.push_back(read_plane(plane));
    const std::string& name = settings.planes.back().name;
    const bool taken = std::ranges::count(settings.planes, name, &CohesivePlane::name) > 1 ||
                       std::ranges::count(settings.bands, name, &Band::region) > 0;
    if (taken) throw plane.error(fmt::format("two surfaces are called \"{}\"", name));
  }
  return settings;
}

std::vector<ColumnSet> column_sets(const CohesiveSettings& settings, const Mesh& mesh) {
  std::vector<ColumnSet> sets;
  for (const Band& band : settings.bands)
    for (ColumnSet& set : interface_columns(mesh, band.region, band.neighbours[1], settings.axis))
      sets.push_back(std::move(set));
  for (const CohesivePlane& plane : settings.planes)
    plane.where.in_context([&] {
      if (std::ranges::count(sets, plane.name, &ColumnSet::name) > 0)  // one of several particles' surfaces
        throw InputError(fmt::format("two surfaces are called \"{}\"", plane.name));
      sets.push_back(plane_columns(mesh, plane.name, plane.point, plane.normal, plane.half_width, settings.axis));
      return true;
    });
  return sets;
}

}  // namespace pfdm
