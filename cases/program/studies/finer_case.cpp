#include "cases/program/studies/finer_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace pfdm {
namespace {

/// As a piece of TOML.
std::string piece_of(const ConfigValue& value) {
  return value.is_string() ? quoted_toml(value.string()) : fmt::format("{:.17g}", value.number());
}

}  // namespace

std::optional<CaseVariant> finer_case(const ConfigTable& fit, const CaseFile& file) {
  if (!fit.has("finer")) return std::nullopt;
  std::string text = file.text;
  std::vector<std::string> shown;
  for (const auto& [key, value] : fit.table("finer").entries()) {
    text = value.in_context([&] { return with_value(text, key, piece_of(value)); });
    shown.push_back(fmt::format("{} = {}", key, value.is_string() ? value.string() : piece_of(value)));
  }
  if (shown.empty()) throw fit.at("finer").error("name at least one key of the case, as in \"mesh.z[0].cells\" = 10");
  return CaseVariant{with_text(file, std::move(text)), fmt::format("{}", fmt::join(shown, ", "))};
}

}  // namespace pfdm
