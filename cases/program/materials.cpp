#include "cases/program/materials.h"

#include "physics/interface_toughness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace pfdm {
namespace {

constexpr Range poisson_range{-1.0, 0.5, true, "between -1 and 0.5"};

/// What a material or a region's override may say.
struct MaterialKeys {
  std::optional<double> young_modulus, poisson_ratio, toughness, strength, length;
  std::optional<bool> damageable;
};

std::optional<double> find_quantity(const ConfigTable& table, std::string_view key, const Dimension& due) {
  const auto value = table.find(key);
  return value ? std::optional(value->quantity(due, range::positive)) : std::nullopt;
}

MaterialKeys read_keys(const ConfigTable& table) {
  MaterialKeys keys;
  keys.young_modulus = find_quantity(table, "young_modulus", dimension::stress);
  if (const auto value = table.find("poisson_ratio")) keys.poisson_ratio = value->number(poisson_range);
  keys.toughness = find_quantity(table, "toughness", dimension::toughness);
  keys.strength = find_quantity(table, "strength", dimension::stress);
  keys.length = find_quantity(table, "length", dimension::length);
  if (const auto value = table.find("damageable")) keys.damageable = value->boolean();
  return keys;
}

MaterialKeys overridden(MaterialKeys base, const MaterialKeys& by) {
  if (by.young_modulus) base.young_modulus = by.young_modulus;
  if (by.poisson_ratio) base.poisson_ratio = by.poisson_ratio;
  if (by.toughness) base.toughness = by.toughness;
  if (by.strength) base.strength = by.strength;
  if (by.length) base.length = by.length;
  if (by.damageable) base.damageable = by.damageable;
  return base;
}

// Strength and toughness make the coefficients of the degradation.
RationalCoefficients make_coefficients(const MaterialKeys& keys, const RegionModel& model, const std::string& region,
                                       const SofteningLaw& law, const ConfigTable& table) {
  if (!keys.strength)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no strength (ft), which the softening law "
                    "\"{}\" needs; give strength, as in \"{}\", or damageable = false",
                    region, law.name, dimension::stress.example));
  const double E = model.elasticity.young_modulus(), longest = longest_length(law, E, model.Gc, *keys.strength);
  if (model.ell > longest)
    throw table.error(
        fmt::format("region \"{}\": the length (ell) is {:.4g} m; with this strength and toughness the "
                    "\"{}\" law needs one of at most {:.4g} m",
                    region, model.ell, law.name, longest));
  return rational_coefficients(law, E, model.Gc, *keys.strength, model.ell);
}

RegionModel make_model(const MaterialKeys& keys, const std::string& region, const MaterialDefaults& defaults,
                       const ConfigTable& table) {
  RegionModel model;
  model.elasticity = from_young_poisson(*keys.young_modulus, *keys.poisson_ratio);
  model.damageable = keys.damageable.value_or(true);
  model.Gc = keys.toughness.value_or(0.0);
  model.ell = keys.length.value_or(defaults.ell.value_or(0.0));
  if (!model.damageable) return model;
  if (!keys.toughness)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no toughness (Gc); give toughness, as in "
                    "\"{}\", or damageable = false",
                    region, dimension::toughness.example));
  if (model.ell == 0.0)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no length (ell); give it in [fracture] or "
                    "here, as in \"10 um\"",
                    region));
  if (defaults.softening != nullptr)
    model.rational = make_coefficients(keys, model, region, *defaults.softening, table);
  return model;
}

struct RegionOverride {
  std::string region;
  ConfigValue value;
  MaterialKeys keys;
  std::optional<Band> band;  // where the file tells what the mesh generator does not
  bool used = false;
};

std::optional<Band> read_band(const std::string& region, const ConfigTable& table) {
  if (!table.has("band")) return std::nullopt;
  const ConfigTable band = table.table("band");
  const std::vector<ConfigValue> between = band.at("between").list(2);
  return Band{
      region, band.quantity("width", dimension::length, range::positive), {between[0].string(), between[1].string()}};
}

std::vector<RegionOverride> read_overrides(const ConfigTable& root) {
  std::vector<RegionOverride> overrides;
  if (!root.has("regions")) return overrides;
  for (const auto& [name, value] : root.table("regions").entries())
    overrides.push_back({name, value, read_keys(value.table()), read_band(name, value.table())});
  return overrides;
}

// A region with what its material and its override say of it.
struct RegionKeys {
  std::string region;
  ConfigValue where;
  ConfigTable table;  // of the material
  MaterialKeys keys;
};

RegionKeys read_region(const ConfigValue& where, const ConfigTable& table, const MaterialKeys& base,
                       std::vector<RegionOverride>& overrides) {
  RegionKeys entry{where.string(), where, table, base};
  for (RegionOverride& over : overrides)
    if (over.region == entry.region) {
      entry.keys = overridden(entry.keys, over.keys);
      over.used = true;
    }
  return entry;
}

