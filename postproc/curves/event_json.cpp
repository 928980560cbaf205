#include "postproc/curves/event_json.h"

#include <algorithm>

namespace pfdm {

double FittedEvent::figure(const std::string& wanted, double Figure::*value) const {
  const auto found = std::ranges::find(figures, wanted, &Figure::name);
  return found != figures.end() ? *found.*value : std::numeric_limits<double>::quiet_NaN();
}

nlohmann::ordered_json to_json(const std::vector<FittedEvent>& events) {
  auto list = nlohmann::ordered_json::array();
  for (const FittedEvent& event : events) {
    nlohmann::ordered_json& entry =
        list.emplace_back(nlohmann::ordered_json{{"name", event.name},
                                                 {"specimen", event.specimen},
                                                 {"found_in_record", event.is_found},
                                                 {"in_computed_curve", event.is_there},
                                                 {"offset_m", event.set_up.offset},
                                                 {"force_offset_N", event.set_up.force_offset},
                                                 {"compliance_m_per_N", event.set_up.compliance},
                                                 {"figures", nlohmann::ordered_json::array()}});
    for (const FittedEvent::Figure& f : event.figures)
      entry["figures"].push_back({{"name", f.name},
                                  {"unit", f.unit},
                                  {"measured", f.measured},
                                  {"deviation", f.deviation},
                                  {"computed", f.computed},
                                  {"residual", f.residual}});
  }
  return list;
}

std::vector<FittedEvent> events_in(const nlohmann::ordered_json& list) {
  std::vector<FittedEvent> events;
  for (const auto& e : list) {
    FittedEvent event{.name = e.at("name"),
                      .specimen = e.at("specimen"),
                      .is_found = e.at("found_in_record"),
                      .is_there = e.at("in_computed_curve")};
    if (e.contains("offset_m"))
      event.set_up = {
          .offset = e.at("offset_m"), .force_offset = e.at("force_offset_N"), .compliance = e.at("compliance_m_per_N")};
    for (const auto& f : e.at("figures"))
      event.figures.push_back({.name = f.at("name"),
                               .unit = f.at("unit"),
                               .measured = number_of(f.at("measured")),
                               .deviation = number_of(f.at("deviation")),
                               .computed = number_of(f.at("computed")),
                               .residual = number_of(f.at("residual"))});
    events.push_back(std::move(event));
  }
  return events;
}

}  // namespace pfdm
