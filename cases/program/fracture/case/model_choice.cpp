#include "cases/program/fracture/case/model_choice.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/material_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace pfdm {
namespace {

template <class Law>
const Law* find_law(const ConfigTable& table, std::string_view key, const Law& otherwise, std::span<const Law> laws,
                    std::string_view what) {
  const auto value = table.find(key);
  return value ? &choose(*value, laws, what) : &otherwise;
}

Irreversibility read_irreversibility(const ConfigValue& value) {
  const std::string way = value.choice();
  return way == "history"     ? Irreversibility::history
         : way == "crack_set" ? Irreversibility::crack_set
                              : Irreversibility::bounds;
}

/// A crack geometric function, or a strength model, which has one.
const CrackGeometry& read_model(const ConfigTable& table, StrengthChoice& strength) {
  const auto value = table.find("model");
  if (!value) return crack_geometry("AT2");
  const std::string name = value->choice();
  const auto law = std::ranges::find(strength_laws(), name, &StrengthLaw::name);
  if (law == strength_laws().end()) return crack_geometry(name);
  strength.law = &*law;
  return crack_geometry(law->crack);
}

void read_delta(const ConfigTable& table, const FractureModel& model, StrengthChoice& strength) {
  const auto delta = table.find("delta");
  if (strength.law == nullptr) {
    if (delta) throw delta->error("this belongs to the model \"strength\"");
    return;
  }
  if (const auto degrading = table.find("degradation"); degrading && model.degradation.name() != "quadratic")
    throw degrading->error(fmt::format("the model \"{}\" requires the degradation \"quadratic\"", strength.law->name));
  if (model.irreversibility == Irreversibility::history)
    throw table.at("irreversibility")
        .error(fmt::format("the model \"{}\" requires \"bounds\" or \"crack_set\"", strength.law->name));
  if (!delta) return;
  if (delta->is_table())
    strength.mesh_size =
        delta->table().with_keys(delta->type()->as(KeyType::Kind::table)->table()).quantity("mesh_size");
  else
    strength.delta = delta->number();
}

}  // namespace

MaterialDefaults read_fracture_model(const ConfigTable& root, FractureModel& model) {
  const ConfigTable table = root.table("fracture");
  MaterialDefaults defaults;
  model.crack = &read_model(table, defaults.strength);
  const auto degrading = table.find("degradation"), split = table.find("split");
  model.degradation = degrading ? read_degradation(*degrading) : degradation("quadratic");
  model.split = split ? read_split(*split) : energy_split("volumetric_deviatoric");
  if (const auto irreversibility = table.find("irreversibility"))
    model.irreversibility = read_irreversibility(*irreversibility);
  read_delta(table, model, defaults.strength);
  if (const auto by = table.find("stiffness_damage"))
    model.stiffness_by = by->choice() == "mean" ? StiffnessBy::mean : StiffnessBy::cell;
  model.residual_stiffness = table.number("residual_stiffness", model.residual_stiffness);
  if (table.has("viscosity")) model.viscosity = table.quantity("viscosity");
  defaults.crack = model.crack;
  defaults.corrects_toughness = table.choice("effective_toughness", "corrected") == "corrected";
  if (table.has("length")) defaults.ell = table.quantity("length");
  defaults.degradation = model.degradation;
  if (model.degradation.law().needs_strength)
    defaults.softening = find_law(table, "softening", softening_law("linear"), softening_laws(), "softening law");
  return defaults;
}

Perturbation read_perturbation(const ConfigTable& root) {
  if (!root.has("fracture")) return {};
  const ConfigTable table = root.table("fracture");
  if (table.has("perturbation_seed") && !table.has("perturbation"))
    throw table.at("perturbation_seed").error("this belongs to a perturbation, which is not given");
  return {.part = table.number("perturbation", 0.0),
          .seed = static_cast<std::uint64_t>(table.integer("perturbation_seed", std::int64_t{1}))};
}

MaterialDefaults elastic_model(FractureModel& model) {
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  MaterialDefaults defaults;
  defaults.elastic_keys = elastic_material_keys;
  return defaults;
}

}  // namespace pfdm
