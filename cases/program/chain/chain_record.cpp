#include "cases/program/chain/chain_record.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

#include <algorithm>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const DoneStep& step) {
  Json taken = Json::array(), figures = Json::array();
  for (const TakenNumber& number : step.taken)
    taken.push_back({{"into", number.into}, {"from", number.from}, {"key", number.key}, {"value", number.value}});
  for (const ShownFigure& figure : step.figures)
    figures.push_back(
        {{"says", figure.says}, {"value", figure.value}, {"unit", figure.unit}, {"interval", figure.interval}});
  return {{"name", step.name},
          {"does", step.does},
          {"case_hash", step.key},
          {"outcome_hash", step.outcome},
          {"wall_seconds", step.wall_seconds},
          {"verdict", step.verdict},
          {"numbers_taken", taken},
          {"files_taken", step.files},
          {"figures", figures}};
}

DoneStep step_of(const Json& json) {
  DoneStep step{.name = json.at("name"),
                .does = json.at("does"),
                .key = json.at("case_hash"),
                .outcome = json.at("outcome_hash"),
                .wall_seconds = number_of(json.at("wall_seconds")),
                .verdict = json.at("verdict"),
                .taken = {},
                .files = json.at("files_taken")};
  for (const Json& number : json.at("numbers_taken"))
    step.taken.push_back({number.at("into"), number.at("from"), number.at("key"), number_of(number.at("value"))});
  for (const Json& figure : json.at("figures")) {
    step.figures.push_back({figure.at("says"), number_of(figure.at("value")), figure.at("unit")});
    for (const Json& end : figure.at("interval")) step.figures.back().interval.push_back(number_of(end));
  }
  return step;
}

}  // namespace

const DoneStep* ChainRecord::find(const std::string& name) const {
  const auto found = std::ranges::find(steps, name, &DoneStep::name);
  return found != steps.end() ? &*found : nullptr;
}

void write_chain(const std::filesystem::path& results, const ChainRecord& record) {
  Json steps = Json::array();
  for (const DoneStep& step : record.steps) steps.push_back(to_json(step));
  const Json json = {
      {"case", record.case_name}, {"status", record.status}, {"pfdm_version", record.version}, {"steps", steps}};
  write_file(results / chain_file, json_text(json));
}

ChainRecord read_chain(const std::filesystem::path& results) {
  if (!std::filesystem::exists(results / chain_file)) return {};
  return read_json(results / chain_file, "record of a chain", [](const Json& json) {
    ChainRecord record{
        .case_name = json.at("case"), .status = json.at("status"), .version = json.at("pfdm_version"), .steps = {}};
    for (const Json& step : json.at("steps")) record.steps.push_back(step_of(step));
    return record;
  });
}

}  // namespace pfdm
