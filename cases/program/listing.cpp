#include "cases/program/listing.h"

#include "cases/program/fracture/boundary_reader.h"
#include "cases/program/fracture/fracture_case.h"
#include "cases/program/fracture/interface_reader.h"
#include "cases/program/fracture/material_laws.h"
#include "cases/program/fracture/mesh_recipe.h"
#include "cases/program/input/case_file.h"
#include "cases/program/kinds.h"
#include "cases/program/plate/plate_case.h"
#include "cases/program/vibration/mass_material_case.h"
#include "physics/crack_geometry.h"
#include "physics/degradation.h"
#include "physics/energy_split.h"
#include "physics/hardening.h"
#include "physics/mass_material.h"
#include "physics/softening_law.h"
#include "physics/strength_model.h"
#include "physics/traction_separation.h"
#include "postproc/curves/summary.h"
#include "postproc/fields/energy_release_rate.h"
#include "solver/homogenization/homogenization.h"
#include "solver/point/endochronic_identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace pfdm {
namespace {

template <class Row>
void list_table(std::ostream& out, std::string_view heading, std::span<const Row> rows) {
  out << heading << '\n';
  for (const Row& row : rows) out << fmt::format("  {:<22} {}\n", row.name, row.description);
}

namespace fs = std::filesystem;

std::vector<fs::path> cases_in(const fs::path& directory) {
  std::vector<fs::path> cases;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(directory, unreadable))
    if (fs::exists(entry.path() / "case.toml")) cases.push_back(entry.path());
  std::ranges::sort(cases);
  return cases;
}

/// As in "70 s" or "12 min"; of the last complete run here.
std::string time_of(const fs::path& directory) {
  const auto summary = read_summary(directory / "results" / summary_file);
  if (!summary || summary->status != "complete") return "";
  const double seconds = summary->number("wall_seconds");
  if (std::isnan(seconds)) return "";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 300.0) return fmt::format("{:.0f} s", seconds);
  return seconds < 3.0 * 3600.0 ? fmt::format("{:.0f} min", seconds / 60.0) : fmt::format("{:.0f} h", seconds / 3600.0);
}

struct CaseLine {
  std::string kind, name, time, title;
};

CaseLine line_of(const fs::path& directory) {
  CaseLine line{.kind = "?", .name = directory.filename().string(), .time = "", .title = ""};
  try {
    const ConfigTable root = open_case(directory).config.root();
    line = {.kind = root.string("kind"), .name = line.name, .time = time_of(directory), .title = root.string("title")};
  } catch (const InputError& error) {
    line.title = fmt::format("(cannot be read: {})", error.what());
  }
  return line;
}

}  // namespace

fs::path shipped_cases() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed = program.parent_path().parent_path() / "share/pfdm/cases";
  return fs::is_directory(installed, none) ? installed : fs::path(PFDM_CASES_DIR);
}

void list_cases(const std::filesystem::path& cases_directory, std::ostream& out) {
  if (!std::filesystem::is_directory(cases_directory))
    throw InputError(fmt::format("{}: there is no such directory of cases", cases_directory.string()));
  std::vector<CaseLine> lines;
  for (const fs::path& directory : cases_in(cases_directory)) lines.push_back(line_of(directory));
  std::ranges::stable_sort(lines, {}, &CaseLine::kind);
  std::size_t width = 0;
  for (const CaseLine& line : lines) width = std::max(width, line.name.size());
  const bool timed = std::ranges::any_of(lines, [](const CaseLine& line) { return !line.time.empty(); });
  for (const CaseLine& line : lines)
    out << fmt::format("{:<{}}  {:<13}  {:>{}}{}\n", line.name, width, line.kind, line.time, timed ? 7 : 0,
                       (timed ? "  " : "") + line.title);
}

std::optional<std::string> nearest_case(const fs::path& where, const fs::path& cases_directory) {
  const fs::path plain = where.has_filename() ? where : where.parent_path();
  const fs::path beside = plain.has_parent_path() ? plain.parent_path() : fs::path(".");
  std::vector<fs::path> cases = cases_in(beside);
  std::ranges::copy(cases_in(cases_directory), std::back_inserter(cases));
  std::vector<std::string> names;
  names.reserve(cases.size());
  for (const fs::path& directory : cases) names.push_back(directory.filename().string());
  const auto name = nearest(plain.filename().string(), names);
  if (!name) return std::nullopt;
  const fs::path& found = cases[static_cast<std::size_t>(std::ranges::find(names, *name) - names.begin())];
  const fs::path seen = fs::proximate(found);
  return (!seen.empty() && *seen.begin() != ".." ? seen : found).string();
}

void list_laws(std::ostream& out) {
  list_table(out, "kinds of case (kind)", case_kinds());
  list_table(out, "mesh generators ([mesh] generator)", mesh_generators());
  list_table(out, "cells ([mesh] cells)", cell_kinds());
  list_table(out, "laws of materials ([materials.NAME] law)", material_laws());
  list_table(out, "crack geometric functions ([fracture] model)", crack_geometries());
  list_table(out, "strength models ([fracture] model)", strength_laws());
  list_table(out, "degradation functions ([fracture] degradation)", degradations());
  list_table(out, "softening laws of the rational degradation ([fracture] softening)", softening_laws());
  list_table(out, "traction-separation laws that pfdm cohesive fits", traction_separation_laws());
  list_table(out, "laws of cohesive interfaces ([[interface]] law)", interface_laws());
  list_table(out, "their mixed mode ([[interface]] mixed_mode)", mixed_modes());
  list_table(out, "energy splits ([fracture] split)", energy_splits());
  list_table(out, "hardening of the endochronic law ([material.hardening] law)", hardening_laws());
  list_table(out, "rate factors of the endochronic law ([material.rate] law)", rate_factors());
  list_table(out, "identification of the endochronic law ([fit] method)", identification_methods());
  list_table(out, "linear solvers ([solver] linear)", linear_solvers());
  list_table(out, "boundary conditions ([[boundary]] type)", boundary_types());
  list_table(out, "boundary conditions of a homogenisation ([homogenization] boundary)", homogenization_loadings());
  list_table(out, "displacement fields (displacement = { field = ... })", displacement_fields());
  list_table(out, "energy release rate of a crack ([[output.energy_release_rate]] shape)", region_shapes());
  list_table(out, "mass-material models ([model] structure)", model_structures());
  list_table(out, "excitations ([[test]] excitation.type)", excitation_types());
  list_table(out, "identification ([fit] method)", fit_methods());
  list_table(out, "supports of a plate ([[support]] type)", support_types());
  list_table(out, "motions of its base ([base] motion)", base_motions());
  list_table(out, "cooling of its surface ([[cooling]] type)", cooling_types());
}

}  // namespace pfdm
