#pragma once
// Events in fit.json: what was measured of them, and what the fitted curve has.

#include "postproc/files/json.h"
#include "postproc/fits/fit_findings.h"

#include <vector>

namespace pfdm {

nlohmann::ordered_json to_json(const std::vector<FittedEvent>& events);
/// Throws as nlohmann's library does.
std::vector<FittedEvent> events_in(const nlohmann::ordered_json& list);

nlohmann::ordered_json to_json(const std::vector<FittedField>& fields);
std::vector<FittedField> fields_in(const nlohmann::ordered_json& list);

}  // namespace pfdm