RegionKeys* find_region(std::vector<RegionKeys>& regions, const std::string& name) {
  const auto found = std::find_if(regions.begin(), regions.end(), [&](const auto& r) { return r.region == name; });
  return found == regions.end() ? nullptr : &*found;
}

void read_material(Materials& materials, const std::string& name, const ConfigTable& table,
                   std::vector<RegionOverride>& overrides, std::vector<RegionKeys>& regions) {
  table.quantity("young_modulus", dimension::stress, range::positive);
  table.number("poisson_ratio", poisson_range);
  const MaterialKeys base = read_keys(table);
  materials.by_name.push_back({name, from_young_poisson(*base.young_modulus, *base.poisson_ratio)});
  for (const ConfigValue& where : table.at("regions").list()) {
    const std::string region = where.string();
    if (find_region(regions, region) != nullptr)
      throw where.error(fmt::format("region \"{}\" already has a material", region));
    regions.push_back(read_region(where, table, base, overrides));
  }
}

BandNeighbour neighbour(const RegionKeys& region) {
  if (!region.keys.damageable.value_or(true)) return {std::numeric_limits<double>::infinity()};
  return {region.keys.toughness.value_or(0.0)};
}

// Replaces the toughness of a band by the one with which a crack in it dissipates what was given.
void correct_toughness(const Band& band, std::vector<RegionKeys>& regions, const MaterialDefaults& defaults,
                       std::vector<std::string>& remarks) {
  RegionKeys* const found = find_region(regions, band.region);
  const RegionKeys *one = find_region(regions, band.neighbours[0]), *other = find_region(regions, band.neighbours[1]);
  if (found == nullptr || one == nullptr || other == nullptr)
    throw InputError(fmt::format("the band \"{}\" lies between \"{}\" and \"{}\", and one of the three has no material",
                                 band.region, band.neighbours[0], band.neighbours[1]));
  MaterialKeys& keys = found->keys;
  const double ell = keys.length.value_or(defaults.ell.value_or(0.0));
  const BandNeighbour left = neighbour(*one), right = neighbour(*other);
  if (!keys.damageable.value_or(true) || !keys.toughness || ell == 0.0 || left.Gc == 0.0 || right.Gc == 0.0) return;
  const double given = *keys.toughness;
  const std::string band_words = fmt::format("region \"{}\" ({:.4g} m wide, ell = {:.4g} m) between \"{}\" and \"{}\"",
                                             band.region, band.width, ell, band.neighbours[0], band.neighbours[1]);
  if (!defaults.corrects_toughness) {
    const double apparent = apparent_toughness(*defaults.crack, given, band.width, ell, left, right);
    remarks.push_back(fmt::format("{}: toughness {:.6g} J/m^2 as given; a crack at its middle will dissipate {:.6g}",
                                  band_words, given, apparent));
    return;
  }
  keys.toughness = band_toughness(*defaults.crack, given, band.width, ell, left, right);
  remarks.push_back(fmt::format("{}: toughness {:.6g} J/m^2, so that a crack at its middle dissipates the {:.6g} given",
                                band_words, *keys.toughness, given));
}

}  // namespace

const IsotropicElasticity& Materials::elasticity(const ConfigValue& name) const {
  std::vector<std::string> names;
  for (const NamedElasticity& material : by_name) names.push_back(material.material);
  const std::string wanted = name.one_of(names, "material");
  return std::find_if(by_name.begin(), by_name.end(), [&](const auto& m) { return m.material == wanted; })->elasticity;
}

Materials read_materials(const ConfigTable& root, const MaterialDefaults& defaults) {
  Materials materials;
  std::vector<RegionOverride> overrides = read_overrides(root);
  std::vector<RegionKeys> regions;
  for (const auto& [name, value] : root.table("materials").entries())
    read_material(materials, name, value.table(), overrides, regions);
  for (const RegionOverride& over : overrides)
    if (!over.used)
      throw over.value.error(
          fmt::format("region \"{}\" has no material; name it in some material's regions", over.region));
  materials.bands = defaults.bands;
  for (const RegionOverride& over : overrides)
    if (over.band) materials.bands.push_back(*over.band);
  for (const Band& band : materials.bands) correct_toughness(band, regions, defaults, materials.remarks);
  for (const RegionKeys& entry : regions)
    materials.by_region.push_back(
        {entry.region, make_model(entry.keys, entry.region, defaults, entry.table), entry.where});
  return materials;
}

std::vector<RegionModel> models_of_regions(const Materials& materials, std::span<const std::string> regions) {
  const auto& given = materials.by_region;
  for (const RegionMaterial& entry : given) entry.where.one_of(regions, "region of the mesh");
  std::vector<RegionModel> models;
  for (const std::string& region : regions) {
    const auto found = std::find_if(given.begin(), given.end(), [&](const auto& m) { return m.region == region; });
    if (found == given.end())
      throw InputError(
          fmt::format("{}: region \"{}\" of the mesh has no material; name it in the regions of one of "
                      "[materials.*]",
                      given.empty() ? "case.toml" : given.front().where.file(), region));
    models.push_back(found->model);
  }
  return models;
}

}  // namespace pfdm
