#include "cases/program/fracture/outcome/end_of_run.h"

#include "cases/program/fracture/outcome/debonded_poles.h"
#include "cases/program/fracture/outcome/heat_results.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "physics/angle.h"
#include "physics/quantity_text.h"
#include "postproc/files/json.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

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

/// Of force over displacement; of a box of stress over strain.
struct Peak {
  double most, at, last, end;
  double at_most = Headlines::none;  // by a coarse step that broke
  bool is_end() const { return most == last && at == end; }
  bool is_coarse() const {
    constexpr double bearable = 0.02;
    return std::abs(at_most) > (1.0 + bearable) * std::abs(most);
  }
};

Peak peak_of(const RunSummary& summary, const FractureCase& fracture, const Axes& axes) {
  const Headlines& f = *summary.figures;
  if (!fracture.box)
    return {f.peak_force, f.displacement_at_peak, f.final_force, f.final_displacement, f.peak_force_at_most};
  return {
      summary.other_figure(fmt::format("peak_{}_Pa", axes.y)), summary.other_figure(fmt::format("{}_at_peak", axes.x)),
      summary.other_figure(fmt::format("final_{}_Pa", axes.y)), summary.other_figure(fmt::format("final_{}", axes.x))};
}

bool moves_freely(const FractureCase& fracture) {
  return !fracture.box && !acts_on(fracture.output.curve.patch, fracture.boundary);
}

/// "of "ymax" along x at the end 0.06 mm; it is free"; `end`: "at the end", with or without the value.
std::string of_free_patch(const FractureCase& fracture, const std::string& end) {
  return fmt::format("of \"{}\" along {} {}; it is free", fracture.output.curve.patch,
                     "xyz"[fracture.output.curve.component], end);
}

/// "greatest force 27.08 N at 624 um, the end of the curve"
std::vector<std::string> lines_of_curve(const RunSummary& summary, const FractureCase& fracture,
                                        const CurveUnits& units) {
  if (!summary.figures) return {};
  if (moves_freely(fracture))
    return {"displacement " +
            of_free_patch(fracture, "at the end " + shown_in(units.displacement, summary.figures->final_displacement))};
  const Axes axes = axes_of(fracture, units);
  const Peak peak = peak_of(summary, fracture, axes);
  const std::string x = fracture.box ? axes.x + " = " : std::string();
  std::string line = fmt::format("greatest {} {} at {}{}", axes.y_words, shown_in(axes.y_shown, peak.most), x,
                                 shown_in(axes.x_shown, peak.at));
  if (peak.is_end()) return {line + ", the end of the curve: it still rises there"};
  if (peak.is_coarse())
    line += fmt::format(
        ", with shorter steps up to {} ([loading] {})", shown_in(axes.y_shown, peak.at_most),
        std::isfinite(fracture.loading.energy_release) ? "a smaller finest_increment" : "energy_release = 0.05");
  return {fmt::format("{}; {} at the end, {}{}", line, shown_in(axes.y_shown, peak.last), x,
                      shown_in(axes.x_shown, peak.end))};
}

/// Of a surface whose law is extracted, not given; none where it was never damaged.
const nlohmann::ordered_json* strongest_law(const nlohmann::ordered_json& surface) {
  if (surface.at("law_is_given").get<bool>()) return nullptr;
  const nlohmann::ordered_json* strongest = nullptr;
  for (const auto& law : surface.at("laws"))
    if (number_of(law.at("strength_Pa")) > 0.0 &&
        (strongest == nullptr || number_of(law.at("strength_Pa")) > number_of(strongest->at("strength_Pa"))))
      strongest = &law;
  return strongest;
}

/// Of the largest traction; next to nothing, against energy over strength, is what is left of a zero.
std::string critical_separation(const nlohmann::ordered_json& law) {
  constexpr double nothing = 1e-9;
  const double separation = number_of(law.at("critical_separation_m"));
  const double reach = number_of(law.at("surface_energy_J_per_m2")) / number_of(law.at("strength_Pa"));
  return std::abs(separation) < nothing * reach ? "0" : shown_in({.si_unit = "m"}, separation);
}

/// What is not known of a law, with what stands before it; empty where it was followed down to a tenth.
std::string unknown_of_law(const nlohmann::ordered_json& law) {
  if (law.at("traced").get<bool>()) return {};
  if (!law.at("jump_at_step").is_null())
    return "; the traction falls within one step, so that how it softens is not known";
  const double last = number_of(law.at("final_traction_Pa"));
  if (last < 0.1 * number_of(law.at("strength_Pa")))
    return "; the surface closes again, so that how it softens is not known";
  return fmt::format("; {} act at the end, so that its last part is not known and the energy a lower bound",
                     shown_in({.si_unit = "Pa"}, last));
}

