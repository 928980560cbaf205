#include "cases/program/studies/fit/curve_fit_case.h"

#include "cases/program/input/config/key_member.h"

#include "cases/program/studies/runs/finer_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace pfdm {
namespace {

void read_prior(const ConfigTable& table, CurveFitParameter& parameter) {
  if (!table.has("prior")) return;
  const ConfigTable prior = table.table("prior");
  const double mean = read_parameter_value(prior.at("mean"), parameter.in_case);
  const double deviation = read_parameter_value(prior.at("deviation"), parameter.in_case);
  if (!(deviation > 0.0)) throw prior.at("deviation").error("a standard deviation must be positive");
  if (parameter.in_fit.log_scale && !(mean > 0.0)) throw prior.at("mean").error("the mean must be positive");
  parameter.in_fit.prior = {.mean = mean,
                            .standard_deviation = parameter.in_fit.log_scale ? deviation / mean : deviation};
}

CurveFitParameter read_parameter(const ConfigTable& table, const CaseFile& file) {
  CurveFitParameter parameter{.in_case = read_case_parameter(table.at("key"), file), .in_fit = {}};
  const CaseParameter& in_case = parameter.in_case;
  const ConfigValue bounds = table.at("bounds");
  const std::vector<ConfigValue> ends = bounds.list(2);
  FitParameter& p = parameter.in_fit;
  p.name = in_case.name;
  p.unit = in_case.dimension.si_unit;
  p.first = in_case.value;
  p.lower = read_parameter_value(ends[0], in_case);
  p.upper = read_parameter_value(ends[1], in_case);
  p.log_scale = p.lower > 0.0;
  if (!(p.lower < p.upper)) throw bounds.error("the lower bound must be below the upper one");
  read_prior(table, parameter);
  return parameter;
}

std::vector<std::size_t> all_of(const std::vector<CurveFitParameter>& parameters) {
  std::vector<std::size_t> numbers;
  for (std::size_t j = 0; j < parameters.size(); ++j) numbers.push_back(j);
  return numbers;
}

/// How many descents a stage makes and from where, as `table` says, or else as it is.
void read_starts(const ConfigTable& table, CurveFitStage& stage) {
  read_stored(table, stage);
  if (stage.screened == 0 || stage.starts <= stage.screened) return;
  throw table.at(table.has("starts") ? "starts" : "screened")
      .error(fmt::format("{} descents cannot be chosen from {} screened points", stage.starts, stage.screened));
}

CurveFitStage whole_stage(const ConfigTable& fit, const std::vector<CurveFitParameter>& parameters) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  CurveFitStage stage{.name = "whole curve", .parameters = all_of(parameters), .from = -infinite, .to = infinite};
  read_starts(fit, stage);
  return stage;
}

CurveFitStage read_stage(const ConfigTable& table, const CurveFitStage& whole,
                         const std::vector<CurveFitParameter>& parameters) {
  CurveFitStage stage = whole;
  stage.name = table.string("name");
  read_starts(table, stage);
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const CurveFitParameter& parameter : parameters) names.push_back(parameter.in_case.name);
  if (const auto list = table.find("parameters")) {
    stage.parameters.clear();
    for (const ConfigValue& entry : list->list()) {
      const auto number = std::ranges::find(names, entry.one_of(names, "key of [[fit.parameters]]")) - names.begin();
      if (std::ranges::count(stage.parameters, static_cast<std::size_t>(number)) > 0)
        throw entry.error("this parameter is named twice");
      stage.parameters.push_back(static_cast<std::size_t>(number));
    }
    if (stage.parameters.empty()) throw list->error("a stage without parameters has nothing to estimate");
  }
  if (const auto between = table.find("between")) {
    const std::vector<ConfigValue> ends = between->list(2);
    stage.from = ends[0].quantity();
    stage.to = ends[1].quantity();
    if (!(stage.from < stage.to)) throw between->error("the second displacement must be the larger");
  }
  return stage;
}

FitSettings read_settings(const ConfigTable& fit) {
  FitSettings settings{.maximum_iterations = 30, .least_step = 1e-4, .step = 0.02, .spread = 1.0};
  read_stored(fit, settings);
  const std::string kind = fit.choice("differences", "central");
  if (kind == "forward") settings.differences = Differences::forward;
  if (kind == "shared") settings.differences = Differences::shared;
  settings.tolerance = 1e-8;
  settings.trust_radius = 30.0;
  settings.side_by_side = false;
  return settings;
}

void require_each_in_a_stage(const CurveFitSettings& settings, const ConfigTable& fit) {
  for (std::size_t j = 0; j < settings.parameters.size(); ++j)
    if (std::ranges::none_of(settings.stages,
                             [&](const CurveFitStage& stage) { return std::ranges::count(stage.parameters, j) > 0; }))
      throw fit.at("stages").error(fmt::format("no stage estimates \"{}\"", settings.parameters[j].in_case.name));
}

Intervals read_intervals(const ConfigTable& fit, const ConfigTable& root) {
  const std::string intervals = fit.choice("intervals", "linear");
  if (intervals == "profile") return Intervals::profile;
  if (intervals == "posterior") return Intervals::posterior;
  if (intervals != "discrepancy") return Intervals::linear;
  for (const char* other : {"events", "fields"})
    if (root.has("experiment") && !root.table("experiment").tables(other).empty())
      throw fit.at("intervals")
          .error(fmt::format("a discrepancy of the model is one of force over displacement: it does not go with "
                             "[[experiment.{}]]",
                             other));
  return Intervals::discrepancy;
}

}  // namespace

void require_start_within_bounds(const ConfigTable& fit, const std::vector<CurveFitParameter>& parameters) {
  const std::vector<ConfigTable> tables = fit.tables("parameters");
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto& [in_case, p] = parameters[j];
    if (p.lower <= p.first && p.first <= p.upper) continue;
    throw tables[j].at("bounds").error(fmt::format(
        "the case's own value, {}, from which the fit starts, is outside these bounds", in_case.shown(p.first)));
  }
}

std::vector<CurveFitParameter> read_fit_parameters(const ConfigTable& fit, const CaseFile& file) {
  std::vector<CurveFitParameter> parameters;
  std::vector<CaseParameter> in_case;
  for (const ConfigTable& table : fit.tables("parameters")) {
    parameters.push_back(read_parameter(table, file));
    in_case.push_back(parameters.back().in_case);
    require_named_once(table.at("key"), in_case);
  }
  if (parameters.empty()) throw fit.error("at least one [[fit.parameters]] is required");
  return parameters;
}

std::optional<CurveFitSettings> read_curve_fit(const CaseFile& file) {
  const ConfigTable root = file.config.root();
  if (!root.has("fit")) return std::nullopt;
  const ConfigTable fit = root.table("fit");
  finer_case(fit, file);  // whether they make sense
  coarse_case(fit, file);
  CurveFitSettings settings{.parameters = {}, .stages = {}, .solver = read_settings(fit), .where = fit};
  settings.intervals = read_intervals(fit, root);
  settings.parameters = read_fit_parameters(fit, file);
  const CurveFitStage whole = whole_stage(fit, settings.parameters);
  for (const ConfigTable& table : fit.tables("stages"))
    settings.stages.push_back(read_stage(table, whole, settings.parameters));
  if (settings.stages.empty()) settings.stages.push_back(whole);
  require_each_in_a_stage(settings, fit);
  return settings;
}

}  // namespace pfdm
