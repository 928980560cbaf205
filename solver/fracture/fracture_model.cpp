#include "solver/fracture/fracture_model.h"

#include <algorithm>

namespace pfdm {

ElasticBody elastic_body(const FractureModel& model) {
  ElasticBody body{.elasticity = {}, .zone = {}, .boundary = model.boundary};
  for (const RegionModel& region : model.regions) {
    const auto same = std::ranges::find_if(model.regions, [&](const RegionModel& other) {
      return other.elasticity == region.elasticity && other.endochronic == region.endochronic;
    });
    body.zone.push_back(static_cast<Index>(same - model.regions.begin()));
    body.elasticity.push_back(region.elasticity);
  }
  const bool is_isotropic = model.split == nullptr || model.split->secant != nullptr;
  body.has_pressure =
      is_isotropic && std::ranges::none_of(model.regions, [](const auto& r) { return r.endochronic != nullptr; });
  return body;
}

}  // namespace pfdm
