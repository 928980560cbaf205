#include "cases/program/case_file.h"

#include "postproc/text_file.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

constexpr std::string_view format_version = "pfdm case 2";

std::uint64_t add_to_hash(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3ULL;
  }
  return hash;
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

std::string case_hash(const CaseFile& file, std::span<const std::filesystem::path> data_files) {
  std::uint64_t hash = add_to_hash(0xcbf29ce484222325ULL, format_version);
  const TomlValue root = parse_toml(file.text, "case.toml");
  for (const auto& [key, value] : std::get<TomlTable>(root.value))
    if (key != "title" && key != "solver" && key != "loading") hash = add_to_hash(hash, key + written(value));
  for (const std::filesystem::path& data : data_files) hash = add_to_hash(hash, read_file(data));
  return fmt::format("{:016x}", hash);
}

}  // namespace pfdm
