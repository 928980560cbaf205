#include "cases/program/plate/plate_report.h"

#include "cases/program/fracture/page/fit_on_page.h"
#include "cases/program/plate/plate_fit.h"
#include "cases/program/session/report_parts.h"
#include "postproc/curves/summary.h"
#include "postproc/fields/field_slice.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
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

/// Without jumps by a turn.
std::vector<double> unwrapped(std::vector<double> phase) {
  for (std::size_t i = 1; i < phase.size(); ++i)
    phase[i] = phase[i - 1] + std::remainder(phase[i] - phase[i - 1], 2.0 * std::numbers::pi);
  return phase;
}

Chart response_chart(const PlateCase& c, const CsvTable& response, bool phase) {
  Chart chart{.caption = phase ? "Its phase" : "H1: acceleration over the base's",
              .x = {.title = "frequency [Hz]", .from = c.from, .to = c.to},
              .y = {.title = phase ? "phase [degrees]" : "magnitude [-]", .logarithmic = !phase},
              .series = {}};
  for (const ResponsePoint& point : c.points) {
    std::vector<double> values = response.column(point.name + (phase ? "_H1_phase_rad" : "_H1_magnitude"));
    if (phase) values = scaled(unwrapped(std::move(values)), 180.0 / std::numbers::pi);
    chart.series.push_back({.label = point.name,
                            .x = response.column("frequency_Hz"),
                            .y = std::move(values),
                            .colour = static_cast<int>(chart.series.size())});
  }
  return chart;
}

