#pragma once
// The page of pfdm report for a case of kind "mass_material".

#include "cases/program/vibration/mass_material_jobs.h"
#include "postproc/page/report_page.h"

namespace pfdm {

/// Laid out like figure A1 of the report AFRL-RW-EG-TR-2016-088: geometry, conditions, base and response, densities,
/// H1, coherence, and the model over the data; of the test with the largest level. The model is the one found by
/// pfdm fit, or else the case's own. Throws InputError if there is no record, or if the fit belongs to another case.
ReportPage mass_material_page(const MassMaterialProgram& program, const Session& session);

}  // namespace pfdm
