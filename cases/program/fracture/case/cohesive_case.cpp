#include "cases/program/fracture/case/cohesive_case.h"

#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/amount.h"
#include "physics/error.h"
#include "postproc/cohesive/face_columns.h"

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

/// Adds the band or the cohesive interface that an entry names.
void add_named(const ConfigValue& entry, std::span<const Band> bands, std::span<const std::string> interfaces,
               CohesiveSettings& settings) {
  std::vector<std::string> names(interfaces.begin(), interfaces.end());
  for (const Band& band : bands) names.push_back(band.region);
  const std::string name = entry.one_of(
      names, "band between two regions ([mesh.layers] or [regions.NAME] band) or cohesive interface ([[interface]])");
  const auto band = std::ranges::find(bands, name, &Band::region);
  if (band == bands.end()) return settings.faces.push_back(name);
  settings.bands.push_back(*band);
  if (band->neighbours[0] == band->neighbours[1])
    throw entry.error(
        fmt::format("\"{}\" has \"{}\" on both sides, so that no column begins at it; sample it by one of "
                    "[[cohesive.planes]]",
                    name, band->neighbours[0]));
}

CohesivePlane read_plane(const ConfigTable& table) {
  return {.name = read_plain_name(table.at("name"), "a folder"),
          .point = read_point(table.at("point")),
          .normal = read_direction(table.at("normal")),
          .half_width = table.quantity("half_width"),
          .where = table};
}

}  // namespace

CohesiveSettings read_cohesive(const ConfigTable& root, std::span<const Band> bands,
                               std::span<const std::string> interfaces, const Vector& axis) {
  CohesiveSettings settings{
      .bands = two_sided(bands), .planes = {}, .faces = {interfaces.begin(), interfaces.end()}, .axis = axis};
  if (!root.has("cohesive")) return settings;
  const ConfigTable table = root.table("cohesive");
  if (const auto named = table.find("interfaces")) {
    settings.bands.clear();
    settings.faces.clear();
    for (const ConfigValue& entry : named->list()) add_named(entry, bands, interfaces, settings);
  }
  for (const ConfigTable& plane : table.tables("planes")) {
    settings.planes.push_back(read_plane(plane));
    const std::string& name = settings.planes.back().name;
    const bool taken = std::ranges::count(settings.planes, name, &CohesivePlane::name) > 1 ||
                       std::ranges::count(settings.bands, name, &Band::region) > 0 ||
                       std::ranges::count(settings.faces, name) > 0;
    if (taken) throw plane.error(fmt::format("two surfaces are called \"{}\"", name));
  }
  return settings;
}

std::vector<ColumnSet> column_sets(const CohesiveSettings& settings, const Mesh& mesh, const FractureModel& model) {
  std::vector<ColumnSet> sets;
  for (const CohesiveSurface& surface : model.interfaces)
    if (std::ranges::count(settings.faces, surface.name) > 0)
      sets.push_back(face_columns(mesh, surface, settings.axis));
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
