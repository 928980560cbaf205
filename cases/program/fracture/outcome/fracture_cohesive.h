#pragma once
// pfdm cohesive: the traction-separation laws of a fracture case from its results.

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"

#include <string>

namespace pfdm {

/// Reads the columns and the curve in session.results, writes the laws beside them and says their figures; at the end
/// of a run (`in_run`) these go to its log alone. Where the
/// law of an [[interface]] is to be exported it is taken from the case, without results; `file` is its. Throws
/// InputError where there is no record.
void write_cohesive_laws(const FractureCase& fracture, const CaseFile& file, const std::string& name,
                         const std::string& hash, Session& session, bool in_run = false);

}  // namespace pfdm
