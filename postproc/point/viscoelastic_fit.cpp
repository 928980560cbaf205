#include "postproc/point/viscoelastic_fit.h"

#include "postproc/files/json.h"

namespace pfdm {

OwnFindings own_findings(const ViscoelasticFindings& findings) {
  auto json = nlohmann::ordered_json::object();
  json["shortest_time_s"] = findings.window.shortest;
  json["longest_time_s"] = findings.window.longest;
  for (const TriedBranches& t : findings.tried)
    json["branches_tried"].push_back({{"branches", t.n_branches},
                                      {"rms_residual", t.rms},
                                      {"bayesian_information", t.information},
                                      {"objection", t.objection}});
  return {.kind = "viscoelastic", .json = json_line(json)};
}

}  // namespace pfdm
