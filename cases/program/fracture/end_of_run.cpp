#include "cases/program/fracture/end_of_run.h"

#include "cases/program/fracture/mean_curve.h"
#include "postproc/files/json.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

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
      const std::string unit = unit_given(components[i]);
      if (!is_unit_of(unit, dimension::length)) continue;
      if (names_patch(boundary, curve.patch) && i == static_cast<std::size_t>(curve.component)) return unit;
      if (any.empty()) any = unit;
    }
  }
  return any;
}

std::string unit_of_force(const TomlValue& root) {
  for (const TomlValue& specimen : elements_of(entry_named(entry_named(&root, "experiment"), "specimens")))
    if (const std::string unit = text_of(entry_named(entry_named(&specimen, "force"), "unit"));
        is_unit_of(unit, dimension::force))
      return unit;
  return {};
}

CaseUnit case_unit(const std::string& name, const Dimension& of) {
  if (name.empty()) return {.si_unit = std::string(of.si_unit)};
  return {.name = name, .si_unit = std::string(of.si_unit), .in_si = unit_in_si(name, of)};
}

/// "154.6 and 157.1 um"
std::string two_shown(const CaseUnit& unit, double a, std::string_view between, double b) {
  std::string first = shown_in(unit, a);
  const std::string second = shown_in(unit, b);
  const std::string ending = second.substr(std::min(second.find(' '), second.size()));
  if (first.ends_with(ending)) first.resize(first.size() - ending.size());
  return fmt::format("{} {} {}", first, between, second);
}

double figure_of(const RunSummary& summary, const std::string& name) {
  const auto found = summary.other_figures.find(name);
  return found == summary.other_figures.end() ? Headlines::none : found->second;
}

/// Names of displacement and force among the figures, and their units; strain and stress of a box.
struct Axes {
  std::string x, x_unit, y, y_unit;
  CaseUnit x_shown, y_shown;
  std::string y_words;
};

Axes axes_of(const FractureCase& fracture, const CurveUnits& units) {
  if (!fracture.box) return {"displacement", "_m", "force", "_N", units.displacement, units.force, "force"};
  const std::string name(name_of_component(fracture.box->component));
  return {"strain_" + name,     "", "stress_" + name, "_Pa", {.name = "-", .si_unit = "1"}, {.si_unit = "Pa"},
          "mean stress " + name};
}

/// "greatest force 27.08 N at 624 um, the end of the curve"
std::vector<std::string> lines_of_curve(const RunSummary& summary, const FractureCase& fracture,
                                        const CurveUnits& units) {
  if (!summary.figures) return {};
  const Headlines& f = *summary.figures;
  double peak = f.peak_force, at = f.displacement_at_peak, last = f.final_force, end = f.final_displacement;
  const Axes axes = axes_of(fracture, units);
  if (fracture.box) {
    peak = figure_of(summary, fmt::format("peak_{}_Pa", axes.y));
    at = figure_of(summary, fmt::format("{}_at_peak", axes.x));
    last = figure_of(summary, fmt::format("final_{}_Pa", axes.y));
    end = figure_of(summary, fmt::format("final_{}", axes.x));
  }
  const std::string x = fracture.box ? axes.x + " = " : std::string();
  std::string line =
      fmt::format("greatest {} {} at {}{}", axes.y_words, shown_in(axes.y_shown, peak), x, shown_in(axes.x_shown, at));
  if (peak == last && at == end) return {line + ", the end of the curve: it still rises there"};
  return {fmt::format("{}; {} at the end, {}{}", line, shown_in(axes.y_shown, last), x, shown_in(axes.x_shown, end))};
}

std::string line_of_law(const nlohmann::ordered_json& surface) {
  const nlohmann::ordered_json* strongest = nullptr;
  for (const auto& law : surface.at("laws"))
    if (number_of(law.at("strength_Pa")) > 0.0 &&
        (strongest == nullptr || number_of(law.at("strength_Pa")) > number_of(strongest->at("strength_Pa"))))
      strongest = &law;
  if (strongest == nullptr || surface.at("law_is_given").get<bool>()) return {};
  const auto number = [&](const char* key) { return number_of(strongest->at(key)); };
  return fmt::format("law of \"{}\": largest normal traction {} at a separation of {}, surface energy {:.4g} J/m^2{}",
                     surface.at("name").get<std::string>(), shown_in({.si_unit = "Pa"}, number("strength_Pa")),
                     shown_in({.si_unit = "m"}, number("critical_separation_m")), number("surface_energy_J_per_m2"),
                     strongest->at("traced").get<bool>() ? "" : "; not seen down to zero traction");
}