Chart temperature_chart(const CsvTable& heating) {
  const std::vector<double> minutes = scaled(heating.column("time_s"), 1.0 / 60.0);
  return {
      .caption = "Surface temperature",
      .x = {.title = "time [min]", .from = 0.0},
      .y = {.title = "rise [K]", .from = 0.0},
      .series = {
          {.label = "mean", .x = minutes, .y = heating.column("surface_mean_rise_K"), .colour = 0, .of_steps = true},
          {.label = "largest",
           .x = minutes,
           .y = heating.column("surface_largest_rise_K"),
           .colour = 1,
           .of_steps = true}}};
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

std::string supports_text(const PlateCase& c) {
  std::vector<std::string> texts;
  for (const BoundaryCondition& on : c.supports) {
    const bool is_symmetry = on.kind == BoundaryCondition::Kind::symmetry;
    const auto n_held = std::ranges::count(on.displacement_prescribed, true);
    texts.push_back(fmt::format("{} {}", on.patch, is_symmetry ? "symmetry" : n_held == 3 ? "clamped" : "pinned"));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string base_text(const PlateCase& c) {
  Index axis = 0;
  c.direction.maxCoeff(&axis);
  constexpr double g0 = 9.80665;
  const PlateExcitation& base = c.excitation;
  if (base.type == "random")
    return fmt::format("random, {:.3g} g0^2/Hz, along {}", base.level / (g0 * g0), "xyz"[axis]);
  return fmt::format("{}, {:.3g} g0 along {}", base.type, base.level / g0, "xyz"[axis]);
}

/// Patches of one coefficient together.
std::string cooling_text(const PlateCase& c) {
  std::map<std::string, std::vector<std::string>> patches;
  for (const DiffusionBoundary& on : c.heating->boundary)
    patches[on.kind == DiffusionBoundary::Kind::value ? fmt::format("at +{:.3g} K", on.value)
                                                      : fmt::format("{:.3g} W/m^2K", on.coefficient)]
        .push_back(on.patch);
  std::vector<std::string> texts;
  texts.reserve(patches.size());
  for (const auto& [how, where] : patches) texts.push_back(fmt::format("{}: {}", how, fmt::join(where, ", ")));
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, "; "));
}

std::string points_text(const PlateCase& c) {
  std::vector<std::string> texts;
  texts.reserve(c.points.size());
  for (const ResponsePoint& point : c.points)
    texts.push_back(fmt::format("{} ({:.4g}, {:.4g}, {:.4g}) mm", point.name, 1e3 * point.at.x(), 1e3 * point.at.y(),
                                1e3 * point.at.z()));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// What was computed.
Table set_up_table(const PlateCase& c, const ReadSummary& summary) {
  const PlateMaterial& m = c.material;
  Table table{.caption = "Set-up", .rows = {}};
  table.rows.push_back(
      {"body", fmt::format("{:.4g} kg, {} cells", summary.number("mass_kg"), summary.number("cells"))});
  table.rows.push_back(
      {"material",
       m.modulus.size() == 1
           ? fmt::format("E {}, loss factor {:.3g}, nu {:.3g}, {:.4g} kg/m^3", shown(m.young_modulus(), "Pa"),
                         m.modulus.front().loss_factor, m.poisson_ratio, m.density)
           : fmt::format("modulus over frequency, nu {:.3g}, {:.4g} kg/m^3", m.poisson_ratio, m.density)});
  table.rows.push_back({"supports", supports_text(c) + "; other edges free"});
  table.rows.push_back({"motion of the base", base_text(c)});
  table.rows.push_back({"points", points_text(c)});
  if (!c.heating) return table;
  table.rows.push_back(
      {"conduction", fmt::format("{:.3g} W/m/K, {:.4g} J/kg/K", m.heat.conductivity, m.heat.capacity / m.density)});
  table.rows.push_back({"cooling", cooling_text(c)});
  table.rows.push_back(
      {"surroundings, duration",
       fmt::format("{:.4g} degC, {:.4g} min", c.heating->surroundings - 273.15, c.heating->duration / 60.0)});
  return table;
}

/// Of the response at the frequency nearest to the driven one.
void add_motion(const PlateCase& c, const CsvTable& response, double driven, Table& table) {
  const std::vector<double>& f = response.column("frequency_Hz");
  const auto nearest = std::ranges::min_element(f, {}, [&](double at) { return std::abs(at - driven); }) - f.begin();
  for (const ResponsePoint& point : c.points) {
    const double H1 = response.column(point.name + "_H1_magnitude")[nearest];
    table.rows.push_back({fmt::format("acceleration there, {}", point.name),
                          fmt::format("{:.2f} g0 (H1 {:.2f})", H1 * c.excitation.level / 9.80665, H1)});
  }
}

Table figures_table(const PlateCase& c, const ReadSummary& summary, const CsvTable& response) {
  Table table{.caption = "Figures", .rows = {}};
  constexpr std::string_view kelvin = "K";  // people write no mK
  const auto add = [&](const char* what, const char* name, std::string_view unit) {
    if (const double value = summary.number(name); std::isfinite(value))
      table.rows.push_back({what, unit == kelvin ? fmt::format("{:.4g} K", value) : shown(value, unit)});
  };
  add("driven at", "driving_frequency_Hz", "Hz");
  if (const double driven = summary.number("driving_frequency_Hz"); std::isfinite(driven))
    add_motion(c, response, driven, table);
  add("mechanical power", "mechanical_power_W", "W");
  add("surface warmer at the end, mean", "surface_mean_rise_K", "K");
  add("surface warmer at the end, at most", "surface_largest_rise_K", "K");
  add("warmest within the body", "largest_rise_K", "K");
  if (c.material.depends_on_temperature()) add("first resonance at the end", "first_resonance_at_end_Hz", "Hz");
  add("mechanical work", "mechanical_work_J", "J");
  add("of it stored as heat", "heat_stored_J", "J");
  add("of it lost to the surroundings", "heat_lost_J", "J");
  if (const double error = summary.number("heat_balance_error"); std::isfinite(error))
    table.rows.push_back({"not accounted for, of the work", fmt::format("{:.1e}", error)});
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

/// A measured curve with the first guess and the estimates.
Chart fit_chart(const ExperimentMisfit& experiment, const CsvTable& curves) {
  const bool is_rise = experiment.absolute.has_value();
  const std::string quantity = is_rise ? "rise_K" : "magnitude";
  const std::vector<double> x = is_rise ? scaled(curves.column("time_s"), 1.0 / 60.0) : curves.column("frequency_Hz");
  return {.caption = fmt::format("Fit to \"{}\", rms misfit {:.2g} %", experiment.name, 100.0 * experiment.relative),
          .x = {.title = is_rise ? "time [min]" : "frequency [Hz]"},
          .y = {.title = is_rise ? "rise of the surface [K]" : "H1 [-]", .logarithmic = !is_rise},
          .series = {{.label = "measured",
                      .x = x,
                      .y = curves.column("measured_" + quantity),
                      .style = SeriesStyle::points,
                      .colour = 7},
                     {.label = "first guess",
                      .x = x,
                      .y = curves.column("first_" + quantity),
                      .style = SeriesStyle::dashed,
                      .colour = 1},
                     {.label = "fitted", .x = x, .y = curves.column("model_" + quantity), .colour = 0}}};
}

std::vector<PageRow> fit_rows(const FitReport& fit, const fs::path& results) {
  std::vector<PageRow> rows{{.blocks = {estimates_table(fit)}}};
  std::vector<PageBlock> charts;
  for (const ExperimentMisfit& experiment : fit.experiments)
    charts.emplace_back(fit_chart(experiment, read_csv(results / experiment.curve)));
  for (PageRow& row : in_pairs(std::move(charts))) rows.push_back(std::move(row));
  return rows;
}

std::vector<PageRow> run_rows(const PlateCase& c, const ReadSummary& summary, const fs::path& results) {
  std::vector<PageRow> rows;
  const CsvTable response = read_csv(results / response_file, {.has_gaps = true});
  rows.push_back({.blocks = {set_up_table(c, summary)}});
  rows.push_back(
      {.blocks = {modes_table(read_csv(results / modes_file), c.direction), figures_table(c, summary, response)}});
  rows.push_back({.blocks = {response_chart(c, response, false), response_chart(c, response, true)}});
  if (c.heating) {
    const CsvTable heating = read_csv(results / temperature_file);
    rows.push_back({.blocks = {temperature_chart(heating), energy_chart(heating)}});
  }
  const std::vector<Frame> frames = read_pvd(results / "fields.pvd");
  if (frames.empty()) return rows;
  const StoredFrame frame(results / frames.back().file);
  PageRow pictures{.blocks = {}, .height = 1.4};
  if (c.heating)
    pictures.blocks.emplace_back(
        picture_of(frame, "temperature_rise", "Temperature below the surface at the end", "rise [K]"));
  pictures.blocks.emplace_back(picture_of(frame, "heat_source", "Heat source there", "heat source [kW/m^3]", 1e-3));
  if (c.excitation.type == "harmonic")
    pictures.blocks.emplace_back(
        picture_of(frame, "deflection", "Deflection over the base, at its largest", "deflection [mm]", 1e3));
  rows.push_back(std::move(pictures));
  return rows;
}

}  // namespace

ReportPage plate_page(const PlateProgram& program, const Session& session) {
  const fs::path& results = session.results;
  const auto summary =
      find_of_case(results / summary_file, program.hash, [](const fs::path& file) { return *read_summary(file); });
  const auto fit = find_of_case(results / fit_file, program.hash, read_fit_json);
  if (!summary && !fit) throw InputError(fmt::format("{}: there are no results; run the case first", results.string()));
  ReportPage page{.title = fmt::format("{}: {}", program.name, program.parsed.title),
                  .subtitle = fmt::format("pfdm {}, case {}", session.version, program.hash),
                  .rows = {}};
  if (summary) page.rows = run_rows(program.parsed, *summary, results);
  if (fit)
    for (PageRow& row : fit_rows(*fit, results)) page.rows.push_back(std::move(row));
  for (PageRow& row : warnings_row(results / "run.log")) page.rows.push_back(std::move(row));
  return page;
}

}  // namespace pfdm
