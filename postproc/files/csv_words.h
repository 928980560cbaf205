#pragma once
// The entries of a line of a table that an instrument or a spreadsheet wrote: numbers, gaps, names and units.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The entries of a line, trimmed. Double quotes hold one together and are left out.
void split_csv(std::string_view line, char separator, std::vector<std::string>& words);

/// Nothing if the word is no number with these marks. Thousands may be apart or not, but then all of them.
std::optional<double> csv_number(std::string_view word, char decimal, std::optional<char> thousands = std::nullopt);

/// An entry without a value: empty, or nan, NA, N/A, null, none in letters of any case.
bool is_gap(std::string_view word);

/// "[mm]" -> "mm", "(N)" -> "N"; nothing without brackets around all of it.
std::optional<std::string> in_brackets(std::string_view text);
/// "Force [N]" -> "N": the last brackets of a name, which has more than them.
std::optional<std::string> bracketed_end(std::string_view name);

}  // namespace pfdm
