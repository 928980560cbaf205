#include "cases/program/fracture/outcome/fracture_comparison.h"

#include "cases/program/fracture/outcome/fracture_files.h"
#include "physics/angle.h"
#include "physics/quantity_text.h"
#include "postproc/cohesive/cohesive_law.h"
#include "postproc/curves/comparison_results.h"
#include "postproc/curves/record_faults.h"
#include "postproc/curves/summary.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

AngleComparison compare_debonding(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                                  const std::vector<ColumnRecord>& records) {
  std::vector<SampledCurve> measured;
  for (const MeasuredAngle& angle : experiment.angles) measured.push_back(angle.curve);
  return compare_angles(computed_angle(experiment, rows, records), measured);
}

std::vector<EnergyComparison> compare_energies_of(const ExperimentSettings& experiment,
                                                  const std::vector<CurveRow>& rows) {
  std::vector<EnergyComparison> compared;
  for (const EnergyKind& kind : energy_kinds()) {
    std::vector<SampledCurve> measured;
    for (const MeasuredEnergy& energy : experiment.energies)
      if (energy.kind == &kind) measured.push_back(energy.curve);
    if (!measured.empty())
      compared.push_back(compare_energies(std::string(kind.name), computed_energy(rows, kind), measured));
  }
  return compared;
}

void say(const ForceComparison& force, Log& log) {
  const auto line = [&](const char* what, const char* unit, double model, double measured) {
    log.say(fmt::format("  {:<22} {:>12}  measured {}, {:+.2f} %", what, quantity_text(model, unit, 6),
                        quantity_text(measured, unit, 6), 100.0 * (model / measured - 1.0)));
  };
  log.say(fmt::format("force against displacement from {}, specimens: {}",
                      quantities_text({force.curves.x.front(), force.curves.x.back()}, "m", " to "),
                      force.names.size()));
  line("initial stiffness", "N/m", force.model.initial_stiffness, force.mean.initial_stiffness);
  line("peak", "N", force.model.peak_force, force.mean.peak_force);
  line("displacement at peak", "m", force.model.displacement_at_peak, force.mean.displacement_at_peak);
  line("work", "J", force.model.work, force.mean.work);
  log.say(fmt::format("  difference rms {} ({:.2f} % of the largest force), at most {} at {}",
                      quantity_text(force.curves.rms, "N"), 100.0 * force.curves.rms / force.curves.largest_measured,
                      quantity_text(force.curves.largest, "N"), quantity_text(force.curves.x_of_largest, "m")));
  if (force.curves.share_in_band)
    log.say(fmt::format("  within two standard deviations over {:.1f} % of the range",
                        100.0 * *force.curves.share_in_band));
}

void say(const AngleComparison& angle, Log& log) {
  const auto onset = [](const std::optional<double>& at) { return at ? quantity_text(*at, "m") : "never"; };
  log.say(fmt::format("debonding angle: difference rms {:.3g} degrees, at most {:.3g} at {}; begins at {}, measured {}",
                      angle.curves.rms / degree, angle.curves.largest / degree,
                      quantity_text(angle.curves.x_of_largest, "m"), onset(angle.model_onset),
                      onset(angle.mean_onset)));
}

void say(const EnergyComparison& energy, Log& log) {
  const ComparedCurves& c = energy.curves;
  log.say(fmt::format("energy {}: {} at {}, measured {}; difference at most {:.2f} % of the largest", energy.kind,
                      quantity_text(c.model.back(), "J"), quantity_text(c.x.back(), "m"),
                      quantity_text(c.measured.back(), "J"), 100.0 * c.largest / c.largest_measured));
}

/// What was done to the measured curves, and which of them miss the origin.
void say_preparation(const ExperimentSettings& experiment, const SampledCurve& model, Log& log) {
  for (const MeasuredCurve& specimen : experiment.specimens) {
    for (const std::string& done : specimen.treatment()) log.say(fmt::format("{}: {}", specimen.curve.name, done));
    const auto doubt =
        doubt_of_origin(specimen.of_specimen(), model, experiment.stiffness_from, experiment.stiffness_to);
    if (doubt) log.warn(*doubt);
  }
}

}  // namespace

