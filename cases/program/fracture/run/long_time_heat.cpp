#include "cases/program/fracture/run/long_time_heat.h"

#include "cases/program/fracture/outcome/heat_results.h"
#include "physics/quantity_text.h"
#include "postproc/fields/vtu_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

void warn_of_cycles(RunningCase& c) {
  const HeatModel& model = *c.program.fracture.heat;
  const double end = c.program.fracture.loading.end;
  if (!(model.cycle > 0.0) || !c.run.is_complete(c.state)) return;
  if (follows_long_time(model)) {
    if (c.state.heat.elapsed < model.time)
      c.session.log.warn(fmt::format(
          "the load ended when {:.3g} s of the {:g} s of heat.time had gone by: go through more cycles (loading.end = "
          "{:g}), or let a cycle stand for a greater change (heat.changes_within)",
          c.state.heat.elapsed, model.time, std::ceil(2.0 * end * model.time / c.state.heat.elapsed)));
  } else if (c.state.heat.cycle_change > model.repeats_within) {
    c.session.log.warn(
        fmt::format("the heat of the last cycle of load differs by {:.2g} % from that of the one before, more than "
                    "heat.repeats_within: go through more cycles (loading.end = {:g})",
                    100.0 * c.state.heat.cycle_change, end + 4.0 * model.cycle));
  }
}

void write_rows(const RunningCase& c, const std::vector<HeatRow>& rows) {
  StepTable table(c.results.folder() / heat_over_time_file, with_heat_figures({"step", "time_s"}), std::nullopt);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<double> row{static_cast<double>(i), rows[i].time};
    add_heat_figures(rows[i].figures, rows[i].account, row);
    table.append(std::move(row), false);
  }
  table.write();
}

void write_field(const RunningCase& c, const CellField<double>& rise, double cycle_time, double time) {
  CellField<double> heating = c.state.heat.cycle;
  for (Index i = 0; i < heating.size(); ++i) heating[i] /= c.mesh.cell_volume[i] * cycle_time;
  VtuWriter(c.mesh, {.time_unit = "s"})
      .write(c.results.folder() / heated_file,
             {{"temperature_rise", &rise, Precision::double_precision, "K"},
              {"heating", &heating, Precision::double_precision, "W/m^3"},
              {"material", &c.mesh.region}},
             time);
}

double cycle_time(const RunningCase& c) { return c.program.fracture.heat->cycle * c.state.heat.duration; }

double power_of_cycle(const RunningCase& c) {
  return std::accumulate(c.state.heat.cycle.begin(), c.state.heat.cycle.end(), 0.0) / cycle_time(c);
}

std::string where_and_how_much(const HeatFigures& at, const HeatBalance& account) {
  return fmt::format(
      "by at most {:.4g} K, at {}, and by {:.4g} K in the mean{}", at.greatest, point_text(at.place), at.mean,
      account.made > 0.0 ? fmt::format("; {:.3g} % of the heat has left it", 100.0 * account.lost / account.made) : "");
}

// The heat of now is that of the last cycle of load, which has warmed the body all along.
std::map<std::string, double> of_long_time_that_was_followed(RunningCase& c) {
  const double power = power_of_cycle(c);
  const HeatReport last = *c.run.report_of(c.state).heat;
  if (!c.session.figures_only) write_field(c, c.state.heat.rise, cycle_time(c), last.elapsed);
  c.session.log.say(fmt::format("heat: in {:g} s the body has become warmer {}; the last cycle makes {:.4g} W ({}, {})",
                                last.elapsed, where_and_how_much(last.figures, last.account), power, heat_file,
                                heated_file));
  return {{"heating_of_cycles_W", power}};
}

}  // namespace

std::map<std::string, double> heat_at_the_end(RunningCase& c) {
  warn_of_cycles(c);
  const HeatModel& heat = *c.program.fracture.heat;
  if (!(heat.time > 0.0) || c.state.heat.cycle.size() == 0 || !c.run.is_complete(c.state)) return {};
  if (follows_long_time(heat)) return of_long_time_that_was_followed(c);
  CellField<double> rise;
  const std::vector<HeatRow> rows = c.run.warm_by_cycles(c.state, heat.time, heat.time_steps, rise);
  const HeatRow& end = rows.back();
  const double power = power_of_cycle(c);
  write_rows(c, rows);
  if (!c.session.figures_only) write_field(c, rise, cycle_time(c), heat.time);
  c.session.log.say(fmt::format("heat: {:.4g} W, the mean of the last cycle, warm the body in {:g} s {} ({}, {})",
                                power, heat.time, where_and_how_much(end.figures, end.account), heat_over_time_file,
                                heated_file));
  std::vector<double> figures;
  add_heat_figures(end.figures, end.account, figures);
  std::map<std::string, double> result = named_heat_figures("after_time", figures);
  result["heating_of_cycles_W"] = power;
  return result;
}

}  // namespace pfdm
