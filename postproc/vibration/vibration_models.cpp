#include "postproc/vibration/vibration_models.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

#include <algorithm>
#include <tuple>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const FittedModel& m) {
  Json parameters = Json::array();
  for (const Estimate& e : m.estimates)
    parameters.push_back(
        {{"name", e.name}, {"unit", e.unit}, {"estimate", e.value}, {"lower", e.lower}, {"upper", e.upper}});
  return {{"structure", m.structure},
          {"kernel_terms", m.kernel_terms},
          {"verdict", name_of(m.verdict)},
          {"reasons", m.reasons},
          {"relative_misfit", m.misfit},
          {"predicted_relative_misfit", m.predicted_misfit},
          {"bic", m.bic},
          {"parameters", parameters}};
}

FittedModel model_in(const Json& json) {
  FittedModel m{.structure = json.at("structure"),
                .kernel_terms = whole_number<int>(json.at("kernel_terms")),
                .verdict = verdict_named(json.at("verdict").get<std::string>()),
                .reasons = json.at("reasons"),
                .misfit = number_of(json.at("relative_misfit")),
                .predicted_misfit = number_of(json.at("predicted_relative_misfit")),
                .bic = number_of(json.at("bic"))};
  for (const Json& e : json.at("parameters"))
    m.estimates.push_back({.name = e.at("name"),
                           .unit = e.at("unit"),
                           .value = number_of(e.at("estimate")),
                           .lower = number_of(e.at("lower")),
                           .upper = number_of(e.at("upper"))});
  return m;
}

}  // namespace

std::size_t best_of(const std::vector<FittedModel>& models) {
  const auto rank = [](const FittedModel& m) {
    constexpr double none = std::numeric_limits<double>::infinity();
    return std::tuple(!m.is_found(), m.verdict == Verdict::failed, std::isfinite(m.bic) ? m.bic : none,
                      m.is_found() ? m.misfit : none);
  };
  return static_cast<std::size_t>(std::ranges::min_element(models, {}, rank) - models.begin());
}

void write_model_comparison(const std::filesystem::path& path, const ModelComparison& c) {
  Json models = Json::array();
  for (const FittedModel& m : c.models) models.push_back(to_json(m));
  const Json json = {{"case", c.case_name}, {"case_hash", c.case_hash}, {"version", c.version},
                     {"method", c.method},  {"chosen", c.chosen},       {"models", models}};
  write_file(path, json_text(json));
}

ModelComparison read_model_comparison(const std::filesystem::path& path) {
  return read_json(path, "comparison of models", [](const Json& json) {
    ModelComparison c{.case_name = json.at("case"),
                      .case_hash = json.at("case_hash"),
                      .version = json.at("version"),
                      .method = json.at("method"),
                      .chosen = json.at("chosen"),
                      .models = {}};
    for (const Json& m : json.at("models")) c.models.push_back(model_in(m));
    return c;
  });
}

}  // namespace pfdm
