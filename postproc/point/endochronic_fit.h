#pragma once
// What fit.json tells of the endochronic law alone. SI units, units in the names.

#include "postproc/fits/fit_json.h"
#include "solver/point/endochronic_identification.h"

#include <vector>

namespace pfdm {

struct EndochronicFindings {
  std::vector<TriedKernel> tried;
  std::vector<StaggeredRound> rounds;
};
OwnFindings own_findings(const EndochronicFindings& findings);

}  // namespace pfdm
