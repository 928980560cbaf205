#include <fmt/format.h>

#include "mesh/quality.h"

namespace pfdm {
namespace {

std::string list(const std::vector<NamedCount>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text;
}

std::string row(const char* name, const char* unit, const Statistic& s) {
  return fmt::format("{:<38}{:>12.4g}{:>12.4g}{:>12.4g}\n", fmt::format("{} [{}]", name, unit), s.min, s.mean, s.max);
}

}  // namespace

std::string describe(const MeshQuality& q) {
  std::string text;
  text += fmt::format("{} cells: {}\n", q.n_cells, list(q.shapes));
  text += fmt::format("regions: {}\n", list(q.regions));
  text += fmt::format("{} faces, {} points; patches: {}\n", q.n_faces, q.n_points, list(q.patches));
  text += fmt::format("volume: {:.6g} m^3\n", q.volume);
  text += fmt::format("{:<38}{:>12}{:>12}{:>12}\n", "", "min", "mean", "max");
  text += row("cell volume", "m^3", q.cell_volume);
  text += row("non-orthogonality of faces", "degrees", q.non_orthogonality);
  text += row("skewness of faces", "-", q.skewness);
  text += row("volume ratio across faces", "-", q.volume_ratio);
  text += row("longest over shortest edge", "-", q.aspect_ratio);
  text += row("smallest dihedral angle", "degrees", q.min_dihedral_angle);
  return text;
}

}  // namespace pfdm
