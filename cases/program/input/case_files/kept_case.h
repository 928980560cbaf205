#pragma once
// The case file as it ran, kept among its results: what decides them stays readable, whatever becomes of the case, and
// tells which keys were changed since.

#include "cases/program/input/case_files/case_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

/// Writes `results`/case.toml, to stand in `results`, into `folder`, where the results gather: a comment with version
/// and name, then the text, with its paths seen from `results`. Does nothing where that is the case's own directory.
/// Throws ComputationError if the file cannot be written.
void keep_case(const CaseFile& file, const std::string& version, const std::filesystem::path& results,
               const std::filesystem::path& folder);

/// Of a file that keep_case() wrote and that has results beside it, the case in the directory where it ran, with paths
/// from there (from the results, if that directory is gone); other files as they are, copies of such ones too.
CaseFile where_it_ran(CaseFile file);

/// Where a case writes unless told otherwise: `results` in its directory; of a kept case the folder that it is in; of
/// NAME/results/case.fitted.toml NAME/results/fitted.
std::filesystem::path own_results(const CaseFile& file);

/// "materials.steel.young_modulus = "200 GPa" (was "210 GPa")" of each key that differs from the kept case; none if
/// there is no such file. What decides no results (title, [solver], [loading], [experiment], [fit], [sweep]) is left
/// out where something else differs.
std::vector<std::string> changed_keys(const CaseFile& file, const std::filesystem::path& results);

/// "; since then changed: ..." of at most five keys, for messages on results that are not the case's; empty if
/// nothing was kept.
std::string words_on_changes(const CaseFile& file, const std::filesystem::path& results);

}  // namespace pfdm
