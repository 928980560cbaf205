#include "cases/program/studies/sensitivity/sensitivity.h"

#include "cases/program/session/head_line.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/runs/case_runs.h"
#include "cases/program/studies/sensitivity/curve_peak.h"
#include "cases/program/studies/sensitivity/sensitivity_page.h"
#include "cases/program/studies/sensitivity/sensitivity_parameters.h"
#include "cases/program/studies/sensitivity/sensitivity_results.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

constexpr std::array shares_of_step{1.0, -1.0, 0.5, -0.5};

std::vector<CaseParameter> parameters_of(const SensitivityJob& job, const Session& session,
                                         std::vector<std::string>& remarks) {
  std::vector<CaseParameter> found = job.fitted;
  if (!session.sensitivity.parameters.empty())
    found = named_parameters(session.sensitivity.parameters, job.file);
  else if (found.empty())
    found = stated_constants(job.file, remarks);
  if (session.sensitivity.parameters.empty() && !job.left_out.empty())
    remarks.push_back(
        fmt::format("left out of the parameters of [fit], as they are not positive or belong to "
                    "[experiment]: {}",
                    fmt::join(job.left_out, ", ")));
  if (found.empty())
    throw InputError(
        "the case states no positive constant of a material, a region or an interface: name values by "
        "--parameters, as in --parameters materials.glass.young_modulus");
  return found;
}

/// The case itself, then four of each parameter.
std::vector<CaseVariant> variants_of(const SensitivityJob& job, const std::vector<CaseParameter>& parameters,
                                     double step) {
  std::vector<CaseVariant> variants{{job.file, "the case itself"}};
  for (const CaseParameter& p : parameters)
    for (const double by : shares_of_step) {
      const std::array value{p.value * (1.0 + by * step)};
      const std::span one(&p, 1);
      variants.push_back({with_values(job.file, one, value), shown(one, value)});
    }
  return variants;
}

ParameterSensitivity differentiated(const CaseParameter& parameter, std::span<const DoneRun> runs,
                                    const SensitivityJob& job, double step, const CaseSensitivity& found) {
  ParameterSensitivity result{.parameter = parameter};
  const auto failed = std::ranges::find_if(runs, [](const DoneRun& run) { return !run.went_well(); });
  if (failed != runs.end()) {
    result.failure = failed->failure;
    return result;
  }
  CurvesAround around{.step = step, .curves = {}};
  for (std::size_t k = 0; k < runs.size(); ++k) around.curves[k] = job.read_curve(runs[k].folder).curve;
  result.curve = elasticities(found.curve, around);
  for (const BaseEvent& event : found.events) result.events.push_back(elasticities(event, around));
  return result;
}

/// Takes the curve of the case itself.
void take(ForwardCurve forward, CaseSensitivity& found) {
  constexpr std::size_t least_rows = 3;
  if (forward.curve.x.size() < least_rows)
    throw InputError(fmt::format(
        "the curve has {} in which its displacement grows, and needs three or more: output.curve names its patch",
        counted(static_cast<Index>(forward.curve.x.size()), "row")));
  if (forward.is_turned)
    found.remarks.emplace_back(
        "the curve moves to negative displacements: these and the forces have the other sign here");
  if (forward.n_behind > 0)
    found.remarks.push_back(fmt::format("{} of the curve fell back behind an earlier displacement, and {} left out",
                                        counted(static_cast<Index>(forward.n_behind), "row"),
                                        forward.n_behind == 1 ? "is" : "are"));
  found.curve = std::move(forward.curve);
}

void with_differences(const SensitivityJob& job, const std::vector<CaseParameter>& parameters, Session& session,
                      const std::function<void()>& begin, CaseSensitivity& found) {
  found.doubt =
      "differences with whole and half step disagree, or load steps hide the change. Take shorter load steps "
      "(loading.maximum_increment; about jumps loading.energy_release with loading.finest_increment), a longer --step, "
      "or a smaller solver.damage_tolerance";
  begin();
  CaseRuns runs(session.results / "runs", session);
  const std::vector<DoneRun> done = runs.run(variants_of(job, parameters, session.sensitivity.step));
  if (!done.front().went_well())
    throw ComputationError(fmt::format("the case itself does not come to its end: {}", done.front().failure));
  take(job.read_curve(done.front().folder), found);
  found.events = events_of(found.curve);
  for (std::size_t j = 0; j < parameters.size(); ++j)
    found.parameters.push_back(
        differentiated(parameters[j], std::span(done).subspan(1 + shares_of_step.size() * j, shares_of_step.size()),
                       job, session.sensitivity.step, found));
  session.log.say(fmt::format("{} runs made, {} reused", runs.n_made(), runs.n_reused()));
}

