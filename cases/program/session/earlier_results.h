#pragma once
// What is in the results' folder when a run is about to begin.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"

#include <optional>
#include <string>
#include <string_view>

namespace pfdm {

/// The status of the run whose results are in the folder, "complete" or why it ended before; nothing if it did not
/// finish.
std::optional<std::string> status_of_earlier(const std::filesystem::path& results);

/// Says that a run of the case that starts anew will replace the results in the session's folder, and what was changed
/// since. `hash` is the case's; `can_go_on`: whether --restart would help.
void say_what_is_replaced(Session& session, const CaseFile& file, const std::string& hash, bool can_go_on);

}  // namespace pfdm
