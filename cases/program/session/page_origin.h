#pragma once
// What the page in the browser tells beside the report: where it comes from, how it is made again.

#include "cases/program/session/report_parts.h"

#include <filesystem>
#include <string>

namespace pfdm {

/// Blocks of warnings are left out: all of them stand by themselves.
BrowserPage browser_page(ReportPage report, const std::filesystem::path& results, BrowserExtras extras);

/// The case as it ran, or that in the folder above; empty if there is none.
std::filesystem::path case_of(const std::filesystem::path& results);

/// A word of a command line, quoted where the shell would take a part of it for its own.
std::string shell_word(const std::string& word);

/// The program as the user calls it: the launcher ("./pfdm") that has called it, or "pfdm".
std::string called_as();

}  // namespace pfdm
