#pragma once
// Where the law that a case gives an interface comes from, and how far it has been seen: comments of an exported file.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"

#include <string>
#include <vector>

namespace pfdm {

/// Of [[interface]] number `index`, called `name`: of a fitted case the verdict and the estimates of this interface
/// with their intervals (fit.json beside case.fitted.toml), and how far the run of this case, if there is one, opened
/// it. Throws InputError for a fit.json that is none.
std::vector<std::string> source_of_law(const CaseFile& file, std::size_t index, const std::string& name,
                                       const std::string& hash, const Session& session);

}  // namespace pfdm
