#include "cases/program/studies/sensitivity/sensitivity_parameters.h"

#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

std::string_view last_key(std::string_view path) { return path.substr(path.rfind('.') + 1); }

/// Tables that hold constants, and what in them is none.
bool is_place_of_constants(std::string_view path) {
  constexpr std::string_view tables[] = {"materials.", "regions.", "interface["};
  constexpr std::string_view others[] = {".plane.", "_scatter.", ".delta.", ".eigenstrain"};
  constexpr std::string_view last[] = {
      "unit", "expr", "seed", "table_law", "residual_stiffness", "perturbation", "perturbation_seed", "delta"};
  const auto holds = [&](std::string_view part) { return path.find(part) != std::string_view::npos; };
  const auto starts = [&](std::string_view table) { return path.starts_with(table); };
  return (std::ranges::any_of(tables, starts) || path.starts_with("fracture.")) &&
         std::ranges::none_of(others, holds) && std::ranges::count(last, last_key(path)) == 0 && !path.ends_with(']');
}

/// Nothing if there is no positive quantity or number there.
std::optional<CaseParameter> constant_at(const std::string& path, const CaseFile& file) {
  try {
    CaseParameter found = case_parameter(path, file);
    if (found.value > 0.0 && found.zero_in_si == 0.0) return found;
  } catch (const InputError&) {  // a text, a list, a quantity that no key of a fit may have
  }
  return std::nullopt;
}

CaseParameter named_parameter(const std::string& word, const CaseFile& file) {
  std::optional<CaseParameter> found;
  for (std::string_view rest = word; !rest.empty();) {
    const std::size_t plus = rest.find('+');
    const CaseParameter part = case_parameter(std::string(trimmed(rest.substr(0, plus))), file);
    if (!(part.value > 0.0)) throw InputError("it is not positive: a relative step of it has no meaning");
    if (found)
      keep_ratio(*found, part);
    else
      found = part;
    rest = plus == std::string_view::npos ? std::string_view() : rest.substr(plus + 1);
  }
  if (!found) throw InputError("expected a key of the case, as in materials.glass.young_modulus");
  return *found;
}

bool mesh_follows_length(const CaseFile& file) {
  bool follows = false;
  for_each_value(parse_toml(file.text, "case.toml"), [&](const std::string& path, const TomlValue&) {
    follows = follows || (path.starts_with("mesh.") && last_key(path) == "ell");
  });
  return follows;
}

}  // namespace

std::vector<CaseParameter> named_parameters(std::span<const std::string> words, const CaseFile& file) {
  std::vector<CaseParameter> found;
  std::vector<std::string> keys;
  for (const std::string& word : words) {
    try {
      found.push_back(named_parameter(word, file));
      for (const std::string& key : found.back().keys) {
        if (std::ranges::count(keys, key) > 0) throw InputError("it is named twice");
        keys.push_back(key);
      }
    } catch (const InputError& error) {
      throw InputError(fmt::format("--parameters {}: {}", word, error.what()));
    }
  }
  return found;
}

std::vector<CaseParameter> stated_constants(const CaseFile& file, std::vector<std::string>& remarks) {
  const bool follows = mesh_follows_length(file);
  std::vector<CaseParameter> found;
  for_each_value(parse_toml(file.text, "case.toml"), [&](const std::string& path, const TomlValue&) {
    if (!is_place_of_constants(path)) return;
    auto constant = constant_at(path, file);
    if (!constant) return;
    if (follows && last_key(path) == "length") {
      remarks.push_back(fmt::format(
          "{} is left out: the mesh follows it, and differences would be those of two meshes; --parameters has it",
          path));
      return;
    }
    found.push_back(std::move(*constant));
  });
  return found;
}

}  // namespace pfdm
