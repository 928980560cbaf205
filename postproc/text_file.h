#pragma once
// Reading back the small text files that the program writes itself.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pfdm {

/// Throws InputError that names the file and the reason.
std::string read_file(const std::filesystem::path& path);

/// The number that all of the text spells; empty if it spells none.
std::optional<double> parse_double(std::string_view text);
std::optional<int> parse_int(std::string_view text);

}  // namespace pfdm
