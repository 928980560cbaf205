#include "cases/program/case_file.h"

#include "postproc/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <sstream>

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

// The table that a line opens, as in "material.hardening"; none if it opens none. A multi-line list also has lines that
// begin with a bracket.
std::optional<std::string> opened_table(const std::string& line) {
  static const std::regex header(R"(^\s*\[\[?\s*([A-Za-z_.\s]*[A-Za-z_])\s*\]\]?\s*(#.*)?$)");
  std::smatch match;
  return std::regex_match(line, match, header) ? std::optional(match[1].str()) : std::nullopt;
}

std::string with_path(const std::string& line, const std::function<std::string(const std::string&)>& renamed) {
  static const std::regex path(R"re((\b(csv|file)\s*=\s*")([^"]*)("))re");
  std::smatch match;
  if (!std::regex_search(line, match, path)) return line;
  return match.prefix().str() + match[1].str() + renamed(match[3].str()) + match[4].str() + match.suffix().str();
}

std::string with_moved_path(const std::string& line, const std::filesystem::path& from,
                            const std::filesystem::path& to) {
  return with_path(line, [&](const std::string& path) {
    const auto absolute = std::filesystem::weakly_canonical(std::filesystem::absolute(from / path));
    return std::filesystem::relative(absolute, std::filesystem::weakly_canonical(std::filesystem::absolute(to)))
        .string();
  });
}

}  // namespace

CaseFile open_case(const std::filesystem::path& where) {
  const bool is_file = where.extension() == ".toml";
  const std::filesystem::path directory = !is_file ? where : where.has_parent_path() ? where.parent_path() : ".";
  const std::filesystem::path file = is_file ? where : where / "case.toml";
  if (!std::filesystem::exists(where))
    throw InputError(fmt::format("{}: there is no such case directory", where.string()));
  if (!std::filesystem::exists(file)) throw InputError(fmt::format("{}: there is no case.toml in it", where.string()));
  std::string text = read_file(file);
  Config config(text, file.string());
  return {.directory = directory, .text = std::move(text), .config = std::move(config)};
}

std::string case_name(const CaseFile& file) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file.directory)).filename().string();
}

std::string case_hash(const CaseFile& file, std::span<const std::filesystem::path> data_files,
                      std::span<const std::string_view> left_out) {
  std::uint64_t hash = add_to_hash(hash_of_nothing, format_version);
  const TomlValue root = parse_toml(file.text, "case.toml");
  for (const auto& [key, value] : std::get<TomlTable>(root.value))
    if (key != "title" && std::ranges::count(left_out, key) == 0) hash = add_to_hash(hash, key + written(value));
  for (const std::filesystem::path& data : data_files) hash = add_to_hash(hash, read_file(data));
  return fmt::format("{:016x}", hash);
}

CaseFile with_text(const CaseFile& file, std::string text) {
  Config config(text, (file.directory / "case.toml").string());
  return {.directory = file.directory, .text = std::move(text), .config = std::move(config)};
}

std::string table_hash(const CaseFile& file, std::string_view table,
                       std::span<const std::filesystem::path> data_files) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  std::uint64_t hash = add_to_hash(hash_of_nothing, written(value_at(root, table)));
  for (const std::filesystem::path& data : data_files) hash = add_to_hash(hash, read_file(data));
  return fmt::format("{:016x}", hash);
}

std::string with_paths(const CaseFile& file, const std::function<std::string(const std::string&)>& renamed) {
  std::istringstream lines(file.text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += with_path(line, renamed) + "\n";
  return result;
}

std::string moved(const CaseFile& file, const std::filesystem::path& folder) {
  std::istringstream lines(file.text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += with_moved_path(line, file.directory, folder) + "\n";
  return result;
}

std::string with_table(const CaseFile& file, std::string_view table, const std::string& text,
                       const std::filesystem::path& folder) {
  std::istringstream lines(file.text);
  std::string result;
  bool within = false, written = false;
  for (std::string line; std::getline(lines, line);) {
    if (const auto opened = opened_table(line))
      within = *opened == table || opened->starts_with(std::string(table) + ".");
    if (within && !written) {
      result += text;
      written = true;
    }
    if (!within) result += with_moved_path(line, file.directory, folder) + "\n";
  }
  return result;
}

}  // namespace pfdm
