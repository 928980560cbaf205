#include "cases/program/plate/plate_fit_case.h"

#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/csv_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

// Values with which the body's stiffness has a factor at most. Its mesh, density and Poisson's ratio stay.
void require_same_body(const ConfigTable& fit, const std::vector<CurveFitParameter>& parameters) {
  const auto may_change = [](const std::string& key) {
    if (key == "material.density" || key == "material.poisson_ratio") return false;
    return std::ranges::any_of(std::array{"material.", "heating.", "cooling[", "base."},
                               [&](const char* table) { return key.starts_with(table); });
  };
  const std::vector<ConfigTable> tables = fit.tables("parameters");
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (const std::string& key : parameters[j].in_case.keys)
      if (!may_change(key))
        throw tables[j].at("key").error(
            fmt::format("\"{}\" cannot be estimated: only values of [material] but density and Poisson's ratio, of "
                        "[[cooling]], [heating] and [base]",
                        key));
}

std::vector<double> read_values(const ConfigTable& table, const CsvTable& file, std::string_view key,
                                const Dimension& due) {
  return read_column(table.table(key), file, "column", "unit", due);
}

void require_positive(const ConfigValue& where, const std::vector<double>& values) {
  const auto bad = std::ranges::find_if(values, [](double value) { return !(value > 0.0); });
  if (bad != values.end())
    throw where.error(fmt::format("row {} is {:g}; all have to be positive", bad - values.begin() + 1, *bad));
}

MeasuredResponse read_response(const ConfigTable& table, const PlateCase& c, const std::filesystem::path& directory) {
  MeasuredResponse response{.name = read_plain_name(table.at("name"), "a curve"),
                            .frequency = {},
                            .magnitude = {},
                            .phase = {},
                            .deviation = table.number("deviation")};
  std::vector<std::string> names;
  for (const ResponsePoint& point : c.points) names.push_back(point.name);
  const std::string& point = table.at("point").one_of(names, "name of [[response.points]]");
  response.at = std::ranges::find(c.points, point, &ResponsePoint::name)->at;
  const CsvTable file = read_csv_of(table, directory);
  response.frequency = read_values(table, file, "frequency", dimension::frequency);
  response.magnitude = read_values(table, file, "magnitude", dimension::number);
  std::vector<std::vector<double>*> used{&response.frequency, &response.magnitude};
  if (table.has("phase")) {
    response.phase = read_values(table, file, "phase", dimension::angle);
    used.push_back(&response.phase);
  }
  leave_out_gaps(table, used);
  require_positive(table.at("frequency"), response.frequency);
  require_positive(table.at("magnitude"), response.magnitude);
  return response;
}

MeasuredRise read_rise(const ConfigTable& table, const PlateCase& c, const std::filesystem::path& directory) {
  if (!c.heating) throw table.error("temperatures are measured, and the case has no [heating]");
  MeasuredRise rise{.name = read_plain_name(table.at("name"), "a curve"),
                    .is_largest = table.choice("of") == "largest",
                    .time = {},
                    .rise = {},
                    .deviation = table.quantity("deviation")};
  const CsvTable file = read_csv_of(table, directory);
  rise.time = read_values(table, file, "time", dimension::time);
  rise.rise = read_values(table, file, "rise", dimension::temperature);
  leave_out_gaps(table, std::array{&rise.time, &rise.rise});
  if (!std::ranges::is_sorted(rise.time)) throw table.at("time").error("the times do not rise");
  if (rise.time.front() < 0.0 || rise.time.back() > c.heating->duration * (1.0 + 1e-9))
    throw table.at("time").error(fmt::format("the times are from {:g} to {:g} s; [heating] lasts {:g} s",
                                             rise.time.front(), rise.time.back(), c.heating->duration));
  return rise;
}

}  // namespace

std::optional<PlateFit> read_plate_fit(const CaseFile& file, const PlateCase& c) {
  const ConfigTable root = file.config.root();
  if (!root.has("fit")) return std::nullopt;
  const ConfigTable table = root.table("fit");
  PlateFit fit{.parameters = read_fit_parameters(table, file),
               .responses = {},
               .rises = {},
               .starts = static_cast<int>(table.integer("starts", std::int64_t{1})),
               .where = table};
  require_same_body(table, fit.parameters);
  for (const ConfigTable& response : table.tables("responses"))
    fit.responses.push_back(read_response(response, c, file.directory));
  for (const ConfigTable& rise : table.tables("temperatures")) fit.rises.push_back(read_rise(rise, c, file.directory));
  if (fit.responses.empty() && fit.rises.empty())
    throw table.error("it needs measured curves: [[fit.responses]], [[fit.temperatures]] or both");
  return fit;
}

}  // namespace pfdm
