#pragma once
// What the page of a fracture run tells of, and its tables.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "postproc/cohesive/column_record.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/curves/summary.h"
#include "postproc/page/report_page.h"

#include <optional>
#include <vector>

namespace pfdm {

/// All that the page tells of.
struct FractureStory {
  const FractureCase& fracture;
  const std::optional<ExperimentSettings>& experiment;
  std::vector<CurveRow> curve;
  std::optional<RunSummary> summary;
  std::vector<ColumnRecord> records;
  int component() const { return fracture.output.curve.component; }
  char direction() const { return "xyz"[component()]; }
};

/// Model and run: what can break, numbers, times; without a summary how far it is.
Table run_table(const FractureStory& story);
/// Peak, end, energies.
Table figures_table(const FractureStory& story);
/// Of all regions; of a band also the toughness that its cells have, so that a crack takes what was given.
Table material_table(const FractureCase& fracture);

}  // namespace pfdm
