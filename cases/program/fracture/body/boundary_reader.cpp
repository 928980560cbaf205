#include "cases/program/fracture/body/boundary_reader.h"

#include "cases/program/input/config/key.h"
#include "cases/program/input/fields/amount.h"
#include "physics/closed_forms/goodier.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace pfdm {
namespace {

std::function<Vector(const Vector&)> read_goodier(const ConfigTable& settings, const Materials& materials) {
  const Goodier goodier(materials.elasticity(settings.at("inclusion")), materials.elasticity(settings.at("matrix")),
                        settings.quantity("radius"), settings.quantity("stress"));
  return [goodier](const Vector& x) { return goodier.displacement(x); };
}

constexpr DisplacementField field_table[] = {
    {"goodier",
     "sphere bonded in an infinite matrix under remote tension along z (Goodier 1933); "
     "inclusion, matrix, radius, stress",
     read_goodier},
};

using Kind = BoundaryCondition::Kind;

constexpr BoundaryType type_table[] = {
    {"components", "each component is a displacement, a traction or free (the default); pressure", Kind::components},
    {"symmetry", "no normal displacement, no tangential traction", Kind::symmetry},
    {"plane", "front or back of a mesh one cell thick: plane strain", Kind::plane},
    {"plane_stress", "front or back of a mesh one cell thick: no stress across it", Kind::plane_stress},
    {"axisymmetric", "front or back of a sector about the axis z, one cell wide", Kind::axisymmetric},
    {"elastic_foundation", "springs to the ground (Winkler); normal_stiffness, tangential_stiffness",
     Kind::elastic_foundation},
    {"free", "no traction", Kind::components},
};

bool is_free(const ConfigValue& value) { return value.is_string() && value.string() == "free"; }

using Components = std::array<ScalarField, 3>;

std::function<Vector(const Vector&, double)> combined(const Components& components) {
  return [components](const Vector& x, double t) {
    Vector value = Vector::Zero();
    for (Eigen::Index i = 0; i < 3; ++i)
      if (const ScalarField& component = components[i]) value[i] = component(x, t);
    return value;
  };
}

void read_displacement_field(const ConfigValue& value, const Materials& materials, BoundaryCondition& condition) {
  const ConfigTable settings = value.table().with_keys(value.type()->as(KeyType::Kind::table)->table());
  const auto field =
      choose(settings.at("field"), displacement_fields(), "displacement field").read(settings, materials);
  condition.displacement_prescribed = {true, true, true};
  condition.value = [field](const Vector& x, double t) -> Vector { return t * field(x); };
}

void read_displacements(const ConfigValue& value, BoundarySettings& settings, Components& components) {
  const auto entries = value.list(3);
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_free(entries[i])) continue;
    const Amount amount = read_amount(entries[i]);
    settings.condition.displacement_prescribed[i] = true;
    settings.displacement_at_full_load[i] = amount.at_full_load;
    components[i] = amount.value;
  }
}

void read_tractions(const ConfigValue& value, const BoundarySettings& settings, Components& components) {
  const auto entries = value.list(3);
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_free(entries[i])) continue;
    if (settings.condition.displacement_prescribed[i])
      throw entries[i].error("this component's displacement is prescribed as well; write \"free\" in one of the two");
    components[i] = read_amount(entries[i]).value;
  }
}

void read_components(const ConfigTable& table, const Materials& materials, BoundarySettings& settings) {
  const auto displacement = table.find("displacement");
  const auto traction = table.find("traction"), pressure = table.find("pressure");
  if (!displacement && !traction && !pressure)
    throw table.error("displacement, traction, pressure or a type is missing");
  if (displacement && displacement->is_table()) {
    if (traction) throw traction->error("a displacement field leaves no component for a traction");
    if (pressure) throw pressure->error("a displacement field leaves no component for a pressure");
    read_displacement_field(*displacement, materials, settings.condition);
    return;
  }
  Components components;
  if (displacement) read_displacements(*displacement, settings, components);
  if (traction) read_tractions(*traction, settings, components);
  if (std::ranges::any_of(components, [](const ScalarField& component) { return bool(component); }))
    settings.condition.value = combined(components);
  if (!pressure) return;
  if (std::ranges::all_of(settings.condition.displacement_prescribed, std::identity{}))
    throw pressure->error("all components of the displacement are prescribed, which leaves none for a pressure");
  settings.condition.pressure = read_amount(*pressure).value;
}

