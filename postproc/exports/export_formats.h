#pragma once
// The formats that a law can be exported in: a row each in the table of export_formats.cpp, a file each with its
// writer.

#include "postproc/exports/law/exported_law.h"
#include "postproc/exports/law/unit_systems.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct ExportFormat {
  std::string_view name;  ///< on the command line
  std::string_view file;  ///< in results/cohesive_law/
  std::string_view description;
  std::string_view comment;  ///< what a line of comment starts with
  /// The input after the head, of a law in these units.
  std::string (*input)(const ExportedLaw& law, const UnitSystem& units);
};

std::span<const ExportFormat> export_formats();

/// All of them, and "all".
std::vector<std::string> names_of_export_formats();

/// "abaqus", or "all". Throws InputError with the names there are.
std::vector<ExportFormat> formats_named(const std::vector<std::string>& names);

/// Head and input.
std::string export_text(const ExportFormat& format, const ExportedLaw& law, const UnitSystem& units);

/// In the results; files of other formats are left alone.
inline constexpr const char* exports_folder = "cohesive_law";

/// Writes a file for each format, whole or not at all, and returns their paths. Throws ComputationError.
std::vector<std::filesystem::path> write_exports(const std::filesystem::path& results,
                                                 const std::vector<ExportFormat>& formats, const ExportedLaw& law,
                                                 const UnitSystem& units);

/// Removes the files of all formats, and their folder if nothing else is in it.
void remove_exports(const std::filesystem::path& results);

}  // namespace pfdm
