#include "cases/program/input/case_files/case_parameter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

enum class Holds { truth, text, other };
Holds held_at(const std::string& key, const CaseFile& file) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  const TomlValue& value = value_at(root, key);
  if (std::holds_alternative<bool>(value.value)) return Holds::truth;
  return std::holds_alternative<std::string>(value.value) ? Holds::text : Holds::other;
}

bool is_truth(const std::string& key, const CaseFile& file) { return held_at(key, file) == Holds::truth; }

/// The one word that may stand where a quantity does.
bool is_word_beside_quantities(const ConfigValue& value) { return value.is_string() && value.string() == "free"; }

std::vector<ConfigValue> keys_of(const ConfigValue& key) {
  std::vector<ConfigValue> keys = key.is_list() ? key.list() : std::vector{key};
  if (keys.empty()) throw key.error("expected a key of the case, as in \"materials.glass.young_modulus\"");
  return keys;
}

/// What is written at the k-th key for a value of the first: a text with its unit, a bare number, or a word.
std::string piece_of_toml(const CaseParameter& parameter, std::size_t k, double value, const CaseFile& file) {
  const std::string& key = parameter.keys[k];
  if (!parameter.words.empty()) {
    const std::string word = parameter.shown(value);
    return is_truth(key, file) ? word : quoted_toml(word);
  }
  const CaseParameter there = case_parameter(key, file);
  const std::string text = there.shown(value * parameter.ratios[k]);
  return there.unit.empty() ? text : quoted_toml(text);
}

}  // namespace

CaseParameter case_parameter(const std::string& key, const CaseFile& file) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  const TomlValue& value = value_at(root, key);
  CaseParameter parameter{.name = key, .keys = {key}, .ratios = {1.0}, .dimension = dimension::number, .unit = {}};
  if (const auto* real = std::get_if<double>(&value.value)) {
    parameter.value = *real;
  } else if (const auto* whole = std::get_if<std::int64_t>(&value.value)) {
    parameter.value = static_cast<double>(*whole);
  } else if (const auto* text = std::get_if<std::string>(&value.value)) {
    parameter.dimension = dimension_of(*text);
    parameter.unit = unit_of(*text);
    parameter.value = parse_quantity(*text, parameter.dimension);
    parameter.zero_in_si = parse_quantity(fmt::format("0 {}", parameter.unit), parameter.dimension);
    parameter.unit_in_si = unit_in_si(parameter.unit, parameter.dimension);
  } else {
    throw InputError(fmt::format("\"{}\" is {}, neither a quantity nor a number", key, shown(value)));
  }
  return parameter;
}

void keep_ratio(CaseParameter& parameter, const CaseParameter& other) {
  if (other.dimension.name != parameter.dimension.name)
    throw InputError(fmt::format("this is {}, \"{}\" is {}; keys that keep a ratio must have the same dimension",
                                 with_article(other.dimension.name), parameter.name,
                                 with_article(parameter.dimension.name)));
  if (parameter.value == 0.0) throw InputError("the value of the first key is zero; no ratio to it can be kept");
  parameter.keys.insert(parameter.keys.end(), other.keys.begin(), other.keys.end());
  for (const double ratio : other.ratios) parameter.ratios.push_back(ratio * other.value / parameter.value);
}

std::string CaseParameter::shown(double si) const {
  if (!words.empty()) return words.at(static_cast<std::size_t>(si));
  const double value_in_file = in_file_units(si);
  return unit.empty() ? fmt::format("{:.8g}", value_in_file) : fmt::format("{:.8g} {}", value_in_file, unit);
}

CaseParameter read_case_parameter(const ConfigValue& key, const CaseFile& file) {
  const std::vector<ConfigValue> keys = keys_of(key);
  CaseParameter result = keys[0].in_context([&] { return case_parameter(keys[0].string(), file); });
  for (std::size_t i = 1; i < keys.size(); ++i)
    keys[i].in_context([&] { keep_ratio(result, case_parameter(keys[i].string(), file)); });
  return result;
}

bool takes_words(const ConfigValue& key, std::span<const ConfigValue> values, const CaseFile& file) {
  const ConfigValue first = keys_of(key).front();
  const Holds held = first.in_context([&] { return held_at(first.string(), file); });
  if (held != Holds::text || std::ranges::any_of(values, is_word_beside_quantities)) return held != Holds::other;
  try {
    case_parameter(first.string(), file);
    return false;
  } catch (const InputError&) {
    return true;
  }
}

CaseParameter read_word_parameter(const ConfigValue& key, std::span<const ConfigValue> values, const CaseFile& file) {
  CaseParameter result{.name = {}, .keys = {}, .ratios = {}, .dimension = dimension::number, .unit = {}};
  for (const ConfigValue& one : keys_of(key)) {
    const Holds held = one.in_context([&] { return held_at(one.string(), file); });
    result.keys.push_back(one.string());
    if (held != Holds::other && held == held_at(result.keys.front(), file)) continue;
    throw one.error(fmt::format("\"{}\" and \"{}\" hold values of different types", one.string(), result.keys.front()));
  }
  result.name = result.keys.front();
  const bool truth = is_truth(result.name, file);
  for (const ConfigValue& value : values)
    result.words.push_back(truth ? fmt::format("{}", value.boolean()) : value.line());
  return result;
}

void require_named_once(const ConfigValue& key, std::span<const CaseParameter> parameters) {
  for (const CaseParameter& other : parameters.first(parameters.size() - 1))
    for (const std::string& name : parameters.back().keys)
      if (std::ranges::count(other.keys, name) > 0) throw key.error(fmt::format("\"{}\" is named twice", name));
}

double read_parameter_value(const ConfigValue& value, const CaseParameter& parameter) {
  return parameter.unit.empty() ? value.number() : value.quantity(parameter.dimension);
}

std::string shown(std::span<const CaseParameter> parameters, std::span<const double> values) {
  std::vector<std::string> texts;
  for (std::size_t j = 0; j < values.size(); ++j)
    texts.push_back(fmt::format("{} = {}", parameters[j].short_name(), parameters[j].shown(values[j])));
  return fmt::format("{}", fmt::join(texts, ", "));
}

CaseFile with_values(const CaseFile& file, std::span<const CaseParameter> parameters, std::span<const double> values) {
  std::string text = file.text;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (std::size_t k = 0; k < parameters[j].keys.size(); ++k)
      text = with_value(text, parameters[j].keys[k], piece_of_toml(parameters[j], k, values[j], file));
  return with_text(file, std::move(text));
}

}  // namespace pfdm
