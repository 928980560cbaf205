#include "cases/program/studies/runs/finer_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace pfdm {
namespace {

/// As a piece of TOML.
std::string piece_of(const ConfigValue& value) {
  return value.is_string() ? quoted_toml(value.string()) : fmt::format("{}", value.number());
}

}  // namespace

std::optional<CaseVariant> changed_case(const ConfigTable& where, const std::string& table, const CaseFile& file) {
  if (!where.has(table)) return std::nullopt;
  std::string text = file.text;
  std::vector<std::string> shown;
  for (const auto& [key, value] : where.table(table).entries()) {
    text = value.in_context([&] { return with_value(text, key, piece_of(value)); });
    shown.push_back(fmt::format("{} = {}", key, value.is_string() ? value.string() : piece_of(value)));
  }
  if (shown.empty()) throw where.at(table).error("name at least one key of the case, as in \"mesh.z[0].cells\" = 10");
  return CaseVariant{with_text(file, std::move(text)), fmt::format("{}", fmt::join(shown, ", "))};
}

std::optional<CaseVariant> finer_case(const ConfigTable& fit, const CaseFile& file) {
  return changed_case(fit, "finer", file);
}

std::optional<CaseVariant> coarse_case(const ConfigTable& fit, const CaseFile& file) {
  return changed_case(fit, "coarse", file);
}

}  // namespace pfdm
