#include "postproc/fits/fit_json.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"
#include "postproc/files/unit_key.h"
#include "postproc/fits/event_json.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format = 1;

Json to_json(const SampledInterval& interval) {
  return {{"median", interval.median}, {"lower", interval.lower}, {"upper", interval.upper}};
}

Json to_json(const std::vector<FittedParameter>& parameters) {
  Json list = Json::array();
  for (const FittedParameter& p : parameters) {
    list.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"estimate", p.estimate},
                    {"standard_error", p.standard_error},
                    {"lower", p.lower},
                    {"upper", p.upper},
                    {"first_guess", p.first_guess},
                    {"lower_bound", p.lower_bound},
                    {"upper_bound", p.upper_bound},
                    {"at_bound", p.at_bound},
                    {"log_scale", p.log_scale}});
    if (p.widened_by > 1.0) list.back()["widened_by"] = p.widened_by;
    if (!std::isnan(p.moved_by_finer)) list.back()["moved_by_finer"] = p.moved_by_finer;
    if (p.profile)
      list.back()["profile"] = {{"lower", p.profile->lower},
                                {"upper", p.profile->upper},
                                {"lower_open", p.profile->lower_open},
                                {"upper_open", p.profile->upper_open}};
    if (p.posterior) list.back()["posterior"] = to_json(*p.posterior);
  }
  return list;
}

Json to_json(const PosteriorFindings& posterior) {
  Json json = {{"file", posterior.file},
               {"emulator_error", posterior.emulator_error},
               {"effective_samples", posterior.effective},
               {"evaluations", posterior.evaluations},
               {"law_files", posterior.law_files}};
  if (const auto& discrepancy = posterior.discrepancy)
    json["discrepancy"] = {{"file", discrepancy->file},
                           {"amplitude_N", to_json(discrepancy->amplitude)},
                           {"length_m", to_json(discrepancy->length)}};
  return json;
}

Json to_json(const std::vector<FitIteration>& iterations) {
  Json list = Json::array();
  for (const FitIteration& i : iterations) list.push_back({{"rms_residual", i.rms}, {"parameters", i.parameters}});
  return list;
}

Json to_json(const FitFindings& found) {
  std::vector<double> start_rms;
  for (const FitIteration& start : found.starts) start_rms.push_back(start.rms);
  Json json = {{"verdict", name_of(found.verdict)},
               {"reasons", found.reasons},
               {"converged", found.converged},
               {"message", found.message},
               {"evaluations", found.evaluations},
               {"residuals", found.n_residuals},
               {"rms_residual", found.rms},
               {"noise_is_known", found.noise_is_known},
               {"parameters", to_json(found.parameters)},
               {"correlation", pfdm::to_json(found.correlation)},
               {"warnings", found.warnings},
               {"start_rms_residual", start_rms},
               {"path", to_json(found.path)}};
  if (!found.finer.empty()) json["finer"] = found.finer;
  if (found.finer.empty() && found.is_discretised) json["finer"] = nullptr;
  if (!found.sensitivity_file.empty()) json["sensitivity_file"] = found.sensitivity_file;
  if (found.posterior) json["posterior"] = to_json(*found.posterior);
  if (found.first_rms) json["first_guess_rms_residual"] = *found.first_rms;
  if (!found.screened.empty()) json["screened"] = to_json(found.screened);
  return json;
}

Json to_json(const std::vector<ExperimentMisfit>& experiments) {
  Json list = Json::array();
  for (const ExperimentMisfit& e : experiments) {
    Json& entry = list.emplace_back(
        Json{{"name", e.name}, {"fitted", e.fitted}, {"data", e.n_data}, {"relative_misfit", e.relative}});
    if (const auto& a = e.absolute) {
      entry["quantity"] = a->quantity;
      entry["unit"] = a->unit;
      entry[key_with_unit("rms_misfit", a->unit)] = a->rms;
      entry[key_with_unit("rms_" + a->quantity, a->unit)] = a->rms_measured;
    }
    if (!e.curve.empty()) entry["curve"] = e.curve;
    if (!e.preparation.empty()) entry["preparation"] = e.preparation;
  }
  return list;
}

Json to_json(const RunCounts& runs) {
  return {{"made", runs.made}, {"reused", runs.reused}, {"not_converged", runs.failed}};
}

Json to_json(const FractureFindings& own) {
  Json stages = Json::array();
  for (const FitStage& s : own.earlier_stages) {
    stages.push_back({{"name", s.name}, {"from_m", s.from}, {"to_m", s.to}});
    stages.back().update(to_json(s.found));
  }
  Json json{{"earlier_stages", stages}, {"runs", to_json(own.runs)}};
  if (own.coarse_runs) json["coarse_runs"] = to_json(*own.coarse_runs);
  return json;
}

std::optional<FittedProfile> profile_in(const Json& parameter) {
  if (!parameter.contains("profile")) return std::nullopt;
  const Json& p = parameter.at("profile");
  return FittedProfile{.lower = number_of(p.at("lower")),
                       .upper = number_of(p.at("upper")),
                       .lower_open = p.at("lower_open"),
                       .upper_open = p.at("upper_open")};
}

SampledInterval interval_in(const Json& p) {
  return {.median = number_of(p.at("median")), .lower = number_of(p.at("lower")), .upper = number_of(p.at("upper"))};
}

std::optional<SampledInterval> posterior_of(const Json& parameter) {
  if (!parameter.contains("posterior")) return std::nullopt;
  return interval_in(parameter.at("posterior"));
}

