#include "cases/program/homogenization/homogenization_report.h"

#include "cases/program/homogenization/homogenized_results.h"
#include "cases/program/session/report_parts.h"
#include "physics/error.h"
#include "postproc/curves/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Table stiffness_table(const Json& json) {
  const auto rows = json.at("stiffness_Pa").get<std::vector<std::vector<double>>>();
  double largest = 0.0;
  for (const auto& row : rows)
    for (const double value : row) largest = std::max(largest, std::abs(value));
  const DisplayUnit unit = display_unit(largest, "Pa");
  Table table{.caption = fmt::format("Stiffness [{}] (Voigt)", unit.name), .rows = {{""}}, .has_header = true};
  for (const auto& name : json.at("components")) table.rows[0].push_back(name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table.rows.push_back({table.rows[0][i + 1]});
    for (const double value : rows[i]) table.rows.back().push_back(fmt::format("{:.4g}", unit.factor * value));
  }
  return table;
}

Table moduli_table(const Json& json) {
  const Json& closest = json.at("isotropic");
  const auto number = [](const Json& value) { return value.get<double>(); };
  Table table{.caption = fmt::format("Closest isotropic material, {}", json.at("boundary").get<std::string>()),
              .rows = {{"Young's modulus", shown(number(closest.at("young_modulus_Pa")), "Pa")},
                       {"Poisson's ratio", shown(number(closest.at("poisson_ratio")))},
                       {"bulk modulus", shown(number(closest.at("bulk_modulus_Pa")), "Pa")},
                       {"shear modulus", shown(number(closest.at("shear_modulus_Pa")), "Pa")},
                       {"anisotropy", fmt::format("{:.2g} %", 100.0 * number(closest.at("anisotropy")))}}};
  if (json.contains("density_kg_per_m3"))
    table.rows.push_back({"density", shown(number(json.at("density_kg_per_m3"))) + " kg/m³"});
  if (const double loss = number(json.at("loss_factors").at("young_modulus")); loss > 0.0)
    table.rows.push_back({"loss factor of E", shown(loss)});
  return table;
}

Table bounds_table(const Json& bounds) {
  Table table{.caption = "Bounds of isotropic composites", .rows = {{"", "K", "G"}}, .has_header = true};
  for (const auto& [key, end, text] :
       {std::tuple("reuss_voigt", "lower", "Reuss"), std::tuple("hashin_shtrikman", "lower", "Hashin-Shtrikman, lower"),
        std::tuple("hashin_shtrikman", "upper", "Hashin-Shtrikman, upper"),
        std::tuple("reuss_voigt", "upper", "Voigt")}) {
    const Json& pair = bounds.at(key);
    const auto of = [&pair, side = end](const char* modulus) {
      return shown(pair.at(fmt::format("{}_modulus_{}_Pa", modulus, side)).get<double>(), "Pa");
    };
    table.rows.push_back({text, of("bulk"), of("shear")});
  }
  return table;
}

Table phases_table(const Json& json) {
  Table table{.caption = "Materials", .rows = {{"", "of the volume", "of the energy"}}, .has_header = true};
  for (const Json& phase : json.at("phases"))
    table.rows.push_back({phase.at("material"), shown(phase.at("volume_fraction").get<double>()),
                          shown(phase.at("energy_share").get<double>())});
  return table;
}

Table errors_table(const Json& json, const RunSummary& summary) {
  const Json& errors = json.at("errors");
  const auto of = [&](const char* name) { return fmt::format("{:.2g}", errors.at(name).get<double>()); };
  return {.caption = "Run",
          .rows = {{"cells, unknowns", fmt::format("{}, {}", summary.cells, summary.unknowns)},
                   {"energies against mean stresses", of("energy_difference")},
                   {"asymmetry of the stiffness", of("stiffness_asymmetry")},
                   {"cells' mean strains against mean stresses", of("constitutive_difference")},
                   {"residual", of("residual")},
                   {"time", fmt::format("{:.3g} s wall", summary.wall_seconds)}}};
}

}  // namespace

ReportPage homogenization_page(const std::string& title, const std::string& name, const std::string& hash,
                               const std::filesystem::path& results) {
  const auto stored = find_of_case(results / homogenized_file, hash, read_homogenized);
  const auto summary = find_of_case(results / summary_file, hash, read_run_summary);
  if (!stored || !summary)
    throw InputError(fmt::format("{}: there are no results; pfdm run makes them", results.string()));
  const Json& json = stored->json;
  ReportPage page{.title = fmt::format("{}: {}", name, title),
                  .subtitle = fmt::format("pfdm {}, case {}, run {}", summary->version, hash, summary->status),
                  .rows = {{.blocks = {moduli_table(json), phases_table(json)}}, {.blocks = {stiffness_table(json)}}}};
  PageRow last{.blocks = {errors_table(json, *summary)}};
  if (json.contains("bounds")) last.blocks.emplace_back(bounds_table(json.at("bounds")));
  page.rows.push_back(std::move(last));
  for (PageRow& row : warnings_row(results / "run.log")) page.rows.push_back(std::move(row));
  return page;
}

std::string headline_of_composite(const std::filesystem::path& results) {
  const Json closest = read_homogenized(results / homogenized_file).json.at("isotropic");
  const auto number = [&](const char* key) { return closest.at(key).get<double>(); };
  return fmt::format("As stiff as an isotropic material of E = {} and ν = {}; anisotropy {:.2g} %.",
                     shown(number("young_modulus_Pa"), "Pa"), shown(number("poisson_ratio")),
                     100.0 * number("anisotropy"));
}

}  // namespace pfdm
