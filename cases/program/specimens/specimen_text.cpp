#include "cases/program/specimens/specimen_text.h"

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/expression.h"
#include "cases/program/input/config/units.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pfdm {
namespace {

double plain_number(const std::string& text) {
  double number = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size())
    throw InputError(fmt::format("\"{}\" is not a number", text));
  return number;
}

double read_number(const SpecimenValue& value, const std::string& text) {
  const double number = value.due == &dimension::number ? plain_number(text) : parse_quantity(text, *value.due);
  const bool bounded = value.least != 0.0 || value.most != 0.0;
  if (!bounded && !(number > 0.0)) throw InputError(fmt::format("\"{}\" must be positive", text));
  if (bounded && !(number > value.least && number < value.most))
    throw InputError(fmt::format("\"{}\" must be above {:g} and below {:g}", text, value.least, value.most));
  return number;
}

const SpecimenValue* find_value(const SpecimenFile& specimen, std::string_view name) {
  const auto found = std::ranges::find(specimen.values, name, &SpecimenValue::name);
  return found == specimen.values.end() ? nullptr : &*found;
}

InputError unknown_value(const SpecimenFile& specimen, const std::string& name, std::span<const std::string> others) {
  std::vector<std::string> names;
  for (const SpecimenValue& value : specimen.values) names.push_back(value.name);
  names.insert(names.end(), others.begin(), others.end());
  return InputError(fmt::format("--set {}: {} has no such value{} (available: {})", name, specimen.name,
                                did_you_mean(name, names), fmt::join(names, ", ")));
}

/// What is between {{ and }}: a name, or a formula with its unit behind the last colon.
std::string replacement(const std::string& piece, const SpecimenWords& words) {
  const std::size_t colon = piece.rfind(" : ");
  if (colon == std::string::npos) {
    const std::string name(trimmed(piece));
    const auto written = words.texts.find(name);
    if (written == words.texts.end()) throw InputError(fmt::format("there is no value \"{}\"", name));
    const std::string& text = written->second;
    return text.find(' ') == std::string::npos && text.find('"') == std::string::npos &&
                   text.find_first_not_of("0123456789.+-eE") == std::string::npos
               ? text
               : fmt::format("\"{}\"", text);
  }
  const double value = evaluated(std::string(trimmed(std::string_view(piece).substr(0, colon))), words.numbers);
  std::string unit(trimmed(std::string_view(piece).substr(colon + 3)));
  if (unit == "count") return fmt::format("{}", std::llround(value));
  if (unit == "1") return fmt::format("{:.9g}", value);
  const bool bare = unit.starts_with("in "), rounded = unit.starts_with("about ");
  if (bare || rounded) unit = unit.substr(unit.find(' ') + 1);
  const double factor = unit_in_si(unit, dimension_of("1 " + unit));
  const std::string quantity = fmt::format("{:.{}g} {}", value / factor, bare ? 4 : rounded ? 3 : 9, unit);
  return bare ? quantity : fmt::format("\"{}\"", quantity);
}

}  // namespace

SpecimenWords specimen_words(const SpecimenFile& specimen, std::span<const std::string> words,
                             std::span<const std::string> others, std::map<std::string, std::string>& left_over) {
  SpecimenWords found;
  for (const SpecimenValue& value : specimen.values) {
    found.texts[value.name] = value.text;
    found.numbers[value.name] = read_number(value, value.text);
  }
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("--set {}: NAME=VALUE is required, as in --set \"{}={}\"", word,
                                   specimen.values.front().name, specimen.values.front().text));
    const std::string_view whole = word;
    const std::string name(trimmed(whole.substr(0, equals))), text(trimmed(whole.substr(equals + 1)));
    if (std::ranges::find(others, name) != others.end()) {
      left_over[name] = text;
      continue;
    }
    const SpecimenValue* value = find_value(specimen, name);
    if (value == nullptr) throw unknown_value(specimen, name, others);
    try {
      found.numbers[name] = read_number(*value, text);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--set {}: {} ({})", name, error.what(), value->what));
    }
    found.texts[name] = text;
    found.given.insert(name);
  }
  return found;
}

void guess(SpecimenWords& words, const SpecimenValue& value, double si) {
  if (!std::isfinite(si) || !(si > 0.0)) return;
  words.texts[value.name] = quantity_text(si, value.due->si_unit, 4);
  words.numbers[value.name] = si;
}

void derive(const SpecimenFile& specimen, SpecimenWords& words) {
  for (const auto& [name, formula] : specimen.derived) {
    try {
      words.numbers[name] = evaluated(formula, words.numbers);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {} of these dimensions: {}", specimen.name, name, error.what()));
    }
  }
  for (const SpecimenRule& rule : specimen.rules)
    if (!rule.is_doubt && evaluated(rule.that, words.numbers) == 0.0)
      throw InputError(fmt::format("{}: {}", specimen.name, filled(rule.message, words)));
}

std::string lines_of_doubts(const SpecimenFile& specimen, const SpecimenWords& words) {
  std::string lines;
  for (const SpecimenRule& rule : specimen.rules)
    if (rule.is_doubt && evaluated(rule.that, words.numbers) == 0.0)
      lines += fmt::format("  warning: {}\n", filled(rule.message, words));
  return lines;
}

std::string filled(const std::string& text, const SpecimenWords& words) {
  std::string result;
  for (std::size_t at = 0;;) {
    const std::size_t begin = text.find("{{", at);
    result += text.substr(at, begin - at);
    if (begin == std::string::npos) return result;
    const std::size_t end = text.find("}}", begin);
    if (end == std::string::npos) throw InputError("a text of the specimen has {{ without }}");
    result += replacement(text.substr(begin + 2, end - begin - 2), words);
    at = end + 2;
  }
}

}  // namespace pfdm
