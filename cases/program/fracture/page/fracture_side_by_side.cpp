#include "cases/program/fracture/page/fracture_side_by_side.h"

#include "cases/program/fracture/outcome/debonded_poles.h"
#include "cases/program/fracture/outcome/fracture_comparison.h"
#include "cases/program/fracture/page/debonding_charts.h"
#include "cases/program/session/report_parts.h"
#include "physics/angle.h"
#include "postproc/curves/comparison_results.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

struct Pair {
  std::string caption;  // of the chart, and of the table's row
  std::string si_unit;  // "degree" for angles, in which they are shown
  SampledCurve computed;
  std::vector<SampledCurve> measured;
};

Chart chart_of(const Pair& pair) {
  std::vector<std::vector<double>> all{pair.computed.y};
  for (const SampledCurve& curve : pair.measured) all.push_back(curve.y);
  const DisplayUnit x = common_unit({{pair.computed.x}}, "m");
  const DisplayUnit y = common_unit(all, pair.si_unit);
  Chart chart{.caption = pair.caption,
              .x = {.title = fmt::format("displacement [{}]", x.name)},
              .y = {.title = fmt::format("energy [{}]", y.name)},
              .series = {}};
  int colour = 1;
  for (const SampledCurve& curve : pair.measured)
    chart.series.push_back(
        {.label = curve.name, .x = in_unit(curve.x, x), .y = in_unit(curve.y, y), .colour = colour++});
  chart.series.push_back({.label = "computed",
                          .x = in_unit(pair.computed.x, x),
                          .y = in_unit(pair.computed.y, y),
                          .style = SeriesStyle::line_with_points});
  return chart;
}

bool has_angles(const ExperimentSettings& experiment, const std::vector<ColumnRecord>& records) {
  return !experiment.angles.empty() && !records.empty();
}

Pair angle_pair(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                const std::vector<ColumnRecord>& records, const Vector& axis) {
  Pair angle{.caption = "Debonding angle, " + name_of_pole(experiment.angles.front().at_positive, axis),
             .si_unit = "degree",
             .computed = computed_angle(experiment, rows, records),
             .measured = {}};
  for (const MeasuredAngle& measured : experiment.angles) angle.measured.push_back(measured.curve);
  return angle;
}

std::vector<Pair> energy_pairs(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows) {
  std::vector<Pair> pairs;
  for (const EnergyKind& kind : energy_kinds()) {
    Pair energy{.caption = fmt::format("Energy: {}", kind.description),
                .si_unit = "J",
                .computed = computed_energy(rows, kind),
                .measured = {}};
    for (const MeasuredEnergy& measured : experiment.energies)
      if (measured.kind == &kind) energy.measured.push_back(measured.curve);
    if (!energy.measured.empty()) pairs.push_back(std::move(energy));
  }
  return pairs;
}

/// "synthetic", "mean of 3": the experiment's name of a curve may tell that it was measured, or by what computed.
std::string source_of(const std::vector<SampledCurve>& curves) {
  return curves.size() == 1 ? curves.front().name : fmt::format("mean of {}", curves.size());
}

Table table_of(const Pair& force, const std::vector<Pair>& pairs) {
  Table table{.caption = "Side by side",
              .rows = {{"", "computed, at the end", "of [experiment]", "rms difference", "largest difference", "at"}},
              .has_header = true};
  const auto add = [&](const Pair& pair) {
    const ComparedCurves c = compare_curves(pair.computed, pair.measured);
    const auto value = [&](double v) {
      return pair.si_unit == "degree" ? fmt::format("{:.1f}°", v / degree) : shown(v, pair.si_unit);
    };
    table.rows.push_back({pair.caption, value(c.model.back()),
                          fmt::format("{} ({})", value(c.measured.back()), source_of(pair.measured)), value(c.rms),
                          value(c.largest), shown(c.x_of_largest, "m")});
  };
  if (!force.measured.empty()) add(force);
  for (const Pair& pair : pairs) add(pair);
  return table;
}

}  // namespace

std::vector<PageBlock> side_by_side_charts(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                                           const std::vector<ColumnRecord>& records, const Vector& axis) {
  std::vector<PageBlock> charts;
  if (has_angles(experiment, records))
    charts.emplace_back(debonding_chart(measured_surface(experiment, records), axis, rows, experiment.angles));
  for (const Pair& pair : energy_pairs(experiment, rows)) charts.emplace_back(chart_of(pair));
  return charts;
}

std::optional<Table> side_by_side_table(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                                        int component, const std::vector<ColumnRecord>& records, const Vector& axis) {
  std::vector<Pair> pairs = energy_pairs(experiment, rows);
  if (has_angles(experiment, records)) pairs.insert(pairs.begin(), angle_pair(experiment, rows, records, axis));
  if (pairs.empty()) return std::nullopt;
  const Pair force{.caption = "Force",
                   .si_unit = "N",
                   .computed = computed_curve(rows, component),
                   .measured = specimen_curves(experiment)};
  return experiment.where.in_context([&] { return table_of(force, pairs); });
}

}  // namespace pfdm
