#include "cases/program/input/config/result_number.h"

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/path_reader.h"
#include "postproc/files/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Reference {
  std::string from;
  std::string key;  // as in "stiffness_Pa[0][0]"
  std::optional<std::string> unit{};
  bool may_be_null = false;
  bool like = false;  // the file stands for others of its kind
};

const TomlValue* entry_of(const TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find(table, key, &TomlEntry::key);
  return found != table.end() ? &found->value : nullptr;
}

const std::string* text_of(const TomlTable& table, std::string_view key) {
  const TomlValue* entry = entry_of(table, key);
  return entry != nullptr ? std::get_if<std::string>(&entry->value) : nullptr;
}

// "a.b[2]" as "a", "b", "2".
std::vector<std::string> steps_of(std::string_view key) {
  constexpr std::string_view separators = ".[]";
  std::vector<std::string> steps;
  for (std::size_t begin = key.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(key.find_first_of(separators, begin), key.size());
    steps.emplace_back(key.substr(begin, end - begin));
    begin = key.find_first_not_of(separators, end);
  }
  return steps;
}

std::vector<std::string> names_in(const Json& json) {
  std::vector<std::string> names;
  if (json.is_object())
    for (const auto& [name, ignored] : json.items()) names.push_back(name);
  return names;
}

bool is_index(const std::string& step) {
  return std::ranges::all_of(step, [](char c) { return c >= '0' && c <= '9'; }) && step.size() < 9;
}

const Json* next(const Json& here, const std::string& step) {
  if (here.is_object()) {
    const auto found = here.find(step);
    return found != here.end() ? &*found : nullptr;
  }
  if (!here.is_array() || !is_index(step)) return nullptr;
  const auto i = static_cast<std::size_t>(std::stoi(step));
  return i < here.size() ? &here[i] : nullptr;
}

double number_at(const Json& root, const Reference& reference) {
  const Json* here = &root;
  for (const std::string& step : steps_of(reference.key)) {
    if (reference.like && here->is_structured() && here->empty()) return 0.0;
    const bool is_any = reference.like && here->is_array() && here->size() == 1;
    const Json* const there = next(*here, is_any && is_index(step) ? "0" : step);
    if (there == nullptr) {
      const std::vector<std::string> names = names_in(*here);
      const std::string there_is = here->is_array() ? fmt::format("a list of {}", here->size())
                                   : names.empty()  ? "nothing below it"
                                                    : fmt::format("{}", fmt::join(names, ", "));
      throw InputError(fmt::format("{} has no \"{}\": \"{}\" is not there{} (there is: {})", reference.from,
                                   reference.key, step, did_you_mean(step, names), there_is));
    }
    here = there;
  }
  if (here->is_number()) return here->get<double>();
  if (here->is_null() && reference.may_be_null) return std::numeric_limits<double>::quiet_NaN();
  throw InputError(fmt::format("\"{}\" of {} is not a number", reference.key, reference.from));
}

Reference read_reference(const TomlValue& value) {
  const auto& table = std::get<TomlTable>(value.value);
  Reference reference{.from = *text_of(table, "from"), .key = *text_of(table, "key")};
  for (const auto& [key, entry] : table) {
    if (key == "from" || key == "key") continue;
    const std::string* const unit = text_of(table, "unit");
    if (key != "unit" || unit == nullptr)
      throw InputError(fmt::format("\"{}\" is not known beside \"from\" (allowed: from, key, unit)", key));
    reference.unit = *unit;
  }
  return reference;
}

double number_in_file(const Reference& reference, const fs::path& case_directory) {
  const fs::path file = case_directory / reference.from;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    throw InputError(fmt::format("there is no file {}{}", reference.from, way_to_make(file)));
  return read_json(file, "result file", [&](const Json& json) { return number_at(json, reference); });
}

// One unit of the number in SI; of "stiffness_Pa[0][0]" the name says it.
double unit_of_number(const Reference& reference, const Dimension& due) {
  if (reference.unit) return unit_in_si(*reference.unit, due);
  const std::string name = reference.key.substr(0, reference.key.find('[')), ending = "_" + in_names(due.si_unit);
  if (due.name == dimension::number.name || name.ends_with(ending)) return 1.0;
  throw InputError(
      fmt::format("the name \"{}\" does not end in {}; expected {}, or the unit of the number beside its "
                  "key, as in unit = \"{}\"",
                  reference.key, ending, with_article(due.name), unit_of(due.example)));
}

}  // namespace

const TomlValue* path_of_result(const TomlValue& value) {
  const auto* table = std::get_if<TomlTable>(&value.value);
  if (table == nullptr || text_of(*table, "from") == nullptr || text_of(*table, "key") == nullptr) return nullptr;
  return entry_of(*table, "from");
}

double result_number(const TomlValue& value, const fs::path& case_directory) {
  return number_in_file(read_reference(value), case_directory);
}

double result_number(const TomlValue& value, const fs::path& case_directory, const Dimension& due) {
  const Reference reference = read_reference(value);
  return unit_of_number(reference, due) * number_in_file(reference, case_directory);
}

double number_in_results(const fs::path& folder, const std::string& file, const std::string& key) {
  return number_in_file({.from = file, .key = key, .unit = {}, .may_be_null = true}, folder);
}

void require_key_like(const std::string& like, const std::string& file, const std::string& key) {
  number_at(parse_json(like), {.from = file, .key = key, .unit = {}, .may_be_null = true, .like = true});
}

std::string in_names(std::string_view unit) {
  std::string name;
  for (const char c : unit)
    if (c == '/')
      name += "_per_";
    else if (c == ' ')
      name += '_';
    else if (c != '^')
      name += c;
  return name;
}

}  // namespace pfdm