std::optional<DiscrepancyFindings> discrepancy_in(const Json& posterior) {
  if (!posterior.contains("discrepancy")) return std::nullopt;
  const Json& d = posterior.at("discrepancy");
  return DiscrepancyFindings{
      .file = d.at("file"), .amplitude = interval_in(d.at("amplitude_N")), .length = interval_in(d.at("length_m"))};
}

std::optional<PosteriorFindings> posterior_in(const Json& json) {
  if (!json.contains("posterior")) return std::nullopt;
  const Json& p = json.at("posterior");
  return PosteriorFindings{.file = p.at("file"),
                           .emulator_error = number_of(p.at("emulator_error")),
                           .effective = number_of(p.at("effective_samples")),
                           .evaluations = whole_number<int>(p.at("evaluations")),
                           .law_files = p.at("law_files"),
                           .discrepancy = discrepancy_in(p)};
}

std::vector<FittedParameter> parameters_in(const Json& list) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<FittedParameter> parameters;
  for (const Json& p : list)
    parameters.push_back({.name = p.at("name"),
                          .unit = p.at("unit"),
                          .estimate = number_of(p.at("estimate")),
                          .standard_error = number_of(p.at("standard_error")),
                          .lower = number_of(p.at("lower")),
                          .upper = number_of(p.at("upper")),
                          .first_guess = number_of(p.at("first_guess")),
                          .at_bound = p.at("at_bound"),
                          .profile = profile_in(p),
                          .posterior = posterior_of(p),
                          .moved_by_finer = p.contains("moved_by_finer") ? number_of(p.at("moved_by_finer")) : none});
  return parameters;
}

ExperimentMisfit experiment_in(const Json& e) {
  ExperimentMisfit misfit{.name = e.at("name"),
                          .fitted = e.at("fitted"),
                          .n_data = whole_number<std::size_t>(e.at("data")),
                          .relative = number_of(e.at("relative_misfit")),
                          .curve = e.value("curve", "")};
  if (!e.contains("unit")) return misfit;
  const std::string quantity = e.at("quantity"), unit = e.at("unit");
  misfit.absolute = {.rms = number_of(e.at(key_with_unit("rms_misfit", unit))),
                     .rms_measured = number_of(e.at(key_with_unit("rms_" + quantity, unit))),
                     .quantity = quantity,
                     .unit = unit};
  return misfit;
}

std::string finer_in(const Json& json) {
  const auto found = json.find("finer");
  return found == json.end() || found->is_null() ? std::string() : found->get<std::string>();
}

FitReport report_in(const Json& json) {
  FitReport report{.case_name = json.at("case"),
                   .case_hash = json.at("case_hash"),
                   .version = json.at("version"),
                   .method = json.at("method"),
                   .wall_seconds = json.at("wall_seconds"),
                   .confidence = json.at("confidence"),
                   .found = {.verdict = verdict_named(json.value("verdict", name_of(Verdict::questionable))),
                             .reasons = json.value("reasons", std::vector<std::string>{}),
                             .converged = json.at("converged"),
                             .message = json.at("message"),
                             .parameters = parameters_in(json.at("parameters")),
                             .posterior = posterior_in(json),
                             .sensitivity_file = json.value("sensitivity_file", ""),
                             .finer = finer_in(json),
                             .is_discretised = json.contains("finer")},
                   .experiments = {},
                   .events = json.contains("events") ? events_in(json.at("events")) : std::vector<FittedEvent>{},
                   .fields = json.contains("fields") ? fields_in(json.at("fields")) : std::vector<FittedField>{},
                   .own = {.kind = json.at("kind")}};
  for (const Json& e : json.at("experiments")) report.experiments.push_back(experiment_in(e));
  report.own.json = json_line(json.at(report.own.kind));
  return report;
}

}  // namespace

OwnFindings own_findings(const FractureFindings& findings) {
  return {.kind = "fracture", .json = json_line(to_json(findings))};
}

namespace {

Json to_json(const FitReport& report) {
  Json json = {{"format", format},
               {"kind", report.own.kind},
               {"case", report.case_name},
               {"version", report.version},
               {"case_hash", report.case_hash},
               {"method", report.method},
               {"wall_seconds", report.wall_seconds},
               {"confidence", report.confidence}};
  json.update(to_json(report.found));
  json["experiments"] = to_json(report.experiments);
  if (!report.events.empty()) json["events"] = to_json(report.events);
  if (!report.fields.empty()) json["fields"] = to_json(report.fields);
  json[report.own.kind] = Json::parse(report.own.json);
  return json;
}

}  // namespace

void write_fit_json(const std::filesystem::path& file, const FitReport& report) {
  write_file(file, json_text(to_json(report)));
}

std::string fit_json_like(const std::string& kind) {
  FitReport report;
  report.own.kind = kind;
  FittedParameter& parameter = report.found.parameters.emplace_back();
  parameter.profile.emplace();
  parameter.posterior.emplace();
  parameter.widened_by = 2.0;
  parameter.moved_by_finer = 0.0;
  report.found.finer = report.found.sensitivity_file = "name";
  report.found.posterior.emplace().discrepancy.emplace();
  report.found.first_rms = 0.0;
  report.found.screened = {FitIteration{}};
  Json json = to_json(report);
  for (const char* name : {"experiments", "events", "fields"}) json[name] = Json::array();
  return json_text(json);
}

FitReport read_fit_json(const std::filesystem::path& path) {
  return read_json(path, "fit", [&](const Json& json) {
    if (const int found = whole_number<int>(json.value("format", Json(0))); found != format)
      throw InputError(fmt::format("{}: the file has format {}, this version reads format {}; run pfdm fit again",
                                   path.string(), found, format));
    return report_in(json);
  });
}

}  // namespace pfdm
