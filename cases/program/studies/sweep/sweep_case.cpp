#include "cases/program/studies/sweep/sweep_case.h"

#include "cases/program/studies/sweep/sweep_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>

namespace pfdm {
namespace {

/// Values between two ends, evenly spaced or so in their logarithms.
struct Interval {
  double lower = 0.0, upper = 0.0;
  bool logarithmic = false;
  double at(double share) const {
    return logarithmic ? lower * std::pow(upper / lower, share) : lower + share * (upper - lower);
  }
};

Interval read_interval(const ConfigTable& table, const CaseParameter& parameter) {
  const ConfigValue between = table.at("between");
  const std::vector<ConfigValue> ends = between.list(2);
  Interval interval{.lower = read_parameter_value(ends[0], parameter),
                    .upper = read_parameter_value(ends[1], parameter)};
  if (!(interval.lower < interval.upper)) throw between.error("the second value must be the larger");
  interval.logarithmic = table.choice("spacing", "linear") == "logarithmic";
  if (interval.logarithmic && !(interval.lower > 0.0)) throw between.error("logarithmic spacing needs positive values");
  return interval;
}

/// By its key, and by the words of its values where the key takes words.
CaseParameter read_parameter(const ConfigTable& table, const CaseFile& file) {
  const ConfigValue key = table.at("key");
  std::vector<ConfigValue> values;
  if (table.has("values")) values = table.at("values").list();
  if (!takes_words(key, values, file)) return read_case_parameter(key, file);
  if (!table.has("values")) throw key.error("its value is no number: \"values\" has to list what it takes");
  if (values.empty()) throw table.at("values").error("at least one value is required");
  return read_word_parameter(key, values, file);
}

/// Those that are listed, or `count` of them between two ends.
std::vector<double> read_values(const ConfigTable& table, const CaseParameter& parameter) {
  std::vector<double> values(parameter.words.size());
  std::iota(values.begin(), values.end(), 0.0);
  if (!values.empty()) return values;
  if (table.has("values")) {
    for (const ConfigValue& value : table.at("values").list()) values.push_back(read_parameter_value(value, parameter));
    if (values.empty()) throw table.at("values").error("at least one value is required");
    return values;
  }
  if (!table.has("between")) throw table.error("\"values\" is missing, or \"between\" with \"count\"");
  const Interval interval = read_interval(table, parameter);
  const auto n = table.integer("count");
  for (std::int64_t i = 0; i < n; ++i)
    values.push_back(interval.at(static_cast<double>(i) / static_cast<double>(n - 1)));
  return values;
}

using Points = std::vector<std::vector<double>>;

/// All combinations; the last parameter changes fastest.
Points grid(const std::vector<std::vector<double>>& values) {
  Points points{{}};
  for (const std::vector<double>& of_one : values) {
    Points longer;
    for (const std::vector<double>& point : points)
      for (const double value : of_one) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    points = std::move(longer);
  }
  return points;
}

/// The first values together, the second ones together, and so on.
Points side_by_side(const std::vector<std::vector<double>>& values, const ConfigTable& sweep) {
  Points points(values.front().size());
  for (const std::vector<double>& of_one : values) {
    if (of_one.size() != points.size())
      throw sweep.error(fmt::format("a list needs equally many values of each parameter; found {} and {}",
                                    points.size(), of_one.size()));
    for (std::size_t i = 0; i < points.size(); ++i) points[i].push_back(of_one[i]);
  }
  return points;
}

Points samples(const std::vector<ConfigTable>& tables, const std::vector<CaseParameter>& parameters,
               const ConfigTable& sweep) {
  const auto n = static_cast<std::size_t>(sweep.integer("samples"));
  const auto seed = static_cast<std::uint64_t>(sweep.integer("seed", std::int64_t{1}));
  Points points = latin_hypercube(n, parameters.size(), seed);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    if (!parameters[j].words.empty())
      throw tables[j].error(
          fmt::format("\"{}\" takes words: the method has to be \"grid\" or \"list\"", parameters[j].name));
    const Interval interval = read_interval(tables[j], parameters[j]);
    for (std::vector<double>& point : points) point[j] = interval.at(point[j]);
  }
  return points;
}

}  // namespace

std::vector<CaseVariant> variants_of(const SweepSettings& settings, const CaseFile& file) {
  if (settings.is_of_changes) return changed_cases(file);
  std::vector<CaseVariant> variants;
  for (const std::vector<double>& point : settings.points)
    variants.push_back({with_values(file, settings.parameters, point), shown(settings.parameters, point)});
  return variants;
}

std::vector<std::vector<double>> latin_hypercube(std::size_t n, std::size_t n_dimensions, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Points points(n, std::vector<double>(n_dimensions));
  std::vector<std::size_t> order(n);
  for (std::size_t j = 0; j < n_dimensions; ++j) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), engine);
    for (std::size_t i = 0; i < n; ++i)
      points[i][j] = (static_cast<double>(order[i]) + uniform(engine)) / static_cast<double>(n);
  }
  return points;
}

std::optional<SweepSettings> read_sweep(const CaseFile& file) {
  const ConfigTable root = file.config.root();
  if (!root.has("sweep")) return std::nullopt;
  const ConfigTable sweep = root.table("sweep");
  const std::string method = sweep.choice("method");
  if (method == "changes") return read_changes(sweep);
  if (sweep.has("changes")) throw sweep.at("changes").error("this needs method = \"changes\"");
  SweepSettings settings;
  const std::vector<ConfigTable> tables = sweep.tables("parameters");
  for (const ConfigTable& table : tables) {
    settings.parameters.push_back(read_parameter(table, file));
    require_named_once(table.at("key"), settings.parameters);
  }
  if (sweep.has("slurm")) settings.slurm = read_slurm(sweep.table("slurm"));
  if (tables.empty()) throw sweep.error("at least one [[sweep.parameters]] is required");
  if (method == "latin_hypercube") {
    settings.points = samples(tables, settings.parameters, sweep);
    return settings;
  }
  std::vector<std::vector<double>> values;
  for (std::size_t j = 0; j < tables.size(); ++j) values.push_back(read_values(tables[j], settings.parameters[j]));
  settings.points = method == "grid" ? grid(values) : side_by_side(values, sweep);
  return settings;
}

}  // namespace pfdm