/// " at the lower pole", " at polar angles of 75 to 90 degrees"; nothing of a flat surface, whose law is that of all
/// places.
std::string place_of_law(const nlohmann::ordered_json& surface, const nlohmann::ordered_json& law, const Vector& axis) {
  if (surface.value("is_flat", surface.at("kind") != "interface")) return {};
  const double from = number_of(law.at("polar_angle_from_deg")), to = number_of(law.at("polar_angle_to_deg"));
  if (from == 0.0 || to == 180.0) return " at the " + name_of_pole(from == 0.0, axis);
  return fmt::format(" at polar angles of {:.0f} to {:.0f} degrees", from, to);
}

std::string line_of_law(const nlohmann::ordered_json& surface, const nlohmann::ordered_json& law, const Vector& axis) {
  const auto number = [&](const char* key) { return number_of(law.at(key)); };
  return fmt::format("law of \"{}\"{}: largest normal traction {} at a separation of {}, surface energy {}{}",
                     surface.at("name").get<std::string>(), place_of_law(surface, law, axis),
                     shown_in({.si_unit = "Pa"}, number("strength_Pa")), critical_separation(law),
                     quantity_text(number("surface_energy_J_per_m2"), "J/m^2"), unknown_of_law(law));
}

/// What `of` says of each surface of cohesive.json that has an extracted law, and of the strongest of these; none if
/// there is no such file.
template <class T, class Of>
std::vector<T> of_laws(const fs::path& results, const Of& of) {
  const fs::path file = results / "cohesive.json";
  if (!fs::exists(file)) return {};
  return read_json(file, "file of cohesive laws", [&](const nlohmann::ordered_json& json) {
    std::vector<T> all;
    for (const auto& surface : json.at("surfaces"))
      if (const auto* law = strongest_law(surface)) all.push_back(of(surface, *law));
    return all;
  });
}

/// Of the surfaces whose laws are extracted, not given.
std::vector<std::string> lines_of_laws(const fs::path& results, const Vector& axis) {
  return of_laws<std::string>(results,
                              [&](const auto& surface, const auto& law) { return line_of_law(surface, law, axis); });
}

HeadFigure figure_of_law(const nlohmann::ordered_json& surface, const nlohmann::ordered_json& law, const Vector& axis) {
  const auto number = [&](const char* key) { return number_of(law.at(key)); };
  return HeadFigure{
      .label = fmt::format("Strength of \"{}\"", surface.at("name").get<std::string>()),
      .value = shown_in({.si_unit = "Pa"}, number("strength_Pa")),
      .note = fmt::format("largest normal traction{}, at a separation of {}; surface energy {}{}",
                          place_of_law(surface, law, axis), critical_separation(law),
                          quantity_text(number("surface_energy_J_per_m2"), "J/m^2"), unknown_of_law(law))};
}

/// "the lower pole", or "polar angles of 40 to 70 degrees".
std::string place_of_first_debonding(const RunSummary& summary, const FractureCase& fracture) {
  const double from = summary.other_figure("first_debonding_polar_angle_from_deg"),
               to = summary.other_figure("first_debonding_polar_angle_to_deg");
  if (const auto pole = pole_of(from * degree, to * degree, fracture.cohesive.axis)) return "the " + *pole;
  return fmt::format("polar angles of {:.0f} to {:.0f} degrees", from, to);
}

}  // namespace

std::string first_debonding_words(const RunSummary& summary, const FractureCase& fracture, const CurveUnits& units) {
  const Axes axes = axes_of(fracture, units);
  const auto figure = [&](const std::string& name) { return summary.other_figure("first_debonding_" + name); };
  const double from = figure(axes.x + axes.x_unit), to = figure(axes.x + "_after" + axes.x_unit);
  if (!std::isfinite(from) || !std::isfinite(to)) return {};
  std::string words = fmt::format(
      "between {}{}, where the {} goes from {}", fracture.box ? axes.x + " = " : "",
      two_shown_in(axes.x_shown, from, "and", to), axes.y_words,
      two_shown_in(axes.y_shown, figure(axes.y + axes.y_unit), "to", figure(axes.y + "_after" + axes.y_unit)));
  if (const double angle = figure("angle_deg"); std::isfinite(angle))
    words += fmt::format(", at {}; debonding angle {:.0f} degrees", place_of_first_debonding(summary, fracture), angle);
  return words;
}

