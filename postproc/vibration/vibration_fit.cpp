#include "postproc/vibration/vibration_fit.h"

#include "postproc/files/json.h"

#include <numbers>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<Estimate>& estimates) {
  Json list = Json::array();
  for (const Estimate& e : estimates)
    list.push_back({{"name", e.name}, {"unit", e.unit}, {"estimate", e.value}, {"lower", e.lower}, {"upper", e.upper}});
  return list;
}

std::vector<Estimate> estimates_in(const Json& list) {
  std::vector<Estimate> estimates;
  for (const Json& e : list)
    estimates.push_back({.name = e.at("name"),
                         .unit = e.at("unit"),
                         .value = number_of(e.at("estimate")),
                         .lower = number_of(e.at("lower")),
                         .upper = number_of(e.at("upper"))});
  return estimates;
}

Json to_json(const std::vector<OrderTrial>& orders) {
  Json list = Json::array();
  for (const OrderTrial& trial : orders)
    list.push_back(
        {{"kernel_order", trial.kernel_order}, {"bic", trial.bic}, {"misfit", trial.misfit}, {"pair", trial.pair}});
  return list;
}

Json to_json(const std::vector<ModulusRow>& rows) {
  Json list = Json::array();
  for (const ModulusRow& row : rows)
    list.push_back(
        {{"frequency_Hz", row.frequency}, {"storage_modulus_Pa", row.storage}, {"loss_modulus_Pa", row.loss}});
  return list;
}

Json to_json(const OgdenFit& fit) {
  Json terms = Json::array();
  for (const OgdenTerm& term : fit.terms) terms.push_back({{"mu_Pa", term.mu}, {"alpha", term.alpha}});
  return {{"terms", terms},
          {"shear_modulus_Pa", shear_modulus(fit.terms)},
          {"largest_displacement_m", fit.largest_displacement},
          {"relative_misfit", fit.relative_misfit}};
}

Json to_json(const Repeatability& r) {
  Json effects = Json::array();
  for (const Effect& e : r.effects)
    effects.push_back({{"name", e.name}, {"value", e.value}, {"lower_95", e.lower_95}, {"upper_95", e.upper_95}});
  return {{"mean", r.mean},
          {"repeat_deviation", r.repeat_deviation ? Json(*r.repeat_deviation) : Json()},
          {"repeat_degrees_of_freedom", r.repeat_freedom},
          {"effects", effects},
          {"residual_deviation", r.residual_deviation},
          {"residual_degrees_of_freedom", r.residual_freedom}};
}

Json to_json(const RepeatedIdentification& repeats) {
  Json records = Json::array(), parameters = Json::array();
  for (const RecordEstimates& r : repeats.records)
    records.push_back({{"name", r.name},
                       {"level_m_per_s2", r.schedule.level},
                       {"age_s", r.schedule.age},
                       {"run", r.schedule.run},
                       {"relative_misfit", r.misfit},
                       {"converged", r.converged},
                       {"estimates", to_json(r.estimates)}});
  for (const ParameterRepeatability& p : repeats.parameters) {
    Json entry = {{"name", p.name}};
    entry.update(to_json(p.statistics));
    entry["expected_deviation"] = p.expected_deviation;
    parameters.push_back(std::move(entry));
  }
  return {{"model",
           "value = mean + per_g0 (level - mean level) + per_day (age - mean age) + per_run (run - mean run) + "
           "error; ordinary least squares over the records, each fitted on its own"},
          {"parameters", parameters},
          {"records", records}};
}

RepeatedIdentification repeats_in(const Json& json) {
  RepeatedIdentification repeats;
  for (const Json& r : json.at("records")) {
    repeats.records.push_back(
        {.name = r.at("name"),
         .schedule = {number_of(r.at("level_m_per_s2")), number_of(r.at("age_s")), whole_number<int>(r.at("run"))},
         .estimates = estimates_in(r.at("estimates")),
         .misfit = number_of(r.at("relative_misfit")),
         .converged = r.at("converged")});
  }
  for (const Json& p : json.at("parameters")) {
    ParameterRepeatability parameter{
        .name = p.at("name"),
        .statistics = {.mean = number_of(p.at("mean")),
                       .effects = {},
                       .residual_deviation = number_of(p.at("residual_deviation")),
                       .residual_freedom = whole_number<int>(p.at("residual_degrees_of_freedom")),
                       .repeat_deviation = {},
                       .repeat_freedom = whole_number<int>(p.at("repeat_degrees_of_freedom"))},
        .expected_deviation = number_of(p.at("expected_deviation"))};
    if (!p.at("repeat_deviation").is_null()) parameter.statistics.repeat_deviation = p.at("repeat_deviation");
    for (const Json& e : p.at("effects"))
      parameter.statistics.effects.push_back(
          {e.at("name"), number_of(e.at("value")), number_of(e.at("lower_95")), number_of(e.at("upper_95"))});
    repeats.parameters.push_back(std::move(parameter));
  }
  return repeats;
}

OgdenFit ogden_in(const Json& json) {
  OgdenFit fit{.terms = {},
               .largest_displacement = json.at("largest_displacement_m"),
               .relative_misfit = json.at("relative_misfit")};
  for (const Json& term : json.at("terms")) fit.terms.push_back({term.at("mu_Pa"), term.at("alpha")});
  return fit;
}

constexpr const char* kind = "mass_material";

Json to_json(const VibrationFindings& f) {
  return {{"structure", f.structure},
          {"passive", f.passivity.passive},
          {"least_damping_N_s_per_m", f.passivity.least_damping},
          {"least_damping_at_Hz", f.passivity.worst_omega / (2.0 * std::numbers::pi)},
          {"kernel_orders_tried", to_json(f.orders)},
          {"youngs_modulus", to_json(f.modulus)},
          {"ogden", f.ogden ? to_json(*f.ogden) : Json()},
          {"repeatability", f.repeats ? to_json(*f.repeats) : Json()}};
}

VibrationFindings findings_in(const Json& json) {
  VibrationFindings findings{
      .structure = json.at("structure"), .passivity = {}, .orders = {}, .modulus = {}, .ogden = {}, .repeats = {}};
  for (const Json& row : json.at("youngs_modulus"))
    findings.modulus.push_back({number_of(row.at("frequency_Hz")), number_of(row.at("storage_modulus_Pa")),
                                number_of(row.at("loss_modulus_Pa"))});
  if (!json.at("ogden").is_null()) findings.ogden = ogden_in(json.at("ogden"));
  if (!json.at("repeatability").is_null()) findings.repeats = repeats_in(json.at("repeatability"));
  return findings;
}

}  // namespace

OwnFindings own_findings(const VibrationFindings& findings) {
  return {.kind = kind, .json = json_line(to_json(findings))};
}

std::optional<VibrationFindings> vibration_findings(const OwnFindings& own) {
  if (own.kind != kind) return std::nullopt;
  try {
    return findings_in(Json::parse(own.json));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("these are no findings of a mass-material fit: {}", json_fault(error)));
  } catch (const JsonTooLarge& error) {
    throw InputError(fmt::format("these are no findings of a mass-material fit: {}", error.what()));
  }
}

}  // namespace pfdm
