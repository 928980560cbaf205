#include "postproc/reduction/reduction_results.h"

#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::optional<InitiationPoint>& point) {
  if (!point) return {};
  return {{"displacement_m", point->displacement}, {"force_N", point->force}};
}

Json to_json(const Reduced& value) {
  Json json = {{"G_J_per_m2", value.toughness}, {"crack_length_m", value.crack_length}};
  if (std::isfinite(value.mode_two_share)) json["mode_two_share"] = value.mode_two_share;
  return json;
}
Json to_json(const std::optional<Reduced>& value) { return value ? to_json(*value) : Json(); }

Json to_json(const ReducedByMethod& method) {
  Json json = {{"name", method.name}, {"source", method.source}};
  json["missing"] = method.missing.empty() ? Json() : Json(method.missing);
  if (!method.missing.empty()) return json;
  json["constants"] = Json::array();
  for (const ReductionConstant& c : method.constants)
    json["constants"].push_back({{"name", c.name}, {"value", c.value}, {"unit", c.unit}});
  json["initiation"] = {{"NL", to_json(method.nonlinearity)},
                        {"VIS", to_json(method.visual)},
                        {"5_percent_or_MAX", to_json(method.five_percent)}};
  const Propagation& p = method.propagation;
  json["propagation"] = {{"points", p.n_points},
                         {"G_J_per_m2", p.toughness},
                         {"standard_deviation_J_per_m2", p.deviation},
                         {"rise_J_per_m3", p.rise}};
  return json;
}

Json to_json(const ReducedTest& test) {
  Json json = {{"name", test.name}, {"specimen", test.specimen}};
  json["initial_compliance_m_per_N"] = test.straight.compliance;
  json["origin_m"] = test.origin;
  json["greatest_force_N"] = test.straight.greatest_force;
  json["initiation"] = {{"NL", to_json(test.nonlinearity)},
                        {"VIS", to_json(test.visual)},
                        {"5_percent_or_MAX", to_json(std::optional(test.five_percent))}};
  json["methods"] = Json::array();
  for (const ReducedByMethod& method : test.methods) json["methods"].push_back(to_json(method));
  json["remarks"] = test.remarks;
  return json;
}

CsvTable points_table(std::span<const ReducedTest> tests) {
  CsvTable table;
  table.comments = {" points behind 5 %/MAX; row: of the record as [experiment] prepares it, from 1",
                    " displacement: from the origin, at which the straight part meets zero force (origin_m)"};
  for (const char* name :
       {"test", "method", "row", "displacement_m", "force_N", "crack_length_m", "G_J_per_m2", "mode_two_share"})
    table.add(name, {});
  for (std::size_t t = 0; t < tests.size(); ++t) {
    table.comments.push_back(fmt::format(" test {}: {}", t, tests[t].name));
    for (std::size_t m = 0; m < tests[t].methods.size(); ++m) {
      const ReducedByMethod& method = tests[t].methods[m];
      if (t == 0) table.comments.push_back(fmt::format(" method {}: {}; {}", m, method.name, method.source));
      for (const ReducedPoint& point : method.points) {
        const double row[] = {static_cast<double>(t),
                              static_cast<double>(m),
                              static_cast<double>(point.row + 1),
                              tests[t].record.displacement[point.row],
                              tests[t].record.force[point.row],
                              point.found.crack_length,
                              point.found.toughness,
                              point.found.mode_two_share};
        for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].push_back(row[c]);
      }
    }
  }
  return table;
}

std::string shown(double toughness) { return std::isfinite(toughness) ? fmt::format("{:.4g}", toughness) : "-"; }

std::string shown(const ReductionConstant& constant) {
  if (constant.unit == "1") return fmt::format("{:.4g}", constant.value);
  if (constant.unit.find('^') != std::string::npos) return fmt::format("{:.4g} {}", constant.value, constant.unit);
  return quantity_text(constant.value, constant.unit);
}

std::string line_of(const ReducedByMethod& method) {
  if (!method.missing.empty()) return fmt::format("  {}: {}", method.name, method.missing);
  const Propagation& p = method.propagation;
  std::string text = fmt::format(
      "  {}: NL {}, VIS {}, 5 %/MAX {}", method.name, shown(method.nonlinearity.value_or(Reduced{}).toughness),
      shown(method.visual.value_or(Reduced{}).toughness), shown(method.five_percent.toughness));
  if (p.n_points > 0)
    text += fmt::format(", propagation {} +- {} J/m^2 ({} points)", shown(p.toughness), shown(p.deviation), p.n_points);
  else
    text += " J/m^2, no point of propagation";
  if (std::isfinite(method.five_percent.mode_two_share))
    text += fmt::format(", GII/G = {:.3f}", method.five_percent.mode_two_share);
  for (const ReductionConstant& c : method.constants) text += fmt::format(", {} = {}", c.name, shown(c));
  return text;
}

}  // namespace

void write_reduction(const std::filesystem::path& results, const ReductionReport& report) {
  Json json = {{"case", report.case_name}, {"version", report.version}, {"case_hash", report.case_hash}};
  json["tests"] = Json::array();
  for (const ReducedTest& test : report.tests) json["tests"].push_back(to_json(test));
  json["fitted"] = Json::array();
  for (const ReductionReport::Fitted& f : report.fitted)
    json["fitted"].push_back({{"name", f.name},
                              {"verdict", f.verdict},
                              {"estimate_J_per_m2", f.estimate},
                              {"lower_J_per_m2", f.lower},
                              {"upper_J_per_m2", f.upper}});
  write_csv(results / "reduction.csv", points_table(report.tests));
  write_file(results / reduction_file, json_text(json));
}

std::vector<std::string> reduction_text(const ReducedTest& test) {
  std::vector<std::string> lines{
      fmt::format("data reduction of \"{}\", {}: initial compliance {}, greatest force {}; G "
                  "[J/m^2] at initiation and in propagation",
                  test.name, test.specimen, quantity_text(test.straight.compliance, "m/N", 5),
                  quantity_text(test.straight.greatest_force, "N", 5))};
  for (const ReducedByMethod& method : test.methods) lines.push_back(line_of(method));
  for (const std::string& remark : test.remarks) lines.push_back("  doubtful: " + remark);
  return lines;
}

}  // namespace pfdm
