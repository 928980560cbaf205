#include "cases/program/studies/sensitivity/sensitivity_results.h"

#include "cases/program/input/config/result_number.h"
#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

std::string unit_of(const CaseParameter& parameter) {
  return parameter.unit.empty() ? "1" : std::string(parameter.dimension.si_unit);
}

Json json_of(const Elasticity& elasticity, double of, const CaseParameter& by, std::string_view unit) {
  return {{"parameter", by.name},
          {"elasticity", elasticity.value},
          {"error", elasticity.error},
          {"doubtful", elasticity.is_doubtful()},
          {"derivative", elasticity.value * of / by.value},
          {"derivative_unit", fmt::format("{}/({})", unit, unit_of(by))}};
}

Json json_of(const ParameterSensitivity& p, const SampledCurve& curve) {
  Json json{{"name", p.parameter.name},
            {"keys", p.parameter.keys},
            {"value", p.parameter.value},
            {"unit", unit_of(p.parameter)},
            {"failure", p.failure}};
  if (!p.failure.empty()) return json;
  const ParameterSensitivity::Overview overview = p.overview(curve);
  if (overview.largest) {
    json["largest"] = p.curve[*overview.largest].value;
    json["displacement_of_largest_m"] = curve.x[*overview.largest];
  }
  json["mean_magnitude"] = overview.mean;
  json["largest_error"] = overview.error;
  json["rows_doubtful"] = overview.n_doubtful;
  json["rows_without"] = overview.n_unknown;
  return json;
}

Json events_of(const CaseSensitivity& found) {
  Json events = Json::array();
  for (std::size_t e = 0; e < found.events.size(); ++e) {
    Json figures = Json::array();
    for (std::size_t q = 0; q < found.events[e].quantities.size(); ++q) {
      const EventQuantity& quantity = found.events[e].quantities[q];
      Json list = Json::array();
      for (const ParameterSensitivity& p : found.parameters)
        if (p.failure.empty())
          list.push_back(json_of(p.events[e][q], quantity.value, p.parameter, unit_of(quantity.figure)));
      figures.push_back({{"name", name_of(quantity.figure)},
                         {"unit", unit_of(quantity.figure)},
                         {"value", quantity.value},
                         {"elasticities", list}});
    }
    events.push_back({{"name", found.events[e].event.name()}, {"figures", figures}});
  }
  return events;
}

CsvTable table_of(const CaseSensitivity& found) {
  CsvTable table;
  table.comments.push_back(
      fmt::format("sensitivity of {}: elasticities d ln F/d ln p, their errors, and derivatives of the force; nan "
                  "where there is none",
                  found.name));
  table.add("displacement_m", found.curve.x);
  table.add("force_N", found.curve.y);
  for (const ParameterSensitivity& p : found.parameters) {
    if (!p.failure.empty()) continue;
    std::vector<double> values, errors, derivatives;
    for (std::size_t i = 0; i < p.curve.size(); ++i) {
      values.push_back(p.curve[i].value);
      errors.push_back(p.curve[i].error);
      derivatives.push_back(p.curve[i].value * found.curve.y[i] / p.parameter.value);
    }
    const std::string& name = p.parameter.name;
    table.add("elasticity_" + name, std::move(values));
    table.add("error_" + name, std::move(errors));
    table.add(fmt::format("derivative_{}_N_per_{}", name, in_names(unit_of(p.parameter))), std::move(derivatives));
  }
  return table;
}

std::string with_number_of_keys(const std::string& name, const CaseParameter& parameter) {
  return parameter.keys.size() > 1 ? fmt::format("{} + {} more", name, parameter.keys.size() - 1) : name;
}

/// How often an elasticity of the curve or of an event is as asked for.
template <class Ask>
std::size_t count(const CaseSensitivity& found, const Ask& ask) {
  std::size_t n = 0;
  for (const ParameterSensitivity& p : found.parameters) {
    n += static_cast<std::size_t>(std::ranges::count_if(p.curve, ask));
    for (const std::vector<Elasticity>& event : p.events)
      n += static_cast<std::size_t>(std::ranges::count_if(event, ask));
  }
  return n;
}

std::string event_line(const CaseSensitivity& found, std::size_t e, std::size_t q) {
  std::vector<std::pair<double, std::string>> by;
  for (const ParameterSensitivity& p : found.parameters) {
    if (!p.failure.empty()) continue;
    const Elasticity& elasticity = p.events[e][q];
    by.emplace_back(elasticity.is_known() ? -std::abs(elasticity.value) : 0.0,
                    fmt::format("{} {}", short_name(p.parameter), text_of(elasticity)));
  }
  std::ranges::stable_sort(by, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> words;
  words.reserve(by.size());
  for (const auto& [order, text] : by) words.push_back(text);
  const EventQuantity& quantity = found.events[e].quantities[q];
  return fmt::format("  {} {}: {}", in_words(quantity.figure), quantity_text(quantity.value, unit_of(quantity.figure)),
                     fmt::join(words, ", "));
}

}  // namespace

