#pragma once
// { from = "../composite/results/homogenized.json", key = "isotropic.young_modulus_Pa" } in place of a number or a
// quantity: a number out of a result file (JSON) of another case. The end of its name is its unit, or else
// unit = "MPa" beside the key says it.

#include "cases/program/input/config/toml_document.h"
#include "cases/program/input/config/units.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace pfdm {

/// The value of "from" in such a table, which has texts "from" and "key"; null for any other value.
const TomlValue* path_of_result(const TomlValue& value);

/// [due.si_unit]. `value` has a path_of_result(), from the case directory on. Throws InputError, without a place, for a
/// file that is not there, with the command that makes it, for one that is no JSON, for a key that does not lead to a
/// number, and for a name without the unit due.
double result_number(const TomlValue& value, const std::filesystem::path& case_directory, const Dimension& due);
/// The number as it stands in the file.
double result_number(const TomlValue& value, const std::filesystem::path& case_directory);

/// The number that `key` leads to in a result file of the folder; NaN for null, as of an interval that is
/// withheld. Throws InputError likewise.
double number_in_results(const std::filesystem::path& folder, const std::string& file, const std::string& key);

/// Throws InputError, likewise, for a key that no such file has: `like` is the text of one with all that it may hold. A
/// list with one entry may be longer, and what is empty may hold anything.
void require_key_like(const std::string& like, const std::string& file, const std::string& key);

/// A unit as it stands in names of columns and of results: "J_per_m2" of "J/m^2".
std::string in_names(std::string_view unit);

}  // namespace pfdm
