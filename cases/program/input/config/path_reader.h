#pragma once
// What a case names that becomes a path, or a part of one: the only place that decides what such a name may be.

#include "cases/program/input/config/config.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace pfdm {

/// A name that a folder, file or column of the results gets, so that it cannot lead out of them; `use` says which, as
/// in "a folder". Throws InputError with the place in the file.
std::string read_plain_name(const ConfigValue& value, std::string_view use);
/// The same for a key of the file: throws InputError without a place.
void require_plain_name(std::string_view name, std::string_view use);

/// Of a file in CASE/results "; pfdm run CASE makes it", or that it belongs to that case; of others empty.
std::string way_to_make(const std::filesystem::path& file);

/// The file that `value` names, seen from the case directory. Throws InputError with the place in the file, unless it
/// is a file that can be read.
std::filesystem::path read_data_file(const ConfigValue& value, const std::filesystem::path& case_directory);

}  // namespace pfdm
