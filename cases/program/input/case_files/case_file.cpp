#include "cases/program/input/case_files/case_file.h"

#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/input/config/result_number.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

constexpr std::string_view format_version = "pfdm case 2";
constexpr std::uint64_t hash_of_nothing = 0xcbf29ce484222325ULL;

std::uint64_t add_to_hash(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_";
constexpr std::string_view in_table_names = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789-. \t";

/// Takes one bracket or two from the front; false if there is none.
bool take_brackets(std::string_view& text, char bracket) {
  if (!text.starts_with(bracket)) return false;
  text.remove_prefix(1);
  if (text.starts_with(bracket)) text.remove_prefix(1);
  return true;
}

// The table that a line opens, as in "material.hardening"; none if it opens none. A multi-line list also has lines that
// begin with a bracket.
std::optional<std::string> opened_table(std::string_view line) {
  std::string_view rest = trimmed(line);
  if (!take_brackets(rest, '[')) return std::nullopt;
  rest = trimmed(rest);
  const std::size_t end = std::min(rest.find_first_not_of(in_table_names), rest.size());
  const std::string_view name = trimmed(rest.substr(0, end));
  if (name.empty() || letters.find(name.front()) == std::string_view::npos || name.ends_with('.')) return std::nullopt;
  rest.remove_prefix(end);
  if (!take_brackets(rest, ']')) return std::nullopt;
  rest = trimmed(rest);
  return rest.empty() || rest.starts_with('#') ? std::optional(std::string(name)) : std::nullopt;
}

/// As opposed to what is there and cannot be read.
bool is_not_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::status(path, ignored).type() == std::filesystem::file_type::not_found;
}

std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  using std::filesystem::absolute, std::filesystem::weakly_canonical;
  return std::filesystem::relative(weakly_canonical(absolute(file)), weakly_canonical(absolute(folder))).string();
}

/// Calls `see` with every value below this one and its path, as in "mesh.particles[0].diameter".
void visit(const std::string& path, const TomlValue& value,
           const std::function<void(const std::string& path, const TomlValue& value)>& see) {
  see(path, value);
  if (const auto* list = std::get_if<TomlArray>(&value.value))
    for (std::size_t i = 0; i < list->size(); ++i) visit(fmt::format("{}[{}]", path, i), (*list)[i], see);
  if (const auto* table = std::get_if<TomlTable>(&value.value))
    for (const auto& [name, entry] : *table) visit(path.empty() ? name : path + "." + name, entry, see);
}

bool names_data_file(const std::string& path, const TomlValue& value) {
  const std::string key = path.substr(path.find_last_of('.') + 1);
  const bool is_of_particle =  // elsewhere a patch, or a name
      key == "surface" && (path.starts_with("mesh.particles[") || path.starts_with("mesh.shapes["));
  return (key == "csv" || key == "file" || key == "base_file" || key == "fit" || key == "table" || is_of_particle) &&
         std::holds_alternative<std::string>(value.value);
}

/// Numbers that stand in result files count as if they stood here.
std::uint64_t add_numbers_from_results(std::uint64_t hash, const TomlValue& root,
                                       const std::filesystem::path& directory) {
  visit("", root, [&](const std::string&, const TomlValue& value) {
    if (path_of_result(value) != nullptr) hash = add_to_hash(hash, fmt::format("{}", result_number(value, directory)));
  });
  return hash;
}

/// The values that name files, in the order of the text.
std::vector<const TomlValue*> values_that_name_files(const TomlValue& root) {
  std::vector<const TomlValue*> found;
  visit("", root, [&](const std::string& path, const TomlValue& value) {
    if (names_data_file(path, value)) found.push_back(&value);
    if (const TomlValue* result = path_of_result(value)) found.push_back(result);
  });
  std::ranges::sort(found, {}, [](const TomlValue* value) { return std::pair(value->line, value->column); });
  return found;
}

constexpr std::string_view usual_stem = "case";

bool has_usual_name(const CaseFile& file) { return file.stem == usual_stem || file.stem.empty(); }

/// "fitted" of case.fitted.toml, "coarse" of coarse.toml.
std::string short_stem(const CaseFile& file) {
  const std::string prefix = std::string(usual_stem) + ".";
  return file.stem.starts_with(prefix) ? file.stem.substr(prefix.size()) : file.stem;
}

std::filesystem::path whole_directory(const CaseFile& file) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file.directory));
}

}  // namespace

CaseFile open_case(const std::filesystem::path& where) {
  std::error_code ignored;
  const bool is_file = where.extension() == ".toml" && !std::filesystem::is_directory(where, ignored);
  const std::filesystem::path directory = !is_file ? where : where.has_parent_path() ? where.parent_path() : ".";
  const std::filesystem::path file = is_file ? where : where / "case.toml";
  if (is_not_there(where)) throw InputError(fmt::format("{}: there is no such case directory", where.string()));
  if (is_not_there(file)) throw InputError(fmt::format("{}: it contains no case.toml", where.string()));
  std::string text = read_file(file);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  Config config(text, file.string());
  return where_it_ran(
      {.directory = directory, .stem = file.stem().string(), .text = std::move(text), .config = std::move(config)});
}

