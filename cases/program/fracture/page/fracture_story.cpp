#include "cases/program/fracture/page/fracture_story.h"

#include "cases/program/fracture/outcome/end_of_run.h"
#include "cases/program/session/report_parts.h"
#include "physics/interfaces/traction_separation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

std::string law_text(const InterfaceSettings& interface) {
  const auto value = [](const Parameter& parameter, const auto& show) {
    return parameter.varies ? std::string("varying") : show(parameter.at(Vector::Zero()));
  };
  return fmt::format("{}, {}, {}", interface.law.law->name,
                     value(interface.strength, [](double v) { return shown(v, "Pa"); }),
                     value(interface.toughness, [](double v) { return shown(v) + " J/m²"; }));
}

std::string seconds_by_stage(const std::map<std::string, double>& stages) {
  std::vector<std::string> parts;
  for (const auto& [stage, seconds] : stages) {
    std::string name = stage;
    std::ranges::replace(name, '_', ' ');
    parts.push_back(fmt::format("{} {}", name, shown_seconds(seconds)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// What can break: a phase field where some region can be damaged, and interfaces with their laws.
void add_model(const FractureCase& fracture, Table& table) {
  const FractureModel& model = fracture.model;
  const bool has_damage = std::ranges::any_of(fracture.materials.by_region, [](const RegionMaterial& m) {
    return m.varies || m.at(Vector::Zero()).damageable;
  });
  if (has_damage) {
    table.rows.push_back(
        {"fracture", fmt::format("{}{}, degradation {}", model.crack->name,
                                 model.has_strength() ? " with a strength surface" : "", model.degradation.name())});
    table.rows.push_back({"split", std::string(model.split.name())});
  }
  for (const InterfaceSettings& interface : fracture.interfaces)
    table.rows.push_back({fmt::format("interface {}", interface.name), law_text(interface)});
  if (table.rows.empty()) table.rows.push_back({"fracture", "none: nothing can break"});
}

}  // namespace

Table run_table(const FractureStory& story) {
  Table table{.caption = "Model and run", .rows = {}};
  add_model(story.fracture, table);
  const auto add = [&](std::string name, std::string value) {
    table.rows.push_back({std::move(name), std::move(value)});
  };
  if (!story.summary) {
    add("status", fmt::format("not finished, step {}", story.curve.back().step));
    return table;
  }
  const RunSummary& s = *story.summary;
  add("cells, unknowns", fmt::format("{}, {}", s.cells, s.unknowns));
  add("steps, staggered iterations", fmt::format("{}, {}", s.steps, s.staggered_iterations));
  add("linear iterations", fmt::format("{}", s.krylov_iterations));
  add("time, threads",
      fmt::format("{} s wall, {} s CPU, {}", shown_seconds(s.wall_seconds), shown_seconds(s.cpu_seconds), s.threads));
  add("wall by stage [s]", seconds_by_stage(s.wall_seconds_by_stage));
  add("CPU by stage [s]", seconds_by_stage(s.cpu_seconds_by_stage));
  add("peak memory", fmt::format("{:.0f} MB", 1e-6 * s.peak_memory));
  return table;
}

Table figures_table(const FractureStory& story) {
  const Headlines f = headlines(story.curve, story.component());
  const bool at_end = f.displacement_at_peak == f.final_displacement && f.peak_force == f.final_force;
  Table table{.caption = "Figures",
              .rows = {{at_end ? "peak force, at the end" : "peak force", shown(f.peak_force, "N")},
                       {"its displacement", shown(f.displacement_at_peak, "m")},
                       {"stiffness of the first step", shown(f.initial_stiffness, "N") + "/m"},
                       {"final force", shown(f.final_force, "N")},
                       {"final displacement", shown(f.final_displacement, "m")}}};
  if (story.summary)
    for (std::vector<std::string>& row : first_debonding_rows(*story.summary, story.fracture))
      table.rows.push_back(std::move(row));
  constexpr std::size_t n_always = 3;  // energies that are shown if they are zero, too
  const auto add = [&](std::string_view what, std::string value) {
    table.rows.push_back({std::string(what), std::move(value)});
  };
  for (const EnergyEntry& entry : energy_entries)
    if (&entry < energy_entries + n_always || f.energy.*entry.value != 0.0)
      add(entry.label, shown(f.energy.*entry.value, "J"));
  add("energy balance error", fmt::format("{:.3g} %", 100.0 * f.energy_balance_error));
  add("largest release", shown(f.released_energy, "J"));
  add("its displacement", shown(f.displacement_at_release, "m"));
  add("damaged volume", shown(f.damaged_volume, "m^3"));
  return table;
}

Table material_table(const FractureCase& fracture) {
  const auto& regions = fracture.materials.by_region;
  const bool corrects = std::ranges::any_of(regions, [](const auto& m) { return m.given_toughness.has_value(); });
  Table table{.caption = "Materials", .rows = {{"region", "E", "nu", "Gc [J/m²]", "ell"}}, .has_header = true};
  if (corrects) table.rows.front().insert(table.rows.front().end() - 1, "in its band");
  for (const RegionMaterial& material : regions) {
    std::vector<std::string> row;
    if (material.varies) {
      row = {material.region, "varies", "from", "place", "to place"};
    } else {
      const RegionModel m = material.at(Vector::Zero());
      row = {material.region, shown(m.elasticity.young_modulus(), "Pa"), shown(m.elasticity.poisson_ratio()),
             m.damageable ? shown(material.given_toughness.value_or(m.Gc)) : "no damage",
             m.damageable ? shown(m.ell, "m") : "-"};
      if (corrects) row.insert(row.end() - 1, material.given_toughness ? shown(m.Gc) : "-");
    }
    row.resize(table.rows.front().size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace pfdm