std::vector<std::vector<std::string>> first_debonding_rows(const RunSummary& summary, const FractureCase& fracture) {
  const Axes axes = axes_of(fracture, {});
  const auto figure = [&](const std::string& name) { return summary.other_figure("first_debonding_" + name); };
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

std::map<std::string, double> figures_of_laws(const fs::path& results) {
  using Figures = std::pair<double, double>;
  const auto laws = of_laws<Figures>(results, [](const auto&, const auto& law) {
    return Figures(number_of(law.at("strength_Pa")), number_of(law.at("surface_energy_J_per_m2")));
  });
  if (laws.empty()) return {};
  const auto [strength, energy] = std::ranges::max(laws);
  return {{"cohesive_strength_Pa", strength}, {"cohesive_energy_J_per_m2", energy}};
}

std::vector<std::string> what_happened(const FractureCase& fracture, const CaseFile& file, const RunSummary& summary,
                                       const fs::path& results) {
  const CurveUnits units = read_curve_units(file, fracture.output.curve);
  const auto surface = summary.other_texts.find("first_debonding_surface");
  const bool has_debonded = surface != summary.other_texts.end();
  std::vector<std::string> lines;
  if (const auto heat = figure_of_hottest_place(fracture, summary))
    lines.push_back(fmt::format("greatest temperature rise {} {}", heat->value, heat->note));
  if (has_debonded) {
    lines.push_back(
        fmt::format("first debonding of \"{}\" {}", surface->second, first_debonding_words(summary, fracture, units)));
    std::string rest = fracture.box ? "" : rest_of_debonding(surface->second, fracture.cohesive.axis, units, results);
    if (!rest.empty()) lines.push_back(std::move(rest));
  }
  for (std::string& line : lines_of_curve(summary, fracture, units)) lines.push_back(std::move(line));
  if (!has_debonded && summary.other_figures.contains("first_debonding_load"))
    lines.emplace_back("no debonding: every surface holds");
  for (std::string& line : lines_of_laws(results, fracture.cohesive.axis)) lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> as_sentences(std::vector<std::string> lines) {
  for (std::string& line : lines) {
    line.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(line.front())));
    line += ".";
  }
  return lines;
}

std::vector<HeadFigure> run_figures(const FractureCase& fracture, const CurveUnits& units, const RunSummary& summary,
                                    const fs::path& results) {
  std::vector<HeadFigure> figures;
  const Axes axes = axes_of(fracture, units);
  const auto debonding = [&](const std::string& name) { return summary.other_figure("first_debonding_" + name); };
  const double from = debonding(axes.x + axes.x_unit), to = debonding(axes.x + "_after" + axes.x_unit);
  const auto surface = summary.other_texts.find("first_debonding_surface");
  if (auto heat = figure_of_hottest_place(fracture, summary)) figures.push_back(std::move(*heat));
  if (std::isfinite(from) && std::isfinite(to)) {
    std::string note = fmt::format(
        "{} from {}", axes.y_words,
        two_shown_in(axes.y_shown, debonding(axes.y + axes.y_unit), "to", debonding(axes.y + "_after" + axes.y_unit)));
    if (std::isfinite(debonding("angle_deg")))
      note = fmt::format("at {}; {}", place_of_first_debonding(summary, fracture), note);
    figures.push_back({.label = fmt::format("First debonding of \"{}\"",
                                            surface == summary.other_texts.end() ? std::string() : surface->second),
                       .value = two_shown_in(axes.x_shown, from, "to", to),
                       .note = std::move(note)});
  } else if (summary.other_figures.contains("first_debonding_load")) {
    figures.push_back({.label = "Debonding", .value = "none", .note = "every surface holds"});
  }
  if (summary.figures && moves_freely(fracture)) {
    figures.push_back({.label = "Displacement",
                       .value = shown_in(axes.x_shown, summary.figures->final_displacement),
                       .note = of_free_patch(fracture, "at the end")});
  } else if (summary.figures) {
    const Peak peak = peak_of(summary, fracture, axes);
    figures.push_back(
        {.label = fmt::format("Greatest {}", axes.y_words),
         .value = shown_in(axes.y_shown, peak.most),
         .note = fmt::format("at {}{}", fracture.box ? axes.x + " = " : "", shown_in(axes.x_shown, peak.at)) +
                 (peak.is_end() ? ", the end of the curve" : "") +
                 (peak.is_coarse() ? fmt::format(", with shorter steps up to {}", shown_in(axes.y_shown, peak.at_most))
                                   : "")});
  }
  const auto of_law = [&](const auto& on, const auto& law) { return figure_of_law(on, law, fracture.cohesive.axis); };
  for (HeadFigure& law : of_laws<HeadFigure>(results, of_law)) figures.push_back(std::move(law));
  figures.push_back(
      {.label = "Run",
       .value = summary.status,
       .note = fmt::format("{} steps of {} cells in {} on {} thread{}", summary.steps, summary.cells,
                           duration_words(summary.wall_seconds), summary.threads, summary.threads == 1 ? "" : "s")});
  for (HeadFigure& figure : figures) {
    figure.value = in_print(std::move(figure.value));
    figure.note = in_print(std::move(figure.note));
  }
  return figures;
}

}  // namespace pfdm
