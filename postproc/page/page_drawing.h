#pragma once
// A report's page as files: an A4 sheet, upright.

#include "postproc/page/report_page.h"

#include <filesystem>
#include <string>

namespace pfdm {

/// The contents of a file, drawn without a display.
std::string page_as_pdf(const ReportPage& page);
std::string page_as_png(const ReportPage& page, double dots_per_inch = 200.0);

/// report.pdf and report.png in `folder`, which is made; each written whole or not at all. Throws ComputationError.
void write_page(const std::filesystem::path& folder, const ReportPage& page);

}  // namespace pfdm
