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

bool has_duration(const ConfigTable& file) { return file.has("loading") && file.table("loading").has("duration"); }

bool wants_time_of_frames(const ConfigTable& file) {
  if (!file.has("output")) return false;
  const auto wanted = file.table("output").find("time_value");
  return wanted && wanted->string() == "time";
}

}  // namespace

std::vector<std::string> idle_keys(const FractureCase& fracture) {
  std::vector<std::string> warnings = fracture.materials.idle_keys;
  if (has_duration(*fracture.file) && !depends_on_time(fracture) && !wants_time_of_frames(*fracture.file))
    warnings.emplace_back(
        "[loading] duration gives the frames their time and changes nothing else: no material, interface or other part "
        "of this case depends on time (as the law \"prony\" or the branches of an interface do)");
  return warnings;
}

}  // namespace pfdm
