#pragma once
// Charts of several pages as one: what has the same caption lies over one another, in one unit.

#include "postproc/page/report_page.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

/// A run's page, and what the run is called.
struct NamedReport {
  std::string name;
  const ReportPage* report = nullptr;
};

/// A chart for each caption, of all pages that have it. Series of a run have its name, and a colour for each page.
/// Where a page has several series of its run the chart becomes one for each of them; measured curves, which are the
/// same in all, are drawn once. Axes of different dimensions (force, stress) are not brought together.
std::vector<PageBlock> merged_charts(const std::vector<NamedReport>& pages);

/// "displacement x [mm]" as "displacement x" and "mm".
std::pair<std::string, std::string> words_and_unit(const std::string& title);

/// The chart of a page that has a point for each row of the run's curve, and the first such series in it; null if there
/// is none.
std::pair<const Chart*, const Series*> first_curve(const ReportPage& page);

}  // namespace pfdm
