#include "cases/program/viscoelastic/viscoelastic_tests.h"

#include "cases/program/input/fields/csv_columns.h"
#include "cases/program/studies/fit/material_tests.h"
#include "cases/program/viscoelastic/viscoelastic_keys.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Channel = ViscoelasticExperiment::Channel;

constexpr Range part_range{0.0, 1.0, true, "above 0 and below 1"};

struct ChannelKey {
  const char* key;
  MeasuredQuantity quantity;
};
constexpr std::array dma_channels{ChannelKey{"storage_modulus", MeasuredQuantity::storage_modulus},
                                  ChannelKey{"loss_modulus", MeasuredQuantity::loss_modulus},
                                  ChannelKey{"loss_factor", MeasuredQuantity::loss_factor}};

const Dimension& dimension_of_channel(MeasuredQuantity quantity) {
  return unit_of(quantity) == "Pa" ? dimension::stress : dimension::number;
}

std::vector<double> read_followed_column(const ConfigTable& test, const char* key, const CsvTable& file,
                                         const Dimension& due) {
  return read_column(test.table(key).with_keys(test_column_keys(), "followed"), file, "column", "unit", due);
}

void read_noises(const ConfigTable& column, const Dimension& due, Channel& channel) {
  if (column.has("noise") && column.has("relative_noise"))
    throw column.error("either noise or relative_noise, not both");
  if (const auto part = column.find("relative_noise"))
    channel.relative_noise =
        part->is_string() ? part->quantity(dimension::number, part_range) : part->number(part_range);
  channel.noise = read_noise(column, due);
}

Channel read_measured_column(const ConfigTable& test, const char* key, MeasuredQuantity quantity,
                             const CsvTable& file) {
  const ConfigTable column = test.table(key).with_keys(test_column_keys(), "measured");
  const Dimension& due = dimension_of_channel(quantity);
  Channel channel{.quantity = quantity, .values = read_column(column, file, "column", "unit", due)};
  read_noises(column, due, channel);
  return channel;
}

/// The end of a name after its quantity, "Hz" of f_Hz.
std::string unit_at_end_of(const std::string& name) {
  for (const char* per : {"rad/s", "rad_per_s"})
    if (name.ends_with(per)) return "rad/s";
  const std::size_t at = name.rfind('_');
  const std::string end = at == std::string::npos ? "" : name.substr(at + 1);
  return end.ends_with("Hz") ? end : "";
}

/// rad/s of one unit of the column. UDUNITS takes a radian for 1 and would call Hz and rad/s the same.
double angular_unit(const ConfigTable& column, const CsvTable& file, std::size_t at) {
  const ConfigValue named = column.at("column");
  const std::string of_units = file.units.empty() || file.units[at] == "-" ? "" : file.units[at];
  const std::string in_file = of_units.empty() ? unit_at_end_of(file.names[at]) : of_units;
  const std::string in_case = column.string("unit", "");
  const auto factor = [&](std::string unit, const ConfigValue& said) {
    std::erase(unit, ' ');
    if (unit == "rad/s" || unit == "rads^-1" || unit == "rads-1") return 1.0;
    if (unit.ends_with("Hz") && is_unit_of(unit, dimension::frequency))
      return 2.0 * std::numbers::pi * unit_in_si(unit, dimension::frequency);
    throw said.error(fmt::format("\"{}\" is no unit of a frequency here: \"Hz\", with any prefix, or \"rad/s\"", unit));
  };
  if (in_case.empty() && in_file.empty())
    throw named.error("the file does not say the unit of the frequency: unit = \"Hz\" or unit = \"rad/s\"");
  if (in_case.empty()) return factor(in_file, named);
  const double said = factor(in_case, column.at("unit"));
  if (!in_file.empty() && std::abs(factor(in_file, named) / said - 1.0) > 1e-9)
    throw column.at("unit").error(
        fmt::format("the file itself says that the unit of \"{}\" is \"{}\"", file.names[at], in_file));
  return said;
}

std::vector<double> read_angular_frequencies(const ConfigTable& test, const CsvTable& file) {
  const ConfigTable column = test.table("frequency");
  const ConfigValue name = column.at("column");
  const std::size_t at = find_column(name, file);
  name.in_context([&] { file.require_numbers(at); });
  const double unit = angular_unit(column, file, at);
  std::vector<double> frequencies = file.columns[at];
  for (double& w : frequencies) w *= unit;
  return frequencies;
}

/// In K. Units with another zero are no multiples of it.
std::vector<double> read_temperature_column(const ConfigTable& column, const CsvTable& file) {
  const ConfigValue name = column.at("column");
  const std::size_t at = find_column(name, file);
  name.in_context([&] { file.require_numbers(at); });
  std::string unit = column.string("unit", file.units.empty() || file.units[at] == "-" ? "" : file.units[at]);
  if (unit.empty()) unit = std::string(unit_of_name(file.names[at], dimension::temperature));
  if (unit.empty())
    throw name.error("the file does not say the unit of the temperature: unit = \"degC\" or unit = \"K\"");
  const ConfigValue place = column.has("unit") ? column.at("unit") : name;
  const auto in_kelvin = [&](int value) {
    return place.in_context([&] { return parse_quantity(fmt::format("{} {}", value, unit), dimension::temperature); });
  };
  const double zero = in_kelvin(0), kelvin = in_kelvin(1) - zero;
  std::vector<double> temperatures = file.columns[at];
  for (double& t : temperatures) t = zero + kelvin * t;
  return temperatures;
}

