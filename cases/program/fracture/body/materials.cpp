#include "cases/program/fracture/body/materials.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/material_keys.h"
#include "cases/program/fracture/body/material_laws.h"
#include "cases/program/fracture/body/region_model.h"
#include "cases/program/input/config/path_reader.h"
#include "physics/interfaces/interface_toughness.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

namespace pfdm {
namespace {

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
  table.in_context([&] { return require_plain_name(region, "a folder"), true; });
  return Band{region, band.quantity("width"), {between[0].string(), between[1].string()}};
}

std::vector<RegionOverride> read_overrides(const ConfigTable& root, bool loads_from_start) {
  std::vector<RegionOverride> overrides;
  if (!root.has("regions")) return overrides;
  for (const auto& [name, value] : root.table("regions").entries()) {
    const ConfigTable table = value.table();
    overrides.push_back({name, value, read_keys(table, loads_from_start), read_band(name, table)});
  }
  return overrides;
}

// A region with what its material and its override say of it.
struct RegionKeys {
  std::string region;
  ConfigValue where;
  ConfigTable table;  // of the material
  MaterialKeys keys;
  std::optional<double> given_toughness{};  // before a correction; none where it varies [J/m^2]
};

// A history begins with the elasticity of its own table.
void refuse_other_elasticity(const RegionOverride& over, const MaterialKeys& base) {
  if (base.stiffness && !over.keys.stiffness && (over.keys.young_modulus || over.keys.poisson_ratio))
    throw over.value.error(fmt::format(
        "the elasticity of region \"{}\" depends on the direction; override it by another elasticity", over.region));
  if (base.material && (over.keys.young_modulus || over.keys.poisson_ratio))
    throw over.value.error(fmt::format(
        "the material of region \"{}\" has the law \"{}\", whose elasticity cannot be overridden; give it a "
        "material of its own",
        over.region, base.material->name()));
}

RegionKeys read_region(const ConfigValue& where, const ConfigTable& table, const MaterialKeys& base,
                       std::vector<RegionOverride>& overrides) {
  RegionKeys entry{where.string(), where, table, base};
  for (RegionOverride& over : overrides)
    if (over.region == entry.region) {
      refuse_other_elasticity(over, base);
      entry.keys = overridden(entry.keys, over.keys);
      over.used = true;
    }
  return entry;
}

RegionKeys* find_region(std::vector<RegionKeys>& regions, const std::string& name) {
  const auto found = std::find_if(regions.begin(), regions.end(), [&](const auto& r) { return r.region == name; });
  return found == regions.end() ? nullptr : &*found;
}

MaterialKeys read_own_keys(const ConfigTable& given, const MaterialDefaults& defaults) {
  if (defaults.elastic_keys != nullptr) return read_elastic_keys(given.with_keys(defaults.elastic_keys()));
  const MaterialLaw& law = law_of_material(given);
  const ConfigTable table = given.with_keys(material_keys(), law.name);
  if (!table.has("elasticity")) table.at("young_modulus"), table.at("poisson_ratio");
  MaterialKeys keys = read_keys(table, defaults.loads_from_start);
  if (keys.stiffness && (table.has("law") || table.has("kernel")))
    throw table.at("elasticity").error("elasticity that depends on the direction has no law besides");
  keys.material = law.read(table);
  return keys;
}

void read_material(Materials& materials, const std::string& name, const ConfigTable& table,
                   const MaterialDefaults& defaults, std::vector<RegionOverride>& overrides,
                   std::vector<RegionKeys>& regions) {
  const MaterialKeys base = read_own_keys(table, defaults);
  const bool varies = base.young_modulus->varies || base.poisson_ratio->varies || base.stiffness;
  const Vector anywhere = Vector::Zero();
  materials.by_name.push_back({name, varies ? std::nullopt
                                            : std::optional(from_young_poisson(base.young_modulus->at(anywhere),
                                                                               base.poisson_ratio->at(anywhere)))});
  for (const ConfigValue& where : table.at("regions").list()) {
    const std::string region = where.string();
    if (find_region(regions, region) != nullptr)
      throw where.error(fmt::format("region \"{}\" already has a material", region));
    regions.push_back(read_region(where, table, base, overrides));
  }
}

BandNeighbour neighbour(const MaterialKeys& keys, const Vector& x) {
  if (!keys.damageable.value_or(true)) return {std::numeric_limits<double>::infinity()};
  return {value_at(keys.toughness, x).value_or(0.0)};
}

// A band with what it needs to know of its neighbours.
struct BandToughness {
  const CrackGeometry* crack;
  double width;
  Parameter given, ell;
  MaterialKeys one, other;

