#pragma once
// Heat on a report's page: rises and heat by load step, and the long time that the mean heat of cycles warms.

#include "postproc/page/report_page.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// Of the files of a run (heat_results.h); none where there are none.
std::vector<PageBlock> heat_charts(const std::filesystem::path& results);

}  // namespace pfdm
