#pragma once
// Reading text: files, lines, words, numbers.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pfdm {

/// Throws InputError that names the path and what is wrong with it, unless it leads to a file that may be read: a
/// folder holds nothing to read, and of a pipe nobody knows whether something will come.
void require_file(const std::filesystem::path& path);

/// Likewise.
std::string read_file(const std::filesystem::path& path);

/// Without the blanks at either end.
std::string_view trimmed(std::string_view text);
/// With the letters A to Z as a to z.
std::string lower_case(std::string_view text);
/// Takes the first line off the front of `rest`; trimmed.
std::string_view take_line(std::string_view& rest);

/// The number that all of the text spells; empty if it spells none.
std::optional<double> parse_double(std::string_view text);
std::optional<int> parse_int(std::string_view text);

}  // namespace pfdm