  bool varies() const {
    const auto does = [](const MaterialKeys& keys) { return keys.toughness && keys.toughness->varies; };
    return given.varies || ell.varies || does(one) || does(other);
  }
  double corrected(const Vector& x) const {
    return band_toughness(*crack, given.at(x), width, ell.at(x), neighbour(one, x), neighbour(other, x));
  }
  double apparent(const Vector& x) const {
    return apparent_toughness(*crack, given.at(x), width, ell.at(x), neighbour(one, x), neighbour(other, x));
  }
};

bool lacks_toughness(const MaterialKeys& keys) { return keys.damageable.value_or(true) && !keys.toughness; }

std::string describe(const Band& band, const BandToughness& toughness, bool corrects) {
  const std::string between = fmt::format("between \"{}\" and \"{}\"", band.neighbours[0], band.neighbours[1]);
  const Vector anywhere = Vector::Zero();
  if (toughness.varies())
    return fmt::format("region \"{}\" ({} wide) {}: toughness varies, {}", band.region, quantity_text(band.width, "m"),
                       between, corrects ? "corrected in each cell for its neighbours" : "as given");
  const std::string words =
      fmt::format("region \"{}\" ({} wide, ell = {}) {}", band.region, quantity_text(band.width, "m"),
                  quantity_text(toughness.ell.at(anywhere), "m"), between);
  const double given = toughness.given.at(anywhere);
  if (!corrects)
    return fmt::format("{}: toughness {} as given; a crack at its middle will dissipate {}", words,
                       quantity_text(given, "J/m^2", 6), quantity_text(toughness.apparent(anywhere), "J/m^2", 6));
  return fmt::format("{}: toughness {}, so that a crack at its middle dissipates the {} given", words,
                     quantity_text(toughness.corrected(anywhere), "J/m^2", 6), quantity_text(given, "J/m^2", 6));
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
  if (!keys.damageable.value_or(true) || !keys.toughness || !(keys.length || defaults.ell)) return;
  if (lacks_toughness(one->keys) || lacks_toughness(other->keys)) return;
  const Parameter ell = keys.length ? *keys.length : Parameter{.at = [l = *defaults.ell](const Vector&) { return l; }};
  const BandToughness toughness{defaults.crack, band.width, *keys.toughness, ell, one->keys, other->keys};
  remarks.push_back(describe(band, toughness, defaults.corrects_toughness));
  if (!defaults.corrects_toughness) return;
  keys.toughness->varies = toughness.varies();
  if (!toughness.varies()) found->given_toughness = toughness.given.at(Vector::Zero());
  keys.toughness->at = [toughness](const Vector& x) { return toughness.corrected(x); };
}

// Whether a region has a strength that no law of damage takes.
bool has_idle_strength(const MaterialKeys& keys, const MaterialDefaults& defaults) {
  return keys.strength && keys.damageable.value_or(true) && defaults.strength.law == nullptr &&
         !keys.degradation.value_or(defaults.degradation).law().needs_strength;
}

// One for all regions of a degradation.
std::vector<std::string> idle_strengths(const std::vector<RegionKeys>& regions, const MaterialDefaults& defaults) {
  constexpr std::size_t most_named = 3;
  std::map<std::string, std::vector<std::string>> of_degradation;
  for (const RegionKeys& entry : regions)
    if (has_idle_strength(entry.keys, defaults))
      of_degradation[std::string(entry.keys.degradation.value_or(defaults.degradation).name())].push_back(
          fmt::format("\"{}\"", entry.region));
  std::vector<std::string> warnings;
  for (const auto& [degradation, of] : of_degradation)
    warnings.push_back(fmt::format(
        "strength of region{} {}{} changes nothing: the degradation \"{}\" has none (the model \"Wu\" and the model "
        "\"strength\" do)",
        of.size() == 1 ? "" : "s", fmt::join(of.begin(), of.begin() + std::min(of.size(), most_named), ", "),
        of.size() > most_named ? fmt::format(" and {} more", of.size() - most_named) : "", degradation));
  return warnings;
}

}  // namespace