std::string name_among_results(const CaseFile& file) {
  const bool in_results = whole_directory(file).filename() == "results";
  return in_results && !has_usual_name(file) ? short_stem(file) : "";
}

std::string case_name(const CaseFile& file) {
  if (!file.kept_name.empty()) return file.kept_name;
  const std::filesystem::path directory = whole_directory(file);
  const bool in_results = !name_among_results(file).empty();
  const std::string name = (in_results ? directory.parent_path() : directory).filename().string();
  return has_usual_name(file) ? name : name + "." + short_stem(file);
}

void for_each_value(const TomlValue& root,
                    const std::function<void(const std::string& path, const TomlValue& value)>& see) {
  visit("", root, see);
}

std::string case_hash(const CaseFile& file, std::span<const std::filesystem::path> data_files,
                      std::span<const std::string_view> left_out) {
  std::uint64_t hash = add_to_hash(hash_of_nothing, format_version);
  const TomlValue root = parse_toml(file.text, "case.toml");
  for (const auto& [key, value] : std::get<TomlTable>(root.value))
    if (key != "title" && std::ranges::count(left_out, key) == 0)
      hash = add_numbers_from_results(add_to_hash(hash, key + written(value)), value, file.directory);
  for (const std::filesystem::path& data : data_files) hash = add_to_hash(hash, read_file(data));
  return fmt::format("{:016x}", hash);
}

std::vector<std::filesystem::path> data_files_named(const CaseFile& file) {
  std::vector<std::filesystem::path> files;
  visit("", parse_toml(file.text, "case.toml"), [&](const std::string& path, const TomlValue& value) {
    if (names_data_file(path, value)) files.push_back(file.directory / std::get<std::string>(value.value));
  });
  return files;
}

std::vector<TakenNumber> numbers_taken(const CaseFile& file) {
  std::vector<TakenNumber> taken;
  visit("", parse_toml(file.text, "case.toml"), [&](const std::string& path, const TomlValue& value) {
    if (path_of_result(value) == nullptr) return;
    const auto& table = std::get<TomlTable>(value.value);
    const auto text = [&](std::string_view key) {
      return std::get<std::string>(std::ranges::find(table, key, &TomlEntry::key)->value.value);
    };
    taken.push_back({path, text("from"), text("key"), result_number(value, file.directory)});
  });
  return taken;
}

std::string content_hash(const std::filesystem::path& file) {
  return fmt::format("{:016x}", add_to_hash(hash_of_nothing, read_file(file)));
}

CaseFile with_text(const CaseFile& file, std::string text) {
  Config config(text, (file.directory / "case.toml").string());
  return {.directory = file.directory,
          .stem = file.stem,
          .text = std::move(text),
          .config = std::move(config),
          .kept_in = file.kept_in,
          .kept_name = file.kept_name};
}

std::string table_hash(const CaseFile& file, std::string_view table,
                       std::span<const std::filesystem::path> data_files) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  const TomlValue& found = value_at(root, table);
  std::uint64_t hash = add_numbers_from_results(add_to_hash(hash_of_nothing, written(found)), found, file.directory);
  for (const std::filesystem::path& data : data_files) hash = add_to_hash(hash, read_file(data));
  return fmt::format("{:016x}", hash);
}

std::string with_paths(const CaseFile& file, const std::function<std::string(const std::string&)>& renamed) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  const std::vector<const TomlValue*> values = values_that_name_files(root);
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const TomlValue* value : values) names.push_back(renamed(std::get<std::string>(value->value)));
  std::string text = file.text;
  for (std::size_t i = values.size(); i-- > 0;)  // from the end: what stands before stays put
    text = with_value(text, *values[i], quoted_toml(names[i]));
  return text;
}

std::string moved(const CaseFile& file, const std::filesystem::path& folder) {
  return with_paths(file, [&](const std::string& name) { return seen_from(folder, file.directory / name); });
}

std::string with_table_replaced(const std::string& text, std::string_view table, const std::string& by) {
  std::istringstream lines(text);
  std::string result;
  bool within = false, written = false;
  for (std::string line; std::getline(lines, line);) {
    if (const auto opened = opened_table(line))
      within = *opened == table || opened->starts_with(std::string(table) + ".");
    if (within && !written) {
      result += by;
      written = true;
    }
    if (!within) result += line + "\n";
  }
  return result;
}

std::string with_table(const CaseFile& file, std::string_view table, const std::string& text,
                       const std::filesystem::path& folder) {
  return with_table_replaced(moved(file, folder), table, text);
}

}  // namespace pfdm
