#include "cases/program/input/case_files/kept_case.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "# Kept by pfdm ";
constexpr const char* kept_file = "case.toml";
constexpr std::string_view without_results[] = {"title", "solver", "loading", "experiment", "fit", "sweep"};

/// Every text and number of the file, by its path.
std::map<std::string, std::string> values_in(const std::string& text) {
  std::map<std::string, std::string> values;
  for_each_value(parse_toml(text, kept_file), [&](const std::string& path, const TomlValue& value) {
    const bool single =
        !std::holds_alternative<TomlArray>(value.value) && !std::holds_alternative<TomlTable>(value.value);
    if (single) values[path] = written(value);
  });
  return values;
}

bool decides_results(const std::string& path) {
  const std::string table = path.substr(0, path.find_first_of(".["));
  return std::ranges::count(without_results, table) == 0;
}

struct Change {
  std::string path, words;
};

std::vector<Change> changes_between(const std::map<std::string, std::string>& before,
                                    const std::map<std::string, std::string>& now) {
  std::vector<Change> changes;
  for (const auto& [path, value] : now) {
    const auto old = before.find(path);
    if (old == before.end())
      changes.push_back({path, fmt::format("{} = {} (was not there)", path, value)});
    else if (old->second != value)
      changes.push_back({path, fmt::format("{} = {} (was {})", path, value, old->second)});
  }
  for (const auto& [path, value] : before)
    if (!now.contains(path)) changes.push_back({path, fmt::format("{} is gone (was {})", path, value)});
  return changes;
}

/// Name and directory in the first line of a kept case.
std::vector<std::string> quoted_words(const std::string& text) {
  std::vector<std::string> words;
  const std::string line = text.substr(0, text.find('\n'));
  for (std::size_t begin = line.find('"'); begin != std::string::npos;) {
    const std::size_t end = std::min(line.find('"', begin + 1), line.size());
    words.push_back(line.substr(begin + 1, end - begin - 1));
    begin = end < line.size() ? line.find('"', end + 1) : std::string::npos;
  }
  words.resize(std::max<std::size_t>(words.size(), 2));
  return words;
}

bool same_folder(const fs::path& a, const fs::path& b) {
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

}  // namespace

void keep_case(const CaseFile& file, const std::string& version, const fs::path& results, const fs::path& folder) {
  if (same_folder(file.directory, results)) return;
  write_file(
      folder / kept_file,
      fmt::format("{}{}: the case \"{}\" of \"{}\" as it ran. Paths start here.\n{}", mark, version, case_name(file),
                  fs::relative(fs::absolute(file.directory), fs::absolute(results)).string(), moved(file, results)));
}

CaseFile where_it_ran(CaseFile file) {
  std::error_code ignored;
  const bool has_results = fs::exists(file.directory / "run.log", ignored);
  if (!file.text.starts_with(mark) || !has_results) return file;
  const std::vector<std::string> words = quoted_words(file.text);
  const fs::path directory = (file.directory / words[1]).lexically_normal();
  file.kept_in = file.directory;
  file.kept_name = words[0];
  file.text.replace(0, file.text.find('\n'), "#");  // what is made of it is no kept file
  if (!fs::is_directory(directory, ignored)) return file;
  const std::string shown = file.config.root().at("kind").file();
  file.text = moved(file, directory);
  file.config = Config(file.text, shown);
  file.directory = directory;
  return file;
}

fs::path own_results(const CaseFile& file) {
  if (!file.kept_in.empty()) return file.kept_in;
  const std::string name = name_among_results(file);
  return name.empty() ? file.directory / "results" : file.directory / name;
}

std::vector<std::string> changed_keys(const CaseFile& file, const fs::path& results) {
  std::error_code ignored;
  if (!fs::is_regular_file(results / kept_file, ignored)) return {};
  std::vector<Change> changes;
  try {
    changes = changes_between(values_in(read_file(results / kept_file)), values_in(moved(file, results)));
  } catch (const InputError&) {  // edited by hand
    return {};
  }
  const auto first_idle =
      std::ranges::stable_partition(changes, [](const Change& change) { return decides_results(change.path); }).begin();
  if (first_idle != changes.begin()) changes.erase(first_idle, changes.end());
  std::vector<std::string> words;
  for (Change& change : changes) words.push_back(std::move(change.words));
  return words;
}

std::string words_on_changes(const CaseFile& file, const fs::path& results) {
  constexpr std::size_t limit = 5;
  std::error_code ignored;
  if (!fs::is_regular_file(results / kept_file, ignored)) return "";
  std::vector<std::string> changes = changed_keys(file, results);
  if (changes.empty()) return "; no key was changed since: a file that the case reads was";
  const std::size_t more = changes.size() > limit ? changes.size() - limit : 0;
  changes.resize(changes.size() - more);
  return fmt::format("; changed since: {}{}", fmt::join(changes, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace pfdm
