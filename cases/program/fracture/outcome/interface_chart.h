#pragma once
// The law of a cohesive interface, which its case gives, on a report's page: the law, and the states that single faces
// went through. A mean over faces that open one after the other follows no law.

#include "cases/program/fracture/body/interface_reader.h"
#include "postproc/cohesive/cohesive_results.h"
#include "postproc/page/report_page.h"

namespace pfdm {

/// Equivalent separation and traction, in which every mode of a rule is its law in one mode; of a potential, and where
/// strength or toughness varies from place to place, as they are: then without a curve of the law.
Chart interface_chart(const InterfaceSettings& interface, const ColumnRecord& record);

/// The law's figures for cohesive.json.
GivenFigures given_figures(const InterfaceSettings& interface);

}  // namespace pfdm
