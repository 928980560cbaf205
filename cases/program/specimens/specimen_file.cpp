#include "cases/program/specimens/specimen_file.h"

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "physics/error.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

constexpr const Dimension* dimensions[] = {&dimension::length, &dimension::stress, &dimension::toughness,
                                           &dimension::number};

const Dimension& dimension_named(const ConfigValue& value) {
  std::vector<std::string> names;
  for (const Dimension* due : dimensions) names.emplace_back(due->name);
  const std::string name = value.one_of(names, "dimension");
  return **std::ranges::find_if(dimensions, [&](const Dimension* due) { return due->name == name; });
}

SpecimenValue read_value(const ConfigTable& table) {
  SpecimenValue value{.name = table.string("name"),
                      .due = &dimension_named(table.at("dimension")),
                      .text = table.string("default"),
                      .what = table.string("what"),
                      .guess = table.string("guess", "")};
  value.least = table.number("least", 0.0);
  value.most = table.number("most", 0.0);
  return value;
}

std::filesystem::path folder_in(const std::filesystem::path& cases_directory) { return cases_directory / "specimens"; }

}  // namespace

std::vector<std::string> specimen_names(const std::filesystem::path& cases_directory) {
  std::vector<std::pair<std::string, std::string>> found;  // standard's place in the list, name
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder_in(cases_directory), unreadable)) {
    if (entry.path().extension() != ".toml") continue;
    const Config config(read_file(entry.path()), entry.path().string());
    found.emplace_back(config.root().string("order"), entry.path().stem().string());
  }
  std::ranges::sort(found);
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const auto& [order, name] : found) names.push_back(name);
  return names;
}

SpecimenFile read_specimen_file(const std::filesystem::path& cases_directory, const std::string& name) {
  const std::vector<std::string> names = specimen_names(cases_directory);
  if (std::ranges::find(names, name) == names.end())
    throw InputError(fmt::format("--specimen: there is no specimen \"{}\"{} (available: {})", name,
                                 did_you_mean(name, names), fmt::join(names, ", ")));
  const std::filesystem::path file = folder_in(cases_directory) / (name + ".toml");
  const Config config(read_file(file), file.string());
  const ConfigTable root = config.root();
  SpecimenFile specimen{.name = name, .title = root.string("title"), .standard = root.string("standard")};
  root.string("order");
  for (const ConfigTable& value : root.tables("values")) specimen.values.push_back(read_value(value));
  for (const ConfigTable& row : root.tables("derived"))
    specimen.derived.emplace_back(row.string("name"), row.string("formula"));
  for (const ConfigTable& rule : root.tables("rules"))
    specimen.rules.push_back({rule.string("that"), rule.string("message"), rule.boolean("is_doubt", false)});
  specimen.takes_toe = root.boolean("toe", true);
  specimen.share = root.string("share", "");
  specimen.case_text = root.string("case");
  specimen.reduction = root.string("reduction", "");
  specimen.fit_text = root.string("fit", "");
  specimen.readme = root.string("readme");
  config.reject_unknown_keys();
  return specimen;
}

}  // namespace pfdm
