#include "cases/program/fracture/case/idle_keys.h"

#include <algorithm>

namespace pfdm {
namespace {

bool depends_on_time(const FractureCase& fracture) {
  const auto material = [](const RegionMaterial& region) {
    return region.material && region.material->depends_on_rate();
  };
  const auto interface = [](const InterfaceSettings& settings) { return settings.law.depends_on_rate(); };
  return fracture.heat || fracture.model.viscosity > 0.0 || fracture.materials.has_fatigue() ||
         std::ranges::any_of(fracture.materials.by_region, material) ||
         std::ranges::any_of(fracture.interfaces, interface);
}

}  // namespace

std::vector<std::string> idle_keys(const FractureCase& fracture) {
  std::vector<std::string> warnings = fracture.materials.idle_keys;
  if (fracture.file->has("loading") && fracture.file->table("loading").has("duration") && !depends_on_time(fracture))
    warnings.emplace_back(
        "[loading] duration changes nothing: no material, interface or other part of this case depends on time (as the "
        "law \"prony\" or the branches of an interface do)");
  return warnings;
}

}  // namespace pfdm