/// Of the surfaces whose laws are extracted, not given.
std::vector<std::string> lines_of_laws(const fs::path& results) {
  const fs::path file = results / "cohesive.json";
  if (!fs::exists(file)) return {};
  return read_json(file, "file of cohesive laws", [](const nlohmann::ordered_json& json) {
    std::vector<std::string> lines;
    for (const auto& surface : json.at("surfaces"))
      if (std::string line = line_of_law(surface); !line.empty()) lines.push_back(std::move(line));
    return lines;
  });
}

}  // namespace

CurveUnits read_curve_units(const CaseFile& file, const CurveSettings& curve) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  return {.displacement = case_unit(unit_of_displacement(root, curve), dimension::length),
          .force = case_unit(unit_of_force(root), dimension::force)};
}

std::string shown_in(const CaseUnit& unit, double si) {
  if (unit.si_unit == "1") return fmt::format("{:.4g}", si);
  if (!unit.name.empty()) return fmt::format("{:.4g} {}", si / unit.in_si, unit.name);
  const DisplayUnit chosen = display_unit(si, unit.si_unit);
  const std::string name =
      chosen.name.starts_with("µ") ? "u" + chosen.name.substr(std::string("µ").size()) : chosen.name;
  return fmt::format("{:.4g} {}", chosen.factor * si, name);
}

std::string first_debonding_words(const RunSummary& summary, const FractureCase& fracture, const CurveUnits& units) {
  const Axes axes = axes_of(fracture, units);
  const auto figure = [&](const std::string& name) { return figure_of(summary, "first_debonding_" + name); };
  const double from = figure(axes.x + axes.x_unit), to = figure(axes.x + "_after" + axes.x_unit);
  if (!std::isfinite(from) || !std::isfinite(to)) return {};
  std::string words =
      fmt::format("between {}{}, where the {} goes from {}", fracture.box ? axes.x + " = " : "",
                  two_shown(axes.x_shown, from, "and", to), axes.y_words,
                  two_shown(axes.y_shown, figure(axes.y + axes.y_unit), "to", figure(axes.y + "_after" + axes.y_unit)));
  if (const double angle = figure("angle_deg"); std::isfinite(angle))
    words += fmt::format(", at polar angles of {:.0f} to {:.0f} degrees; debonding angle {:.0f} degrees",
                         figure("polar_angle_from_deg"), figure("polar_angle_to_deg"), angle);
  return words;
}

std::vector<std::vector<std::string>> first_debonding_rows(const RunSummary& summary, const FractureCase& fracture) {
  const Axes axes = axes_of(fracture, {});
  const auto figure = [&](const std::string& name) { return figure_of(summary, "first_debonding_" + name); };
  const auto shown_between = [&](const std::string& name, const std::string& unit, const CaseUnit& si) {
    const double from = figure(name + unit), to = figure(name + "_after" + unit);
    const DisplayUnit in = display_unit(std::max(std::abs(from), std::abs(to)), si.si_unit == "1" ? "" : si.si_unit);
    return si.si_unit == "1" ? fmt::format("{} to {}", shown(from), shown(to))
                             : fmt::format("{} to {} {}", shown(in.factor * from), shown(in.factor * to), in.name);
  };
  if (!std::isfinite(figure(axes.x + axes.x_unit))) return {};
  std::vector<std::vector<std::string>> rows{
      {"first debonding", shown_between(axes.x, axes.x_unit, axes.x_shown)},
      {fmt::format("its {}", fracture.box ? "stress" : "force"), shown_between(axes.y, axes.y_unit, axes.y_shown)}};
  if (const double angle = figure("angle_deg"); std::isfinite(angle))
    rows.push_back({"its debonding angle", fmt::format("{:.0f}°", angle)});
  return rows;
}

std::vector<std::string> what_happened(const FractureCase& fracture, const CaseFile& file, const RunSummary& summary,
                                       const fs::path& results) {
  const CurveUnits units = read_curve_units(file, fracture.output.curve);
  std::vector<std::string> lines = lines_of_curve(summary, fracture, units);
  const auto surface = summary.other_texts.find("first_debonding_surface");
  if (surface != summary.other_texts.end())
    lines.push_back(
        fmt::format("first debonding of \"{}\" {}", surface->second, first_debonding_words(summary, fracture, units)));
  else if (summary.other_figures.contains("first_debonding_load"))
    lines.emplace_back("no debonding: every surface holds");
  for (std::string& line : lines_of_laws(results)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace pfdm
