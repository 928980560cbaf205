#include "cases/program/fracture/page/debonding_charts.h"

#include "cases/program/fracture/outcome/debonded_poles.h"
#include "cases/program/fracture/outcome/fracture_comparison.h"
#include "cases/program/session/report_parts.h"
#include "physics/angle.h"
#include "postproc/cohesive/cohesive_law.h"
#include "postproc/cohesive/flat_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pfdm {
namespace {

std::vector<double> in_degrees(std::vector<double> angles) {
  for (double& angle : angles) angle /= degree;
  return angles;
}

}  // namespace

Chart debonding_chart(const ColumnRecord& record, const Vector& axis, const std::vector<CurveRow>& curve,
                      std::span<const MeasuredAngle> measured) {
  const std::vector<Debonding> history = debonding_of(record);
  const std::size_t n = std::min(history.size(), curve.size());
  std::vector<double> moved;
  for (std::size_t i = 0; i < n; ++i) moved.push_back(curve[i].displacement);
  const DisplayUnit unit = common_unit({{moved}}, "m");
  Chart chart{.caption = fmt::format("Debonding angle of \"{}\"", record.name),
              .x = {.title = fmt::format("displacement [{}]", unit.name)},
              .y = {.title = "angle [°]", .from = 0.0},
              .series = {}};
  int colour = 1;  // the first is that of the pole that comes first
  for (const MeasuredAngle& one : measured)
    chart.series.push_back(
        {.label = one.curve.name, .x = in_unit(one.curve.x, unit), .y = in_degrees(one.curve.y), .colour = colour++});
  const bool plus_first = measured.empty() || measured.front().at_positive;
  for (const bool plus : {plus_first, !plus_first}) {
    Series series{.label = name_of_pole(plus, axis) + (measured.empty() ? "" : ", computed"),
                  .x = in_unit(moved, unit),
                  .y = {},
                  .colour = plus == plus_first ? 0 : colour,
                  .of_steps = history.size() == curve.size()};
    for (std::size_t i = 0; i < n; ++i)
      series.y.push_back((plus ? history[i].angle_plus : history[i].angle_minus) / degree);
    chart.series.push_back(std::move(series));
  }
  return chart;
}

std::vector<PageBlock> debonding_charts(const FractureCase& fracture,
                                        const std::optional<ExperimentSettings>& experiment,
                                        const std::vector<CurveRow>& curve, const std::vector<ColumnRecord>& records) {
  std::vector<PageBlock> charts;
  const ColumnRecord* const beside =
      experiment && !experiment->angles.empty() && !records.empty() ? &measured_surface(*experiment, records) : nullptr;
  for (const ColumnRecord& record : records)
    if (&record != beside && !is_flat(record.kind, record.places) && record.steps.size() == curve.size())
      charts.emplace_back(debonding_chart(record, fracture.cohesive.axis, curve, {}));
  return charts;
}

}  // namespace pfdm
