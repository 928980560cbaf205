#include "solver/fracture/model/fracture_model.h"

#include "physics/materials/prony.h"
#include "solver/fracture/model/relaxing_volume.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm {

bool FractureModel::is_anisotropic() const {
  return std::ranges::any_of(regions, [](const RegionModel& region) { return region.stiffness != nullptr; });
}

bool FractureModel::is_isotropic() const {
  const auto has_secant = [](const EnergySplit& s) { return !s.is_chosen() || s.has_secant(); };
  return !is_anisotropic() && has_secant(split) &&
         std::ranges::all_of(regions, [&](const RegionModel& region) { return has_secant(region.split); });
}

bool FractureModel::is_finite_strain() const {
  return std::ranges::any_of(
      regions, [](const RegionModel& region) { return region.material && region.material->is_finite_strain(); });
}

const TemperatureShift* RegionModel::temperature_shift() const {
  const PronyLaw* law = material ? material->relaxing() : nullptr;
  return law != nullptr && law->shift ? &*law->shift : nullptr;
}

bool FractureModel::is_plane_stress() const {
  return std::ranges::any_of(
      boundary, [](const BoundaryCondition& on) { return on.kind == BoundaryCondition::Kind::plane_stress; });
}

bool FractureModel::has_strength() const {
  return std::ranges::any_of(regions, [](const RegionModel& region) { return region.strength.is_chosen(); });
}

bool FractureModel::has_body_force() const { return loads.force || loads.gravity; }

bool FractureModel::has_eigenstrain() const {
  return std::ranges::any_of(regions, [&](const RegionModel& region) {
    return region.eigenstrain || ((loads.temperature || is_warmed()) && !region.expansion.isZero());
  });
}

CellField<double> FractureModel::lower_bound(const CellField<double>& damage) const {
  constexpr double nearly_broken = 0.95;
  CellField<double> lower = damage;
  if (irreversibility == Irreversibility::bounds) return lower;
  for (double& d : lower)
    if (irreversibility == Irreversibility::history || d < nearly_broken) d = 0.0;
  return lower;
}

namespace {

/// A quantity of the cells' regions, kept for later.
template <class Value>
auto by_cell(const FractureModel& model, Value RegionModel::*member) {
  struct Kept {
    std::vector<Value> regions;
    CellField<Value> cells;
  };
  auto kept = std::make_shared<Kept>();
  for (const RegionModel& region : model.regions) kept->regions.push_back(region.*member);
  kept->cells = CellField<Value>(model.cells.size());
  for (Index c = 0; c < model.cells.size(); ++c) kept->cells[c] = model.cells[c].*member;
  return [kept = std::shared_ptr<const Kept>(kept)](const Mesh& mesh, Index cell) -> const Value& {
    return kept->cells.size() > 0 ? kept->cells[cell] : kept->regions[mesh.region[cell]];
  };
}

VolumeLoads volume_loads(const FractureModel& model) {
  VolumeLoads loads;
  if (model.has_body_force())
    loads.force = [by = model.loads, density = by_cell(model, &RegionModel::density)](const Mesh& mesh, Index cell,
                                                                                      double t) {
      const Vector& x = mesh.cell_centre[cell];
      Vector force = by.force ? by.force(x, t) : Vector::Zero();
      if (by.gravity) force += density(mesh, cell) * by.gravity(x, t);
      return force;
    };
  if (model.has_eigenstrain())
    loads.eigenstrain = [temperature = model.loads.temperature, expansion = by_cell(model, &RegionModel::expansion),
                         given = by_cell(model, &RegionModel::eigenstrain)](const Mesh& mesh, Index cell, double t) {
      const Vector& x = mesh.cell_centre[cell];
      const auto& by_place = given(mesh, cell);
      Tensor strain = by_place ? (*by_place)(x, t) : Tensor::Zero();
      if (temperature) strain += temperature(x, t) * expansion(mesh, cell);
      return to_mandel(strain);
    };
  if (model.has_eigenstrain() && model.is_warmed())
    loads.expansion = [by = by_cell(model, &RegionModel::expansion)](const Mesh& mesh, Index cell) {
      return to_mandel(by(mesh, cell));
    };
  return loads;
}

bool have_one_stiffness(const RegionModel& a, const RegionModel& b) {
  return a.stiffness && b.stiffness ? *a.stiffness == *b.stiffness : a.stiffness == b.stiffness;
}

using VolumeLaws = std::map<const Material*, std::optional<VolumeLaw>>;

// None of relaxing materials that do without a pressure at all times.
std::optional<VolumeLaw> of_relaxing(const Material& material, VolumeLaws& known) {
  const auto [at, is_new] = known.try_emplace(&material);
  if (is_new && relaxes_with_pressure(material))
    at->second =
        VolumeLaw{.elasticity = material.relaxed_elasticity(), .most_compressible = poisson_range(material).least};
  return at->second;
}

std::optional<VolumeLaw> volume_law(const RegionModel& region, VolumeLaws& known) {
  const Material* material = region.material.get();
  if (material == nullptr) return VolumeLaw{.elasticity = region.elasticity};
  if (material->relaxing() != nullptr) return of_relaxing(*material, known);
  if (material->is_finite_strain()) return VolumeLaw{.elasticity = material->elasticity()};
  if (!material->has_linear_volume()) return std::nullopt;
  return VolumeLaw{.elasticity = region.elasticity};
}

// That of the region where Poisson's ratio does not vary within it.
std::function<std::optional<VolumeLaw>(const Mesh&, Index)> volume_laws(const FractureModel& model) {
  constexpr double differs = 1e-9;
  VolumeLaws known;
  std::vector<std::optional<VolumeLaw>> regions;
  for (const RegionModel& region : model.regions) regions.push_back(volume_law(region, known));
  CellField<std::optional<VolumeLaw>> cells(model.cells.size());
  for (Index c = 0; c < model.cells.size(); ++c) cells[c] = volume_law(model.cells[c], known);
  return [regions, cells](const Mesh& mesh, Index c) {
    const auto& region = regions[mesh.region[c]];
    if (cells.size() == 0) return region;
    const auto& own = cells[c];
    const bool varies =
        !own || !region || std::abs(own->elasticity.poisson_ratio() - region->elasticity.poisson_ratio()) > differs;
    return varies ? own : region;
  };
}

}  // namespace

ElasticBody elastic_body(const FractureModel& model) {
  ElasticBody body{.elasticity = {}, .zone = {}, .boundary = model.boundary};
  for (const RegionModel& region : model.regions) {
    const auto same = std::ranges::find_if(model.regions, [&](const RegionModel& other) {
      return other.elasticity == region.elasticity && other.material == region.material &&
             have_one_stiffness(other, region) && other.expansion == region.expansion &&
             other.eigenstrain == region.eigenstrain;
    });
    body.zone.push_back(static_cast<Index>(same - model.regions.begin()));
    body.elasticity.push_back(region.elasticity);
    body.relaxed.push_back(region.material ? region.material->relaxed_elasticity() : region.elasticity);
  }
  for (const CohesiveSurface& surface : model.interfaces)
    body.split_faces.insert(body.split_faces.end(), surface.faces.begin(), surface.faces.end());
  body.motion = model.motion;
  if (model.is_anisotropic())
    body.stiffness = [of = by_cell(model, &RegionModel::stiffness)](const Mesh& mesh, Index cell) {
      return of(mesh, cell).get();
    };
  body.loads = volume_loads(model);
  body.has_pressure = model.is_isotropic();
  body.volume_law = volume_laws(model);
  return body;
}

}  // namespace pfdm
