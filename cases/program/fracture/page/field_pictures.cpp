#include "cases/program/fracture/page/field_pictures.h"

#include "cases/program/session/report_parts.h"
#include "postproc/files/csv_table.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pfdm {
namespace {

/// The places of one frame.
struct ShownFrame {
  std::vector<double> x, y;                             // [m]
  std::string component{};                              // "x", "y" or "z"
  std::vector<double> measured{}, model{}, residual{};  // [m]
};

std::vector<double> of_frame(const CsvTable& table, const std::string& column, double frame) {
  const std::vector<double>&frames = table.column("frame"), &values = table.column(column);
  std::vector<double> found;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (frames[i] == frame) found.push_back(values[i]);
  return found;
}

double range_of(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return most - least;
}

ShownFrame shown_frame(const CsvTable& table, double frame) {
  ShownFrame shown{.x = of_frame(table, "x_m", frame), .y = of_frame(table, "y_m", frame)};
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string column = fmt::format("measured_{}_m", axis);
    if (std::ranges::count(table.names, column) == 0) continue;
    std::vector<double> measured = of_frame(table, column, frame);
    if (!shown.component.empty() && range_of(measured) <= range_of(shown.measured)) continue;
    shown.component = axis;
    shown.measured = std::move(measured);
  }
  shown.model = of_frame(table, fmt::format("model_{}_m", shown.component), frame);
  shown.residual = of_frame(table, fmt::format("residual_{}_m", shown.component), frame);
  return shown;
}

Picture picture_of(const ShownFrame& frame, const std::vector<double>& values, const std::vector<double>& scale,
                   double pitch, std::string caption) {
  const DisplayUnit length = common_unit({{frame.x, frame.y}}, "m"), unit = common_unit({{scale}}, "m");
  Picture picture{.caption = std::move(caption),
                  .x_title = fmt::format("x [{}]", length.name),
                  .y_title = fmt::format("y [{}]", length.name),
                  .value_title = fmt::format("displacement along {} [{}]", frame.component, unit.name),
                  .least = unit.factor * std::ranges::min(scale),
                  .most = unit.factor * std::ranges::max(scale),
                  .cells = {},
                  .lines = {}};
  if (!(picture.most > picture.least)) picture.most = picture.least + 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Picture::Cell& cell = picture.cells.emplace_back(Picture::Cell{.corners = {}, .value = unit.factor * values[i]});
    for (const auto& [a, b] : {std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.5, 0.5), std::pair(-0.5, 0.5)})
      cell.corners.emplace_back(length.factor * (frame.x[i] + a * pitch), length.factor * (frame.y[i] + b * pitch));
  }
  return picture;
}

Table frames_table(const FittedField& field) {
  Table table{.caption = fmt::format("Field \"{}\": {} data, standard deviation of a point {}", field.name,
                                     field.n_data, shown(field.deviation, "m")),
              .rows = {{"frame", "displacement", "places", "rms measured", "rms difference"}},
              .has_header = true};
  for (const FittedField::Frame& f : field.frames)
    table.rows.push_back({f.name, shown(f.displacement, "m"), fmt::format("{}", f.places), shown(f.rms_measured, "m"),
                          shown(f.rms, "m")});
  return table;
}

}  // namespace

std::vector<PageRow> field_rows(const FitReport& fit, const std::filesystem::path& results) {
  std::vector<PageRow> rows;
  for (const FittedField& field : fit.fields) {
    if (field.frames.empty()) continue;
    const ShownFrame frame = shown_frame(read_csv(results / field.file), static_cast<double>(field.frames.size()));
    const std::string at = shown(field.frames.back().displacement, "m");
    const auto picture = [&](const std::vector<double>& values, const std::vector<double>& scale, const char* what) {
      return picture_of(frame, values, scale, field.pitch, fmt::format("Field \"{}\" at {}: {}", field.name, at, what));
    };
    rows.push_back({.blocks = {picture(frame.measured, frame.measured, "measured"),
                               picture(frame.model, frame.measured, "computed, moved with it")}});
    rows.push_back(
        {.blocks = {picture(frame.residual, frame.residual, "computed less measured"), frames_table(field)}});
  }
  return rows;
}

}  // namespace pfdm
