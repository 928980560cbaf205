#include "postproc/fits/event_json.h"

#include <algorithm>

namespace pfdm {

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

nlohmann::ordered_json to_json(const std::vector<FittedField>& fields) {
  auto list = nlohmann::ordered_json::array();
  for (const FittedField& field : fields) {
    nlohmann::ordered_json& entry =
        list.emplace_back(nlohmann::ordered_json{{"name", field.name},
                                                 {"specimen", field.specimen},
                                                 {"file", field.file},
                                                 {"pitch_m", field.pitch},
                                                 {"data", field.n_data},
                                                 {"deviation_m", field.deviation},
                                                 {"stated_deviation_m", field.stated},
                                                 {"inflation", field.inflation},
                                                 {"correlated_over_m", field.over},
                                                 {"correlated_over_frames", field.over_frames},
                                                 {"frames", nlohmann::ordered_json::array()}});
    for (const FittedField::Frame& f : field.frames)
      entry["frames"].push_back({{"name", f.name},
                                 {"displacement_m", f.displacement},
                                 {"places", f.places},
                                 {"rms_misfit_m", f.rms},
                                 {"rms_displacement_m", f.rms_measured}});
  }
  return list;
}

std::vector<FittedField> fields_in(const nlohmann::ordered_json& list) {
  std::vector<FittedField> fields;
  for (const auto& e : list) {
    FittedField field{.name = e.at("name"),
                      .specimen = e.at("specimen"),
                      .file = e.at("file"),
                      .pitch = number_of(e.at("pitch_m")),
                      .n_data = e.at("data").get<std::size_t>(),
                      .deviation = number_of(e.at("deviation_m")),
                      .stated = number_of(e.at("stated_deviation_m")),
                      .inflation = number_of(e.at("inflation")),
                      .over = number_of(e.at("correlated_over_m")),
                      .over_frames = e.at("correlated_over_frames")};
    for (const auto& f : e.at("frames"))
      field.frames.push_back({.name = f.at("name"),
                              .displacement = number_of(f.at("displacement_m")),
                              .places = f.at("places").get<std::size_t>(),
                              .rms = number_of(f.at("rms_misfit_m")),
                              .rms_measured = number_of(f.at("rms_displacement_m"))});
    fields.push_back(std::move(field));
  }
  return fields;
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
