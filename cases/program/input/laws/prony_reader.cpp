#include "cases/program/input/laws/prony_reader.h"

#include "cases/program/input/laws/temperature_shift_reader.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfdm {
namespace {

std::vector<PronyBranch> read_branches(const ConfigTable& material, std::string_view key) {
  std::vector<PronyBranch> branches;
  if (!material.has(key)) return branches;
  for (const ConfigTable& branch : material.tables(key))
    branches.push_back({branch.quantity("modulus"), branch.quantity("time")});
  return branches;
}

/// "12.5 ms", "40 s".
std::string time_text(double time, int digits) {
  const ScaledUnit unit = scaled_seconds(time);
  return fmt::format("{:.{}g} {}", unit.factor * time, digits, unit.name);
}

std::string branches_toml(std::string_view key, const std::vector<PronyBranch>& branches, int digits) {
  if (branches.empty()) return "";
  std::vector<std::string> rows;
  for (const auto& [modulus, time] : branches)
    rows.push_back(fmt::format("  {{ modulus = \"{}\", time = \"{}\" }},\n", quantity_text(modulus, "Pa", digits),
                               time_text(time, digits)));
  return fmt::format("{} = [\n{}]\n", key, fmt::join(rows, ""));
}

}  // namespace

std::vector<PronyBranch> read_shear_branches(const ConfigTable& material) {
  return read_branches(material, "shear_branches");
}

std::vector<PronyBranch> read_bulk_branches(const ConfigTable& material) {
  return read_branches(material, "bulk_branches");
}

PronyLaw read_prony_series(const ConfigTable& material) {
  return {.relaxed = from_young_poisson(material.quantity("young_modulus"), material.number("poisson_ratio")),
          .shear = read_shear_branches(material),
          .bulk = read_bulk_branches(material),
          .shift = read_temperature_shift(material)};
}

std::string to_toml(const PronyLaw& law, int digits) {
  return fmt::format("young_modulus = \"{}\"\npoisson_ratio = {:.{}g}\n",
                     quantity_text(law.relaxed.young_modulus(), "Pa", digits), law.relaxed.poisson_ratio(), digits) +
         branches_toml("shear_branches", law.shear, digits) + branches_toml("bulk_branches", law.bulk, digits) +
         (law.shift ? to_toml(*law.shift, digits) : "");
}

}  // namespace pfdm
