#include "postproc/exports/export_formats.h"

#include "physics/error.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/writers.h"
#include "postproc/files/atomic_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

// To add a format: a writer in a file of its own, a line in writers.h, a row.
constexpr ExportFormat formats[] = {
    {"abaqus", "abaqus.inp", "Abaqus: materials for *COHESIVE SECTION and a *SURFACE INTERACTION, bilinear and tabular",
     "**", abaqus_input},
    {"moose", "moose.i", "MOOSE: [Materials] with BiLinearMixedModeTraction", "#", moose_input},
    {"lsdyna", "lsdyna.k", "LS-DYNA: *MAT_138 (bilinear) and *MAT_186 with its curve", "$", lsdyna_input},
    {"optistruct", "optistruct.fem", "OptiStruct: MCOHE, bilinear", "$", optistruct_input},
    {"akantu", "akantu.dat", "Akantu: cohesive_linear, and cohesive_bilinear in comments", "#", akantu_input},
    {"solids4foam", "solids4foam", "solids4foam: dictionaries of solidCohesive and simpleCohesiveZone patches", "//",
     solids4foam_input},
    {"table", "table.csv", "any code: separation, traction and damage as CSV", "#", table_input},
};

}  // namespace

std::span<const ExportFormat> export_formats() { return formats; }

std::vector<std::string> names_of_export_formats() {
  std::vector<std::string> names;
  for (const ExportFormat& format : formats) names.emplace_back(format.name);
  names.emplace_back("all");
  return names;
}

std::vector<ExportFormat> formats_named(const std::vector<std::string>& names) {
  if (std::ranges::count(names, "all") > 0) return {std::begin(formats), std::end(formats)};
  std::vector<ExportFormat> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(formats, name, &ExportFormat::name);
    if (found == std::end(formats))
      throw InputError(fmt::format("--export: there is no format \"{}\" (available: {})", name,
                                   fmt::join(names_of_export_formats(), ", ")));
    chosen.push_back(*found);
  }
  return chosen;
}

std::string export_text(const ExportFormat& format, const ExportedLaw& law, const UnitSystem& units) {
  const ExportedLaw converted = in_units(law, units);
  std::string text = comment_lines(fmt::format("{}", format.description), format.comment);
  for (const std::string& line : export_head(converted, units)) text += comment_lines(line, format.comment);
  return text + format.input(converted, units);
}

std::vector<fs::path> write_exports(const fs::path& results, const std::vector<ExportFormat>& chosen,
                                    const ExportedLaw& law, const UnitSystem& units) {
  make_folder(results / exports_folder);
  std::vector<fs::path> files;
  for (const ExportFormat& format : chosen) {
    files.push_back(results / exports_folder / format.file);
    write_file(files.back(), export_text(format, law, units));
  }
  return files;
}

void remove_exports(const fs::path& results) {
  std::error_code ignored;
  for (const ExportFormat& format : formats) fs::remove(results / exports_folder / format.file, ignored);
  fs::remove(results / exports_folder, ignored);  // not if something else is in it
}

}  // namespace pfdm
