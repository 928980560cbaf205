#include "postproc/point/endochronic_fit.h"

#include "postproc/files/json.h"

namespace pfdm {

OwnFindings own_findings(const EndochronicFindings& findings) {
  auto json = nlohmann::ordered_json::object();
  for (const TriedKernel& t : findings.tried)
    json["kernel_terms_tried"].push_back(
        {{"terms", t.n_terms}, {"rms_misfit_Pa", t.rms}, {"bayesian_information", t.information}});
  for (const StaggeredRound& r : findings.rounds)
    json["staggered_rounds"].push_back(
        {{"rms_misfit_after_hardening_Pa", r.rms_after_hardening}, {"rms_misfit_after_kernel_Pa", r.rms_after_kernel}});
  return {.kind = "endochronic", .json = json_line(json)};
}

}  // namespace pfdm