void read_temperatures(const ConfigTable& test, const CsvTable& file, ViscoelasticExperiment& experiment) {
  const auto temperature = test.find("temperature");
  if (!temperature) return;
  if (!temperature->is_table())
    experiment.temperatures = {temperature->quantity()};
  else if (experiment.is_frequency_sweep())
    experiment.temperatures = read_temperature_column(temperature->table(), file);
  else
    throw temperature->error("a test over time has one temperature, as in temperature = \"40 degC\"");
}

void refuse(const ConfigTable& test, std::initializer_list<const char*> keys, std::string_view why) {
  for (const char* key : keys)
    if (test.has(key)) throw test.at(key).error(why);
}

void require_positive(const ConfigTable& test, const std::vector<double>& angular_frequencies,
                      const std::vector<double>& storage) {
  const auto least = std::ranges::min_element(storage);
  if (*least > 0.0) return;
  const double frequency =
      angular_frequencies[static_cast<std::size_t>(least - storage.begin())] / (2.0 * std::numbers::pi);
  throw test.at("storage_modulus")
      .error(fmt::format("a storage modulus must be positive; that at {} is {}: leave out what the instrument did not "
                         "measure, as an empty entry",
                         quantity_text(frequency, "Hz"), quantity_text(*least, "Pa")));
}

void read_dma(const ConfigTable& test, const CsvTable& file, ViscoelasticExperiment& experiment) {
  refuse(test, {"strain", "stress", "controlled", "ramp", "time", "time_unit"},
         "a test with a frequency is DMA: it has no history of strain and stress");
  experiment.angular_frequencies = read_angular_frequencies(test, file);
  for (const ChannelKey& channel : dma_channels)
    if (test.has(channel.key))
      experiment.channels.push_back(read_measured_column(test, channel.key, channel.quantity, file));
  if (experiment.channels.empty())
    throw test.error(
        "DMA needs storage_modulus, loss_modulus or loss_factor, as in storage_modulus = { column = "
        "\"E_MPa\", unit = \"MPa\" }");
  if (experiment.channels.size() == 3)
    throw test.at("loss_factor").error("the loss factor is the ratio of the two moduli: name two of the three");
  read_temperatures(test, file, experiment);
  std::vector<std::vector<double>*> used{&experiment.angular_frequencies};
  for (Channel& channel : experiment.channels) used.push_back(&channel.values);
  if (experiment.temperatures.size() > 1) used.push_back(&experiment.temperatures);
  leave_out_gaps(test, used);
  sort_rows(experiment, experiment.angular_frequencies);  // instruments also sweep down
  if (!(experiment.angular_frequencies.front() > 0.0)) throw test.at("frequency").error("frequencies must be positive");
  for (const Channel& channel : experiment.channels)
    if (channel.quantity == MeasuredQuantity::storage_modulus)
      require_positive(test, experiment.angular_frequencies, channel.values);
}

void read_history(const ConfigTable& test, const CsvTable& file, ViscoelasticExperiment& experiment) {
  refuse(test, {"storage_modulus", "loss_modulus", "loss_factor"},
         "a modulus of DMA needs the column of its frequency, as in frequency = { column = \"f_Hz\" }");
  experiment.follows_stress = test.choice("controlled", "strain") == "stress";
  const bool stress = experiment.follows_stress;
  experiment.ramp = test.quantity("ramp", 0.0);
  experiment.times = read_times(test, file);
  experiment.followed =
      read_followed_column(test, stress ? "stress" : "strain", file, stress ? dimension::stress : dimension::number);
  experiment.channels = {read_measured_column(test, stress ? "strain" : "stress",
                                              stress ? MeasuredQuantity::strain : MeasuredQuantity::stress, file)};
  leave_out_gaps(test, std::array{&experiment.times, &experiment.followed, &experiment.channels[0].values});
  begin_at_zero(test, experiment.times);
  read_temperatures(test, file, experiment);
  const double largest =
      std::abs(*std::ranges::max_element(experiment.followed, {}, [](double v) { return std::abs(v); }));
  if (!(largest > 0.0))
    throw test.table(stress ? "stress" : "strain").error("all values are zero: nothing was done to the material");
  if (experiment.ramp == 0.0 && std::abs(experiment.followed.front()) > 0.1 * largest)
    test.at("csv").remark(
        fmt::format("the {} of its first row counts as a step from rest; if it rose within a time "
                    "before, ramp = \"1 s\" says within which",
                    stress ? "stress" : "strain"));
}

void require_values(const ConfigTable& test, const ViscoelasticExperiment& experiment) {
  for (const Channel& channel : experiment.channels)
    if (std::ranges::all_of(channel.values, [](double value) { return value == 0.0; }))
      throw test.at("csv").error(fmt::format("all values of the {} are zero", name_of(channel.quantity)));
}

/// Of a history: a material does not pull while it is pressed all along.
void require_one_sign(const ConfigTable& test, const ViscoelasticExperiment& experiment) {
  double product = 0.0;
  for (std::size_t i = 0; i < experiment.followed.size(); ++i)
    product += experiment.followed[i] * experiment.channels[0].values[i];
  if (product < 0.0)
    throw test.at("csv").error("stress and strain have opposite signs: change that of one of both columns in the file");
}

}  // namespace

ViscoelasticExperiment read_viscoelastic_test(const ConfigTable& test, const std::filesystem::path& case_directory) {
  const CsvTable file = read_csv_of(test, case_directory);
  ViscoelasticExperiment experiment{.name = test.string("name")};
  experiment.deformation = test.choice("deformation", "tension") == "shear" ? Deformation::shear : Deformation::tension;
  if (test.has("frequency"))
    read_dma(test, file, experiment);
  else
    read_history(test, file, experiment);
  require_values(test, experiment);
  if (!experiment.is_frequency_sweep()) require_one_sign(test, experiment);
  return experiment;
}

}  // namespace pfdm
