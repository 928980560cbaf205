#include "cases/program/fracture/run/long_time_heat.h"

#include "cases/program/fracture/outcome/heat_results.h"
#include "physics/quantity_text.h"
#include "postproc/fields/vtu_writer.h"

#include <fmt/format.h>

#include <numeric>

namespace pfdm {
namespace {

void warn_of_cycles(RunningCase& c) {
  const HeatModel& model = c.program.fracture.heat->model;
  if (!(model.cycle > 0.0) || c.state.heat.cycle_change <= model.repeats_within || !c.run.is_complete(c.state)) return;
  c.session.log.warn(
      fmt::format("the heat of the last cycle of load differs by {:.2g} % from that of the one before, more than "
                  "heat.repeats_within: go through more cycles (loading.end = {:g})",
                  100.0 * c.state.heat.cycle_change, c.program.fracture.loading.end + 4.0 * model.cycle));
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

}  // namespace

std::map<std::string, double> heat_at_the_end(RunningCase& c) {
  warn_of_cycles(c);
  const HeatSettings& heat = *c.program.fracture.heat;
  if (!(heat.time > 0.0) || c.state.heat.cycle.size() == 0 || !c.run.is_complete(c.state)) return {};
  CellField<double> rise;
  const std::vector<HeatRow> rows = c.run.warm_by_cycles(c.state, heat.time, heat.time_steps, rise);
  const HeatRow& end = rows.back();
  const double cycle_time = heat.model.cycle * c.state.heat.duration;
  const double power = std::accumulate(c.state.heat.cycle.begin(), c.state.heat.cycle.end(), 0.0) / cycle_time;
  write_rows(c, rows);
  if (!c.session.figures_only) write_field(c, rise, cycle_time, heat.time);
  c.session.log.say(
      fmt::format("heat: {:.4g} W, the mean of the last cycle, warm the body in {:g} s by at most {:.4g} K, at {}, and "
                  "by {:.4g} K in the mean{} ({}, {})",
                  power, heat.time, end.figures.greatest, point_text(end.figures.place), end.figures.mean,
                  end.account.made > 0.0
                      ? fmt::format("; {:.3g} % of the heat has left it", 100.0 * end.account.lost / end.account.made)
                      : "",
                  heat_over_time_file, heated_file));
  std::vector<double> figures;
  add_heat_figures(end.figures, end.account, figures);
  std::map<std::string, double> result = named_heat_figures("after_time", figures);
  result["heating_of_cycles_W"] = power;
  return result;
}

}  // namespace pfdm
