#include "solver/fracture/fracture_model.h"

#include <algorithm>

namespace pfdm {

bool FractureModel::is_isotropic() const {
  const auto has_secant = [](const EnergySplit& s) { return !s.is_chosen() || s.has_secant(); };
  return has_secant(split) &&
         std::ranges::all_of(regions, [&](const RegionModel& region) { return has_secant(region.split); });
}

bool FractureModel::is_finite_strain() const {
  return std::ranges::any_of(
      regions, [](const RegionModel& region) { return region.material && region.material->is_finite_strain(); });
}

bool FractureModel::has_strength() const {
  return std::ranges::any_of(regions, [](const RegionModel& region) { return region.strength.is_chosen(); });
}

CellField<double> FractureModel::lower_bound(const CellField<double>& damage) const {
  constexpr double nearly_broken = 0.95;
  CellField<double> lower = damage;
  if (irreversibility == Irreversibility::bounds) return lower;
  for (double& d : lower)
    if (irreversibility == Irreversibility::history || d < nearly_broken) d = 0.0;
  return lower;
}

ElasticBody elastic_body(const FractureModel& model) {
  ElasticBody body{.elasticity = {}, .zone = {}, .boundary = model.boundary};
  for (const RegionModel& region : model.regions) {
    const auto same = std::ranges::find_if(model.regions, [&](const RegionModel& other) {
      return other.elasticity == region.elasticity && other.material == region.material;
    });
    body.zone.push_back(static_cast<Index>(same - model.regions.begin()));
    body.elasticity.push_back(region.elasticity);
  }
  for (const CohesiveSurface& surface : model.interfaces)
    body.split_faces.insert(body.split_faces.end(), surface.faces.begin(), surface.faces.end());
  body.motion = model.motion;
  body.has_pressure = model.is_isotropic() && std::ranges::none_of(model.regions, [](const RegionModel& r) {
                        return r.material != nullptr && !r.material->is_finite_strain();
                      });
  return body;
}

}  // namespace pfdm
