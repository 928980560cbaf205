#include "cases/program/fracture/body/body_loads.h"

#include "cases/program/input/fields/amount.h"
#include "cases/program/input/fields/field_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

ScalarField in_time(const Amount& amount, bool from_start) { return from_start ? amount.from_start : amount.value; }

// Of the components xx, yy, zz, yz, xz, xy.
constexpr std::array<std::array<Index, 2>, 6> places{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

LoadField<Vector> read_vector(const ConfigValue& value, bool from_start) {
  const std::vector<ConfigValue> entries = value.list(3);
  std::array<ScalarField, 3> parts;
  for (std::size_t i = 0; i < 3; ++i) parts[i] = in_time(read_amount(entries[i]), from_start);
  return [parts](const Vector& x, double t) { return Vector(parts[0](x, t), parts[1](x, t), parts[2](x, t)); };
}

ScalarField read_temperature(const ConfigValue& value, bool from_start) {
  require_temperature_difference(value);
  return in_time(read_amount(value), from_start);
}

}  // namespace

void require_temperature_difference(const ConfigValue& value) {
  std::string unit;
  if (value.is_string()) unit = unit_of(value.string());
  if (value.is_table() && !is_field(value)) unit = value.table().string("unit", "");
  if (has_other_zero(unit)) throw value.error("a change of temperature is a difference: give it in K, as in \"20 K\"");
}

bool apply_from_start(const ConfigTable& root) {
  if (!root.has("loads")) return false;
  return root.table("loads").choice("applied", "with_load") == "from_start";
}

BodyLoads read_body_loads(const ConfigTable& root) {
  if (!root.has("loads")) return {};
  const ConfigTable table = root.table("loads");
  const bool from_start = apply_from_start(root);
  BodyLoads loads;
  if (const auto gravity = table.find("gravity")) loads.gravity = read_vector(*gravity, from_start);
  if (const auto force = table.find("body_force")) loads.force = read_vector(*force, from_start);
  if (const auto change = table.find("temperature_change")) loads.temperature = read_temperature(*change, from_start);
  loads.start_temperature = table.quantity("start_temperature", 0.0);
  return loads;
}

std::shared_ptr<const LoadField<Tensor>> read_eigenstrain(const ConfigValue& value, bool from_start) {
  const std::vector<ConfigValue> entries = value.list();
  if (entries.size() != 3 && entries.size() != 6)
    throw value.error(
        fmt::format("expected three numbers (xx, yy, zz) or six (and yz, xz, xy), found {}", entries.size()));
  std::vector<ScalarField> parts;
  parts.reserve(entries.size());
  for (const ConfigValue& entry : entries) parts.push_back(in_time(read_amount(entry), from_start));
  return std::make_shared<const LoadField<Tensor>>([parts](const Vector& x, double t) {
    Tensor strain = Tensor::Zero();
    for (std::size_t k = 0; k < parts.size(); ++k)
      strain(places[k][0], places[k][1]) = strain(places[k][1], places[k][0]) = parts[k](x, t);
    return strain;
  });
}

void require_body_loads(const ConfigTable& root, const FractureModel& model, const Mesh& mesh,
                        std::span<const double> loads) {
  const BodyLoads& by = model.loads;
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    if (by.gravity && !(model.regions[r].density > 0.0))
      throw root.table("loads").at("gravity").error(
          fmt::format("region \"{}\" has no density, on which gravity acts; give its material one, as in \"{}\"",
                      mesh.region_names[r], dimension::density.example));
  const auto shifts = [](const RegionModel& region) { return region.temperature_shift() != nullptr; };
  const auto feels = [&](const RegionModel& region) { return !region.expansion.isZero() || shifts(region); };
  if (by.temperature && std::ranges::none_of(model.regions, feels))
    throw root.table("loads")
        .at("temperature_change")
        .error(
            "no material expands, or has times that depend on it; give one its expansion, as in \"12e-6 1/K\", or a "
            "temperature_shift");
  if (by.start_temperature > 0.0 && std::ranges::none_of(model.regions, shifts))
    throw root.table("loads").at("start_temperature").error("no material has a temperature_shift, which needs it");
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (const double load : loads) {
      const Vector& x = mesh.cell_centre[c];
      if (by.gravity) by.gravity(x, load);
      if (by.force) by.force(x, load);
      if (by.temperature) by.temperature(x, load);
      if (const auto& eigenstrain = model.in_cell(mesh, c).eigenstrain) (*eigenstrain)(x, load);
    }
}

}  // namespace pfdm