CurvePeak::Shape shape_of_peak(const SampledCurve& curve) {
  const auto row = static_cast<std::size_t>(std::ranges::max_element(curve.y) - curve.y.begin());
  return CurvePeak(curve, CurveBranches(curve), row).shape();
}

/// Rows after a jump, or that are lost of any parameter.
Index n_after_jumps(const DirectSensitivity& direct) {
  Index n = 0;
  for (std::size_t i = 0; i < direct.by_load.size(); ++i)
    n += std::ranges::any_of(direct.by, [i](const auto& rows) { return i < rows.size() && rows[i].is_after_jump; });
  return n;
}

/// On what one run with derivatives leaves open.
void add_remarks(const DirectSensitivity& direct, CaseSensitivity& found) {
  if (const Index n = n_after_jumps(direct); n > 0)
    found.remarks.push_back(fmt::format(
        "{} lie after a jump, or after one whose derivatives were lost: elasticities are approximate there, "
        "by an unknown error",
        counted(n, "row")));
  if (direct.may_debond)
    found.remarks.emplace_back("--method direct does not look for the first debonding; --method differences does");
  const auto is_peak = [](const BaseEvent& e) { return e.event.kind == EventKind::greatest_force; };
  if (std::ranges::any_of(found.events, is_peak) && shape_of_peak(direct.curve) == CurvePeak::Shape::row)
    found.remarks.emplace_back(
        "the greatest force is neither smooth nor a corner between enough rows: it has no direct derivative. Shorter "
        "load steps about it may show one (loading.maximum_increment)");
}

void directly(const SensitivityJob& job, const std::vector<CaseParameter>& parameters, Session& session,
              const std::function<void()>& begin, CaseSensitivity& found) {
  found.doubt =
      "the state lies behind a jump, or next to one, where the equations of the derivatives are singular. Of a jump's "
      "displacement shorter load steps before it tell more (loading.maximum_increment, loading.finest_increment)";
  const DirectSensitivity direct = job.direct(parameters, session);  // which may refuse the case
  begin();
  take({.curve = direct.curve, .is_turned = direct.is_turned}, found);
  found.events = events_of(found.curve);
  add_remarks(direct, found);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    ParameterSensitivity& p =
        found.parameters.emplace_back(ParameterSensitivity{.parameter = parameters[j], .failure = direct.failures[j]});
    if (!p.failure.empty()) continue;
    p.curve = elasticities(direct, j);
    for (const BaseEvent& event : found.events) p.events.push_back(elasticities(direct, j, event));
  }
  session.log.say(fmt::format("processor time {:.1f} s of the run, {:.1f} s of its derivatives", direct.seconds_of_run,
                              direct.seconds_more));
}

std::string words_on_method(const SensitivityWords& words) {
  if (words.method == "direct") return "direct differentiation of one run";
  return fmt::format("differences of {:g} % and {:g} %", 100.0 * words.step, 50.0 * words.step);
}

}  // namespace

void run_sensitivity(const SensitivityJob& job, Session& session) {
  const Stopwatch watch;
  CaseSensitivity found{.name = job.name,
                        .title = job.title,
                        .version = session.version,
                        .hash = job.hash,
                        .method = words_on_method(session.sensitivity),
                        .doubt = {},
                        .curve = {},
                        .events = {},
                        .parameters = {},
                        .remarks = {}};
  const std::vector<CaseParameter> parameters = parameters_of(job, session, found.remarks);
  session.log.say(
      head_line(session, fmt::format("sensitivity of {} to {} by {}", job.name,
                                     counted(static_cast<Index>(parameters.size()), "parameter"), found.method)));
  std::optional<FolderLock> lock;
  const auto begin = [&] {
    lock.emplace(session.results);
    session.log.open_file(session.results / "sensitivity.log", true);
  };
  (session.sensitivity.method == "direct" ? directly : with_differences)(job, parameters, session, begin, found);
  conclude(found);
  write_sensitivity(session.results, found);
  for (const std::string& line : words_of(found)) session.log.say(line);
  for (const std::string& remark : found.remarks) session.log.warn(remark);
  session.log.say(fmt::format("{:.1f} s; written to {} and {}", watch.seconds(),
                              (session.results / sensitivity_json).string(), sensitivity_csv));
  report_sensitivity(found, session);
}

}  // namespace pfdm