const IsotropicElasticity& Materials::elasticity(const ConfigValue& name) const {
  std::vector<std::string> names;
  for (const NamedElasticity& material : by_name) names.push_back(material.material);
  const std::string wanted = name.one_of(names, "material");
  const auto found = std::ranges::find(by_name, wanted, &NamedElasticity::material);
  if (!found->elasticity)
    throw name.error(
        fmt::format("the elasticity of material \"{}\" varies; a uniform, isotropic one is required here", wanted));
  return *found->elasticity;
}

Materials read_materials(const ConfigTable& root, const MaterialDefaults& defaults) {
  Materials materials;
  std::vector<RegionOverride> overrides;
  if (defaults.elastic_keys == nullptr) overrides = read_overrides(root, defaults.loads_from_start);
  std::vector<RegionKeys> regions;
  for (const auto& [name, value] : root.table("materials").entries())
    read_material(materials, name, value.table(), defaults, overrides, regions);
  for (const RegionOverride& over : overrides)
    if (!over.used)
      throw over.value.error(
          fmt::format("region \"{}\" has no material; name it in some material's regions", over.region));
  materials.corrects_toughness = defaults.corrects_toughness;
  materials.bands = defaults.bands;
  for (const RegionOverride& over : overrides)
    if (over.band) materials.bands.push_back(*over.band);
  for (const Band& band : materials.bands) correct_toughness(band, regions, defaults, materials.remarks);
  if (defaults.elastic_keys == nullptr) materials.idle_keys = idle_strengths(regions, defaults);
  for (const RegionKeys& entry : regions) {
    const auto at = [entry, defaults](const Vector& x) {
      return region_model(entry.keys, entry.region, defaults, entry.table, x);
    };
    const bool varies = any_varies(entry.keys);
    if (!varies) at(Vector::Zero());  // what is wrong with it is wrong everywhere
    materials.by_region.push_back(
        {.region = entry.region,
         .where = entry.where,
         .at = at,
         .varies = varies,
         .elastic_law = fmt::format("{} | {} | {}", entry.keys.young_modulus->text, entry.keys.poisson_ratio->text,
                                    fmt::ptr(entry.keys.material.get())),
         .material = entry.keys.material,
         .split = entry.keys.split.value_or(EnergySplit()),
         .has_fatigue = entry.keys.fatigue && entry.keys.damageable.value_or(true),
         .given_toughness = entry.given_toughness});
  }
  return materials;
}

namespace {

const RegionMaterial& material_of(const Materials& materials, const std::string& region) {
  const auto& given = materials.by_region;
  const auto found = std::ranges::find(given, region, &RegionMaterial::region);
  if (found == given.end())
    throw InputError(
        fmt::format("{}: region \"{}\" of the mesh has no material; name it in the regions of one of "
                    "[materials.*]",
                    given.empty() ? "case.toml" : given.front().where.file(), region));
  return *found;
}

}  // namespace

void place_materials(const Materials& materials, const Mesh& mesh, FractureModel& model) {
  for (const RegionMaterial& entry : materials.by_region) entry.where.one_of(mesh.region_names, "region of the mesh");
  std::vector<const RegionMaterial*> of_region;
  for (const std::string& region : mesh.region_names) of_region.push_back(&material_of(materials, region));
  std::vector<Vector> example(of_region.size(), Vector::Zero());
  for (Index c = mesh.n_cells() - 1; c >= 0; --c) example[mesh.region[c]] = mesh.cell_centre[c];
  for (std::size_t r = 0; r < of_region.size(); ++r) {
    model.regions.push_back(of_region[r]->at(example[r]));
    // Regions of one law share an elastic zone: the example of the first one serves them all.
    const auto same = std::ranges::find_if(
        of_region, [&](const RegionMaterial* other) { return other->elastic_law == of_region[r]->elastic_law; });
    model.regions[r].elasticity = model.regions[same - of_region.begin()].elasticity;
  }
  if (std::ranges::none_of(of_region, &RegionMaterial::varies)) return;
  model.cells = CellField<RegionModel>(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) model.cells[c] = of_region[mesh.region[c]]->at(mesh.cell_centre[c]);
}

}  // namespace pfdm
