#include "postproc/curves/fit_json.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json estimates(const std::vector<FitParameter>& parameters, const FitResult& result) {
  Json list = Json::array();
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const FitParameter& p = parameters[j];
    const FitEstimate& e = result.estimates[j];
    list.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"estimate", e.value},
                    {"standard_error", e.standard_error},
                    {"lower_95", e.lower_95},
                    {"upper_95", e.upper_95},
                    {"first_guess", p.first},
                    {"lower_bound", p.lower},
                    {"upper_bound", p.upper},
                    {"at_bound", e.at_bound},
                    {"log_scale", p.log_scale}});
  }
  return list;
}

Json path(const std::vector<FitIteration>& iterations) {
  Json list = Json::array();
  for (const FitIteration& i : iterations) list.push_back({{"rms_residual", i.rms}, {"parameters", i.parameters}});
  return list;
}

Json experiments(const FitReport& report) {
  Json list = Json::array();
  for (const ExperimentMisfit& e : report.experiments)
    list.push_back({{"name", e.name},
                    {"data", e.n_data},
                    {"quantity", e.quantity},
                    {"unit", e.unit},
                    {fmt::format("rms_misfit_{}", e.unit), e.rms},
                    {fmt::format("rms_{}_{}", e.quantity, e.unit), e.rms_measured},
                    {"relative_misfit", e.rms / e.rms_measured},
                    {"curve", e.curve}});
  return list;
}

void read_estimates(const Json& list, FitReport& report) {
  for (const Json& p : list) {
    report.parameters.push_back({.name = p.at("name"), .unit = p.at("unit"), .first = number_of(p.at("first_guess"))});
    report.result.estimates.push_back({.value = number_of(p.at("estimate")),
                                       .standard_error = number_of(p.at("standard_error")),
                                       .lower_95 = number_of(p.at("lower_95")),
                                       .upper_95 = number_of(p.at("upper_95")),
                                       .at_bound = p.at("at_bound")});
  }
}

void read_experiment(const Json& e, FitReport& report) {
  const std::string quantity = e.at("quantity"), unit = e.at("unit");
  report.experiments.push_back({.name = e.at("name"),
                                .n_data = e.at("data"),
                                .rms = number_of(e.at(fmt::format("rms_misfit_{}", unit))),
                                .rms_measured = number_of(e.at(fmt::format("rms_{}_{}", quantity, unit))),
                                .curve = e.at("curve"),
                                .quantity = quantity,
                                .unit = unit});
}

}  // namespace

void write_fit_json(const std::filesystem::path& file, const FitReport& report) {
  const FitResult& result = report.result;
  Json json = {{"case", report.case_name},
               {"version", report.version},
               {"case_hash", report.case_hash},
               {"method", report.method},
               {"converged", result.converged},
               {"message", result.message},
               {"wall_seconds", report.wall_seconds},
               {"evaluations", result.evaluations},
               {"residuals", result.residuals.size()},
               {"rms_residual", result.rms},
               {"parameters", estimates(report.parameters, result)},
               {"warnings", result.warnings},
               {"experiments", experiments(report)},
               {"correlation", to_json(result.correlation)},
               {"start_rms_residual", result.start_rms},
               {"path", path(result.path)}};
  if (report.first_rms) json["first_guess_rms_residual"] = *report.first_rms;
  if (!result.screened.empty()) json["screened"] = path(result.screened);
  for (const TriedKernel& t : report.tried)
    json["kernel_terms_tried"].push_back(
        {{"terms", t.n_terms}, {"rms_misfit_Pa", t.rms}, {"bayesian_information", t.information}});
  for (const StaggeredRound& r : report.rounds)
    json["staggered_rounds"].push_back(
        {{"rms_misfit_after_hardening_Pa", r.rms_after_hardening}, {"rms_misfit_after_kernel_Pa", r.rms_after_kernel}});
  for (const FitStageReport& s : report.stages)
    json["earlier_stages"].push_back({{"name", s.name},
                                      {"from_m", s.from},
                                      {"to_m", s.to},
                                      {"converged", s.result.converged},
                                      {"message", s.result.message},
                                      {"residuals", s.result.residuals.size()},
                                      {"rms_residual", s.result.rms},
                                      {"first_guess_rms_residual", s.first_rms},
                                      {"parameters", estimates(s.parameters, s.result)},
                                      {"correlation", to_json(s.result.correlation)},
                                      {"path", path(s.result.path)}});
  if (report.runs)
    json["runs"] = {
        {"made", report.runs->made}, {"reused", report.runs->reused}, {"not_converged", report.runs->failed}};
  write_file(file, json.dump(2) + "\n");
}

FitReport read_fit_json(const std::filesystem::path& path) {
  return read_json(path, "fit", [](const Json& json) {
    FitReport report;
    report.case_name = json.at("case");
    report.case_hash = json.at("case_hash");
    report.version = json.at("version");
    report.method = json.at("method");
    report.wall_seconds = json.at("wall_seconds");
    report.result.converged = json.at("converged");
    report.result.message = json.at("message");
    read_estimates(json.at("parameters"), report);
    for (const Json& e : json.at("experiments")) read_experiment(e, report);
    return report;
  });
}

}  // namespace pfdm
