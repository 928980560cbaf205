#include "cases/program/input/config/path_reader.h"

#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace pfdm {
namespace {

constexpr std::size_t longest_name = 100;  // file systems allow 255 bytes, endings and all

constexpr std::string_view made_by_runs[] = {"stress_strain.csv", "force_displacement.csv", "homogenized.json",
                                             "summary.json"};

bool may_stand_in_a_name(unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; }

}  // namespace

void require_plain_name(std::string_view name, std::string_view use) {
  if (!name.empty() && name.size() <= longest_name && name.front() != '.' &&
      std::ranges::all_of(name, may_stand_in_a_name))
    return;
  throw InputError(
      fmt::format("\"{}\" is used as the name of {}; it may have letters, digits, _ and - only, and . but not at the "
                  "beginning, at most {} characters",
                  name, use, longest_name));
}

std::string read_plain_name(const ConfigValue& value, std::string_view use) {
  std::string name = value.string();
  value.in_context([&] { return require_plain_name(name, use), true; });
  return name;
}

std::string way_to_make(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.lexically_normal().parent_path();
  if (folder.filename() != "results") return "";
  const std::string made_in = folder.parent_path().empty() ? "." : folder.parent_path().string();
  for (const std::string_view name : made_by_runs)
    if (file.filename() == name) return fmt::format("; pfdm run {} makes it", made_in);
  return fmt::format("; it is among the results of {}: has that been run, or fitted?", made_in);
}

std::filesystem::path read_data_file(const ConfigValue& value, const std::filesystem::path& case_directory) {
  std::filesystem::path file = case_directory / value.string();
  value.in_context([&] {
    std::error_code ignored;
    if (const std::string way = way_to_make(file); !way.empty() && !std::filesystem::exists(file, ignored))
      throw InputError(fmt::format("there is no file {}{}", value.string(), way));
    return require_file(file), true;
  });
  return file;
}

}  // namespace pfdm