SampledCurve computed_curve(const std::vector<CurveRow>& rows, int component,
                            std::optional<std::size_t> first_debonding) {
  SampledCurve curve{.name = "computed", .x = {}, .y = {}, .first_debonding = first_debonding};
  for (const CurveRow& row : rows) {
    curve.x.push_back(row.displacement);
    curve.y.push_back(row.force[component]);
  }
  return driven_curve(curve);
}

std::optional<std::size_t> first_debonding_in(const std::filesystem::path& results, const std::vector<CurveRow>& rows,
                                              int component) {
  const auto summary = read_summary(results / summary_file);
  if (!summary) return std::nullopt;
  const double displacement = summary->number("first_debonding_displacement_m"),
               force = summary->number("first_debonding_force_N");
  const auto row = std::ranges::find_if(
      rows, [&](const CurveRow& r) { return r.displacement == displacement && r.force[component] == force; });
  if (row == rows.end()) return std::nullopt;
  return static_cast<std::size_t>(row - rows.begin());
}

const ColumnRecord& measured_surface(const ExperimentSettings& experiment, const std::vector<ColumnRecord>& records) {
  const std::string& surface = experiment.angles.front().surface;
  if (surface.empty()) return records.front();
  const auto found = std::ranges::find(records, surface, &ColumnRecord::name);
  if (found == records.end())
    throw experiment.where.error(
        fmt::format("there is no surface \"{}\" in the results; the first is \"{}\"", surface, records.front().name));
  return *found;
}

SampledCurve computed_angle(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                            const std::vector<ColumnRecord>& records) {
  const MeasuredAngle& first = experiment.angles.front();
  const std::vector<Debonding> history = debonding_of(measured_surface(experiment, records));
  SampledCurve model{.name = "computed", .x = {}, .y = {}};
  for (std::size_t i = 0; i < std::min(history.size(), rows.size()); ++i) {
    model.x.push_back(rows[i].displacement);
    model.y.push_back(first.at_positive ? history[i].angle_plus : history[i].angle_minus);
  }
  return model;
}

SampledCurve computed_energy(const std::vector<CurveRow>& rows, const EnergyKind& kind) {
  SampledCurve curve{.name = "computed", .x = {}, .y = {}};
  for (const CurveRow& row : rows) {
    curve.x.push_back(row.displacement);
    curve.y.push_back(kind.of(rows.front().energy, row.energy));
  }
  return driven_curve(curve);
}

void compare_with_experiment(const FractureCase& fracture, const ExperimentSettings& experiment,
                             const std::string& name, const std::string& hash, Session& session) {
  const std::vector<CurveRow> rows = read_curve_record(session.results, hash);
  ComparisonReport report{.case_name = name, .case_hash = hash, .version = session.version, .force = {}, .angle = {}};
  const SampledCurve computed = computed_curve(rows, fracture.output.curve.component);
  report.force = experiment.where.in_context([&] {
    return compare_forces(computed, specimen_curves(experiment), experiment.stiffness_from, experiment.stiffness_to);
  });
  for (const MeasuredCurve& specimen : experiment.specimens) report.force.preparation.push_back(specimen.treatment());
  if (!experiment.angles.empty()) {
    const std::vector<ColumnRecord> records = read_column_record(session.results, hash);
    report.angle = experiment.where.in_context([&] { return compare_debonding(experiment, rows, records); });
  }
  report.energies = experiment.where.in_context([&] { return compare_energies_of(experiment, rows); });
  write_comparison(session.results, report);
  say_preparation(experiment, computed, session.log);
  say(report.force, session.log);
  if (report.angle) say(*report.angle, session.log);
  for (const EnergyComparison& energy : report.energies) say(energy, session.log);
  session.log.say(fmt::format("written to {}", (session.results / "comparison.json").string()));
}

}  // namespace pfdm