ParameterSensitivity::Overview ParameterSensitivity::overview(const SampledCurve& of) const {
  Overview found;
  double length = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (!curve[i].is_known()) ++found.n_unknown;
    if (curve[i].is_doubtful()) ++found.n_doubtful;
    if (!curve[i].is_known() || curve[i].is_doubtful()) continue;
    if (!found.largest || std::abs(curve[i].value) > std::abs(curve[*found.largest].value)) found.largest = i;
    found.error = std::max(found.error, curve[i].error);
    const double width = 0.5 * (of.x[std::min(i + 1, of.x.size() - 1)] - of.x[i > 0 ? i - 1 : 0]);
    found.mean += width * std::abs(curve[i].value);
    length += width;
  }
  if (length > 0.0) found.mean /= length;
  return found;
}

void conclude(CaseSensitivity& found) {
  const auto rank = [&](const ParameterSensitivity& p) {
    const auto overview = p.overview(found.curve);
    return overview.largest ? -std::abs(p.curve[*overview.largest].value) : 1.0;
  };
  std::ranges::stable_sort(found.parameters, {}, rank);
  for (const ParameterSensitivity& p : found.parameters)
    if (!p.failure.empty()) found.remarks.push_back(fmt::format("none by {}: {}", full_name(p.parameter), p.failure));
  if (const std::size_t n = count(found, [](const Elasticity& e) { return e.is_doubtful(); }))
    found.remarks.push_back(fmt::format("{} elasticities are doubtful (?): {}", n, found.doubt));
}

std::string full_name(const CaseParameter& parameter) { return with_number_of_keys(parameter.name, parameter); }

std::string short_name(const CaseParameter& parameter) {
  const bool has_own = parameter.name.starts_with("materials.") || parameter.name.starts_with("regions.");
  return with_number_of_keys(has_own ? parameter.short_name() : parameter.name, parameter);
}

std::string text_of(const Elasticity& elasticity) {
  if (!elasticity.is_known()) return "-";
  if (std::isnan(elasticity.error)) return fmt::format("{:.3f} ?", elasticity.value);
  return fmt::format("{:.3f} +- {:.2g}{}", elasticity.value, elasticity.error, elasticity.is_doubtful() ? " ?" : "");
}

void write_sensitivity(const std::filesystem::path& folder, const CaseSensitivity& found) {
  Json parameters = Json::array();
  for (const ParameterSensitivity& p : found.parameters) parameters.push_back(json_of(p, found.curve));
  const Json json{{"case", found.name},      {"case_hash", found.hash},  {"version", found.version},
                  {"method", found.method},  {"parameters", parameters}, {"events", events_of(found)},
                  {"remarks", found.remarks}};
  write_csv(folder / sensitivity_csv, table_of(found));
  write_file(folder / sensitivity_json, json_text(json));
}

std::vector<std::string> words_of(const CaseSensitivity& found) {
  std::size_t width = 9;
  for (const ParameterSensitivity& p : found.parameters) width = std::max(width, full_name(p.parameter).size());
  std::vector<std::string> lines{
      "elasticities d ln F/d ln p of the curve: with p greater by 1 % the force is greater by so many %",
      fmt::format("  {:<{}}  {:>14}  {:>8}  {:>10}  {:>6}  {:>8}", "parameter", width, "value", "largest", "at", "mean",
                  "error")};
  for (const ParameterSensitivity& p : found.parameters) {
    const auto overview = p.overview(found.curve);
    if (!overview.largest) continue;
    lines.push_back(fmt::format("  {:<{}}  {:>14}  {:>8.3f}  {:>10}  {:>6.3f}  {:>8.2g}", full_name(p.parameter), width,
                                p.parameter.shown(p.parameter.value), p.curve[*overview.largest].value,
                                quantity_text(found.curve.x[*overview.largest], "m"), overview.mean, overview.error));
  }
  for (std::size_t e = 0; e < found.events.size(); ++e) {
    lines.push_back(fmt::format("elasticities of the {}", found.events[e].event.name()));
    for (std::size_t q = 0; q < found.events[e].quantities.size(); ++q) lines.push_back(event_line(found, e, q));
  }
  return lines;
}

}  // namespace pfdm