void read_foundation(const ConfigTable& table, BoundaryCondition& condition) {
  const auto stiffness = [&](const char* key) -> Parameter {
    const auto value = table.find(key);
    return value ? read_parameter(*value) : Parameter{.at = [](const Vector&) { return 0.0; }};
  };
  const Parameter across = stiffness("normal_stiffness"), along = stiffness("tangential_stiffness");
  if (!across.varies && !along.varies && across.at(Vector::Zero()) == 0.0 && along.at(Vector::Zero()) == 0.0)
    throw table.error("an elastic foundation has a normal_stiffness or a tangential_stiffness above 0, or both");
  condition.foundation = [across = across.at, along = along.at](const Vector& x) {
    return FoundationStiffness{.across = across(x), .along = along(x)};
  };
}

void read_condition(const ConfigTable& table, const Materials& materials, BoundarySettings& settings) {
  const auto type_value = table.find("type");
  const BoundaryType& type =
      type_value ? choose(*type_value, boundary_types(), "type of boundary condition") : type_table[0];
  settings.condition.kind = type.kind;
  if (type.name == "components") return read_components(table, materials, settings);
  for (const char* key : {"displacement", "traction", "pressure"})
    if (const auto value = table.find(key))
      throw value->error(fmt::format("a patch of type \"{}\" takes no prescribed value", type.name));
  if (type.kind == Kind::elastic_foundation) read_foundation(table, settings.condition);
}

std::vector<ConfigValue> patches_of(const ConfigTable& table) {
  const auto several = table.find("patches");
  if (!several) return {table.at("patch")};
  if (table.has("patch")) throw table.error("give either patch or patches, not both");
  return several->list();
}

void add_patch(std::vector<BoundarySettings>& boundary, const BoundarySettings& settings) {
  for (const BoundarySettings& other : boundary)
    if (other.condition.patch == settings.condition.patch)
      throw settings.patch.error(
          fmt::format("patch \"{}\" already has a boundary condition", settings.condition.patch));
  boundary.push_back(settings);
}

}  // namespace

std::vector<BoundarySettings> read_boundary(const ConfigTable& root, const Materials& materials) {
  std::vector<BoundarySettings> boundary;
  for (const ConfigTable& table : root.tables("boundary")) {
    const std::vector<ConfigValue> patches = patches_of(table);
    if (patches.empty()) throw table.error("patches is an empty list");
    BoundarySettings settings{.condition = {}, .displacement_at_full_load = {}, .patch = patches.front()};
    read_condition(table, materials, settings);
    for (const ConfigValue& patch : patches) {
      settings.patch = patch;
      settings.condition.patch = patch.string();
      add_patch(boundary, settings);
    }
  }
  if (boundary.empty()) throw root.error("[[boundary]] is missing: nothing holds or loads the body");
  return boundary;
}

std::span<const BoundaryType> boundary_types() { return type_table; }

std::span<const DisplacementField> displacement_fields() { return field_table; }

bool acts_on(std::string_view patch, std::span<const BoundarySettings> boundary) {
  return std::ranges::any_of(boundary, [&](const BoundarySettings& settings) {
    const BoundaryCondition& on = settings.condition;
    const bool is_free = on.kind == BoundaryCondition::Kind::components && !on.value && !on.pressure &&
                         std::ranges::none_of(on.displacement_prescribed, std::identity{});
    return on.patch == patch && !is_free;
  });
}

}  // namespace pfdm
