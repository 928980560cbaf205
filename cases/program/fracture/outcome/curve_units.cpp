#include "cases/program/fracture/outcome/curve_units.h"

#include "physics/quantity_text.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <variant>

namespace pfdm {
namespace {

const TomlValue* entry_named(const TomlValue* value, std::string_view key) {
  const auto* table = value == nullptr ? nullptr : std::get_if<TomlTable>(&value->value);
  if (table == nullptr) return nullptr;
  const auto found = std::ranges::find(*table, key, &TomlEntry::key);
  return found == table->end() ? nullptr : &found->value;
}

std::span<const TomlValue> elements_of(const TomlValue* value) {
  const auto* array = value == nullptr ? nullptr : std::get_if<TomlArray>(&value->value);
  return array == nullptr ? std::span<const TomlValue>() : std::span<const TomlValue>(*array);
}

std::string text_of(const TomlValue* value) {
  const auto* text = value == nullptr ? nullptr : std::get_if<std::string>(&value->value);
  return text == nullptr ? std::string() : *text;
}

/// The unit of "624 um", or of { expr = "...", unit = "um" }; empty if there is none.
std::string unit_given(const TomlValue& value) {
  if (const TomlValue* unit = entry_named(&value, "unit")) return text_of(unit);
  try {
    return std::string(unit_of(text_of(&value)));
  } catch (const InputError&) {  // "free"
    return {};
  }
}

bool names_patch(const TomlValue& boundary, const std::string& patch) {
  return text_of(entry_named(&boundary, "patch")) == patch ||
         std::ranges::any_of(elements_of(entry_named(&boundary, "patches")),
                             [&](const TomlValue& name) { return text_of(&name) == patch; });
}

/// Of the curve's patch and direction, or else the first that any patch has.
std::string unit_of_displacement(const TomlValue& root, const CurveSettings& curve) {
  std::string any;
  for (const TomlValue& boundary : elements_of(entry_named(&root, "boundary"))) {
    const auto components = elements_of(entry_named(&boundary, "displacement"));
    for (std::size_t i = 0; i < components.size(); ++i) {
      std::string unit = unit_given(components[i]);
      if (!is_unit_of(unit, dimension::length)) continue;
      if (names_patch(boundary, curve.patch) && i == static_cast<std::size_t>(curve.component)) return unit;
      if (any.empty()) any = unit;
    }
  }
  return any;
}

std::string unit_of_force(const TomlValue& root) {
  for (const TomlValue& specimen : elements_of(entry_named(entry_named(&root, "experiment"), "specimens")))
    if (std::string unit = text_of(entry_named(entry_named(&specimen, "force"), "unit"));
        is_unit_of(unit, dimension::force))
      return unit;
  return {};
}

CaseUnit case_unit(const std::string& name, const Dimension& of) {
  if (name.empty()) return {.si_unit = std::string(of.si_unit)};
  return {.name = name, .si_unit = std::string(of.si_unit), .in_si = unit_in_si(name, of)};
}

}  // namespace

CurveUnits read_curve_units(const CaseFile& file, const CurveSettings& curve) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  return {.displacement = case_unit(unit_of_displacement(root, curve), dimension::length),
          .force = case_unit(unit_of_force(root), dimension::force)};
}

std::string shown_in(const CaseUnit& unit, double si) {
  if (unit.si_unit == "1") return shown(si);
  if (!unit.name.empty()) return fmt::format("{} {}", shown(si / unit.in_si), unit.name);
  return quantity_text(si, unit.si_unit);
}

std::string two_shown_in(const CaseUnit& unit, double a, std::string_view between, double b) {
  std::string first = shown_in(unit, a);
  const std::string second = shown_in(unit, b);
  const std::string ending = second.substr(std::min(second.find(' '), second.size()));
  if (first.ends_with(ending)) first.resize(first.size() - ending.size());
  return fmt::format("{} {} {}", first, between, second);
}

}  // namespace pfdm
