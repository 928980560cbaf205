#include "cases/program/plate/plate_report.h"

#include "cases/program/session/report_parts.h"
#include "postproc/curves/summary.h"
#include "postproc/fields/field_slice.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(factor * value);
  return result;
}

Chart response_chart(const PlateCase& c, const CsvTable& response, bool phase) {
  Chart chart{.caption = phase ? "Its phase" : "H1: acceleration over the base's",
              .x = {.title = "frequency [Hz]", .from = c.from, .to = c.to},
              .y = {.title = phase ? "phase [degrees]" : "magnitude [-]", .logarithmic = !phase},
              .series = {}};
  for (const ResponsePoint& point : c.points)
    chart.series.push_back({.label = point.name,
                            .x = response.column("frequency_Hz"),
                            .y = scaled(response.column(point.name + (phase ? "_H1_phase_rad" : "_H1_magnitude")),
                                        phase ? 180.0 / std::numbers::pi : 1.0),
                            .colour = static_cast<int>(chart.series.size())});
  return chart;
}

Chart temperature_chart(const CsvTable& heating) {
  const std::vector<double> minutes = scaled(heating.column("time_s"), 1.0 / 60.0);
  return {.caption = "Surface temperature",
          .x = {.title = "time [min]", .from = 0.0},
          .y = {.title = "rise [K]", .from = 0.0},
          .series = {{.label = "mean", .x = minutes, .y = heating.column("surface_mean_rise_K"), .colour = 0},
                     {.label = "largest", .x = minutes, .y = heating.column("surface_largest_rise_K"), .colour = 1}}};
}

Chart energy_chart(const CsvTable& heating) {
  const std::vector<double> minutes = scaled(heating.column("time_s"), 1.0 / 60.0);
  const std::vector<std::vector<double>> columns{heating.column("mechanical_work_J"), heating.column("heat_stored_J"),
                                                 heating.column("heat_lost_J")};
  const std::string_view names[] = {"mechanical work", "heat stored", "heat lost"};
  const DisplayUnit unit = common_unit(columns, "J");
  Chart chart{.caption = "Energy",
              .x = {.title = "time [min]", .from = 0.0},
              .y = {.title = fmt::format("energy [{}]", unit.name), .from = 0.0},
              .series = {}};
  add_series(chart, minutes, columns, names, unit);
  return chart;
}

Table modes_table(const CsvTable& modes, const Vector& direction) {
  Table table{
      .caption = "Resonances", .rows = {{"mode", "frequency", "damping", "effective mass"}}, .has_header = true};
  Index axis = 0;
  direction.maxCoeff(&axis);
  const auto &f = modes.column("frequency_Hz"), &damping = modes.column("damping_ratio"),
             &mass = modes.column(fmt::format("effective_mass_{}", "xyz"[axis]));
  for (std::size_t k = 0; k < f.size(); ++k)
    table.rows.push_back({std::to_string(k + 1), shown(f[k], "Hz"), fmt::format("{:.2f} %", 100.0 * damping[k]),
                          fmt::format("{:.1f} %", 100.0 * mass[k])});
  return table;
}

Table figures_table(const ReadSummary& summary) {
  Table table{.caption = "Figures", .rows = {}};
  const auto add = [&](const char* what, const char* name, const char* unit) {
    if (const double value = summary.number(name); std::isfinite(value))
      table.rows.push_back({what, shown(value, unit)});
  };
  add("driven at", "driving_frequency_Hz", "Hz");
  add("mechanical power", "mechanical_power_W", "W");
  add("mean rise of the surface", "surface_mean_rise_K", "K");
  add("largest rise of the surface", "surface_largest_rise_K", "K");
  add("largest rise within", "largest_rise_K", "K");
  add("first resonance at the start", "first_resonance_Hz", "Hz");
  add("at the end", "first_resonance_at_end_Hz", "Hz");
  add("mechanical work", "mechanical_work_J", "J");
  add("heat stored", "heat_stored_J", "J");
  add("heat lost", "heat_lost_J", "J");
  return table;
}

/// The layer of cells below the seen surface, from above.
Picture picture_of(const StoredFrame& frame, const char* field, const std::string& caption, const std::string& title,
                   double factor = 1.0) {
  const Vector lower = frame.lower(), upper = frame.upper(), size = upper - lower;
  Index thin = 0;
  size.minCoeff(&thin);
  const Index across = thin == 0 ? 1 : 0, up = thin == 2 ? 1 : 2;
  Vector point = 0.5 * (lower + upper);
  point[thin] = upper[thin] - 1e-3 * size[thin];
  const FieldSlice slice = frame.slice(point, Vector::Unit(thin), field);
  const DisplayUnit unit = display_unit(size.maxCoeff(), "m");
  Picture picture{.caption = caption,
                  .x_title = fmt::format("{} [{}]", "xyz"[across], unit.name),
                  .y_title = fmt::format("{} [{}]", "xyz"[up], unit.name),
                  .value_title = title,
                  .least = 0.0,
                  .most = 0.0,
                  .cells = {},
                  .lines = {}};
  for (const FieldSlice::Cell& cell : slice.cells) {
    picture.cells.push_back({.corners = {}, .value = factor * cell.value});
    for (const Vector& corner : cell.corners)
      picture.cells.back().corners.emplace_back(unit.factor * corner[across], unit.factor * corner[up]);
    picture.least = std::min(picture.least, factor * cell.value);
    picture.most = std::max(picture.most, factor * cell.value);
  }
  if (!(picture.most > picture.least)) picture.most = picture.least + 1.0;
  return picture;
}

}  // namespace

ReportPage plate_page(const PlateProgram& program, const Session& session) {
  const fs::path& results = session.results;
  const auto summary =
      find_of_case(results / summary_file, program.hash, [](const fs::path& file) { return *read_summary(file); });
  if (!summary) throw InputError(fmt::format("{}: there are no results; run the case first", results.string()));
  const PlateCase& c = program.parsed;
  const CsvTable response = read_csv(results / response_file, {.has_gaps = true});
  ReportPage page{.title = fmt::format("{}: {}", program.name, c.title),
                  .subtitle = fmt::format("pfdm {}, case {}", session.version, program.hash),
                  .rows = {}};
  page.rows.push_back({.blocks = {modes_table(read_csv(results / modes_file), c.direction), figures_table(*summary)}});
  page.rows.push_back({.blocks = {response_chart(c, response, false), response_chart(c, response, true)}});
  if (c.heating) {
    const CsvTable heating = read_csv(results / temperature_file);
    page.rows.push_back({.blocks = {temperature_chart(heating), energy_chart(heating)}});
  }
  const std::vector<Frame> frames = read_pvd(results / "fields.pvd");
  if (!frames.empty()) {
    const StoredFrame frame(results / frames.back().file);
    PageRow pictures{.blocks = {}, .height = 1.4};
    if (c.heating)
      pictures.blocks.emplace_back(
          picture_of(frame, "temperature_rise", "Temperature below the surface at the end", "rise [K]"));
    pictures.blocks.emplace_back(picture_of(frame, "heat_source", "Heat source there", "heat source [kW/m^3]", 1e-3));
    page.rows.push_back(std::move(pictures));
  }
  for (PageRow& row : warnings_row(results / "run.log")) page.rows.push_back(std::move(row));
  return page;
}

}  // namespace pfdm
