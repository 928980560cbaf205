#pragma once
// What fit.json tells of Prony series alone. SI units, units in the names.

#include "postproc/fits/fit_json.h"
#include "solver/point/viscoelastic_identification.h"

#include <vector>

namespace pfdm {

struct ViscoelasticFindings {
  std::vector<TriedBranches> tried;
  TimeWindow window;
};
OwnFindings own_findings(const ViscoelasticFindings& findings);

}  // namespace pfdm
