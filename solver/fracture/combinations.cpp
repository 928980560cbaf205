#include "solver/fracture/combinations.h"

#include "physics/quantity_text.h"
#include "solver/fracture/damage/fatigue_cells.h"
#include "solver/fracture/finite_combinations.h"
#include "solver/fracture/heat_combinations.h"
#include "solver/fracture/model/held_interfaces.h"
#include "solver/momentum/body/cell_eigenstrain.h"

#include "physics/elasticity/anisotropy.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

std::string shown(const Vector& x) { return point_text(x, 4); }

void require_plain_interfaces(const FractureModel& model, const LoadingSettings& loading) {
  if (model.interfaces.empty()) return;
  if (loading.controls_dissipation() && std::ranges::any_of(model.regions, &RegionModel::damageable))
    throw InputError(
        "dissipation control (loading.maximum_dissipation) can be combined with cohesive interfaces only where no "
        "region is damageable");
  for (const CohesiveSurface& surface : model.interfaces)
    if (surface.law.own_law && loading.controls_dissipation())
      throw InputError(
          fmt::format("interface \"{}\": a law of one's own cannot be combined with dissipation control "
                      "(loading.maximum_dissipation)",
                      surface.name));
  if (std::ranges::none_of(model.interfaces, [](const CohesiveSurface& s) { return s.law.depends_on_rate(); })) return;
  if (!(loading.duration > 0.0))
    throw InputError(
        "an interface whose law depends on the rate ([[interface]] rate or branches) requires loading.duration, the "
        "time in which t grows by 1, as in \"1 s\"");
  if (loading.controls_dissipation())
    throw InputError(
        "dissipation control (loading.maximum_dissipation) cannot be combined with a rate of interfaces "
        "([[interface]] rate or branches): the load may decrease, time cannot");
  if (model.is_finite_strain() &&
      std::ranges::any_of(model.interfaces, [](const CohesiveSurface& s) { return !s.law.branches.empty(); }))
    throw InputError(
        "branches of interfaces ([[interface]] branches) cannot be combined with materials of finite strain; a rate "
        "can");
}

bool is_proportional(const BoundaryCondition& condition, const Vector& x, double end) {
  const auto value = [&](double t) { return condition.value ? condition.value(x, t) : Vector::Zero(); };
  const auto pressure = [&](double t) { return condition.pressure ? condition.pressure(x, t) : 0.0; };
  constexpr double close = 1e-9;
  return (value(end) - 2.0 * value(0.5 * end)).norm() <= close * value(end).norm() &&
         std::abs(pressure(end) - 2.0 * pressure(0.5 * end)) <= close * std::abs(pressure(end));
}

// Dissipation control requires displacements proportional to the load, a dissipation that only grows, and no
// dependence on time: the load may decrease.
void require_path(const Mesh& mesh, const FractureModel& m, const Unknowns& unknowns, const LoadingSettings& loading) {
  if (m.viscosity > 0.0)
    throw InputError(
        "dissipation control (loading.maximum_dissipation) cannot be combined with viscosity: the load may decrease, "
        "time cannot");
  if (m.irreversibility != Irreversibility::bounds)
    throw InputError("dissipation control (loading.maximum_dissipation) requires the irreversibility \"bounds\"");
  if (!loading.is_proportional)
    throw InputError(
        "dissipation control (loading.maximum_dissipation) requires a path of one point: mean strains and stresses "
        "proportional to t");
  for (const PatchCondition& on : unknowns.conditions) {
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      if (!is_proportional(on.condition, mesh.face_centre[f], loading.end))
        throw InputError(
            fmt::format("dissipation control (loading.maximum_dissipation) requires boundary values proportional to "
                        "t; those of patch \"{}\" are not",
                        patch.name));
  }
}

void require_strength(const FractureModel& m) {
  if (m.irreversibility == Irreversibility::history)
    throw InputError("a strength model requires the irreversibility \"bounds\" or \"crack_set\"");
  for (const RegionModel& region : m.regions) {
    if (!region.damageable) continue;
    const bool is_elastic = !region.material || region.material->is_finite_strain();
    if (!is_elastic || m.degradation_of(region).name() != "quadratic")
      throw InputError(
          "a strength model requires linear elastic or hyperelastic materials and the degradation \"quadratic\"");
  }
}

void require_mean_damage(const Mesh& mesh, const FractureModel& model) {
  if (const std::string what = what_excludes_mean_damage(mesh, model); !what.empty())
    throw InputError(fmt::format(
        "stiffness by the mean damage (fracture.stiffness_damage = \"mean\") cannot be combined with {}", what));
}

void require_duration(const Material& law, const LoadingSettings& loading) {
  if (law.depends_on_rate() && !(loading.duration > 0.0))
    throw InputError(
        fmt::format("a material of the law \"{}\" that depends on the rate requires loading.duration, the time in "
                    "which t grows by 1",
                    law.name()));
}

void require_history(const FractureModel& m, const Material& law, const LoadingSettings& loading) {
  if (!m.is_isotropic())
    throw InputError(
        fmt::format("materials of the law \"{}\" can only be combined with energy splits that have isotropic secant "
                    "moduli: {}",
                    law.name(), splits_with_secant()));
  require_duration(law, loading);
  if (loading.controls_dissipation())
    throw InputError(
        fmt::format("dissipation control (loading.maximum_dissipation) cannot be combined with materials of the law "
                    "\"{}\": their displacements are not proportional to the load",
                    law.name()));
}

constexpr double rounding = 1e-12;  // of a modulus

// Refuses a damageable material that relaxes with models that need one elasticity: energies drive the damage, one
// modulus makes no strength, and the part that a split keeps in closed cracks is elastic.
void require_relaxing(const FractureModel& m, const RegionModel& region) {
  const IsotropicElasticity relaxed = region.material->relaxed_elasticity();
  if (!region.damageable || relaxed == region.elasticity) return;
  const EnergySplit& split = m.split_of(region);
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("a damageable material of the law \"{}\" cannot be combined with {}",
                                 region.material->name(), what));
  };
  if (!split.is_variational())
    refuse(fmt::format("the energy split \"{}\", whose driving energy is not the one that is stored", split.name()));
  if (m.degradation_of(region).law().needs_strength)
    refuse(
        fmt::format("the degradation \"{}\", whose strength is that of one modulus", m.degradation_of(region).name()));
  const double K = region.elasticity.bulk_modulus();
  if (std::abs(relaxed.bulk_modulus() - K) > rounding * K &&
      split.secant(region.elasticity, 0.5, 1.0) != split.secant(region.elasticity, 0.5, 0.0))
    refuse(
        fmt::format("bulk_branches and the energy split \"{}\", which keeps the bulk modulus of closed cracks; leave "
                    "out bulk_branches, or choose the split \"none\"",
                    split.name()));
}

constexpr double close_to_zero = 1e-9;  // of a vector's part, relative

void require_body_force(const Mesh& mesh, const Unknowns& unknowns, const LoadingSettings& loading) {
  const Vector& across = unknowns.plane_normal;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector force = unknowns.loads.force(mesh, c, loading.end);
    if (std::abs(across.dot(force)) > close_to_zero * force.norm())
      throw InputError(
          fmt::format("the body force ([loads] gravity or body_force) at {} acts across a mesh one cell thick, which "
                      "does not move that way",
                      shown(mesh.cell_centre[c])));
    const Vector half = unknowns.loads.force(mesh, c, 0.5 * loading.end);
    if (loading.controls_dissipation() && (force - 2.0 * half).norm() > close_to_zero * force.norm())
      throw InputError(
          "dissipation control (loading.maximum_dissipation) requires body forces proportional to t: not applied = "
          "\"from_start\" in [loads], nor expressions that are not proportional to t");
  }
}

void require_eigenstrain(const Mesh& mesh, const FractureModel& m, const Unknowns& unknowns,
                         const LoadingSettings& loading) {
  if (m.is_finite_strain()) require_free_deformation(mesh, unknowns, loading);
  if (loading.controls_dissipation())
    throw InputError(
        "dissipation control (loading.maximum_dissipation) cannot be combined with eigenstrains (eigenstrain, or "
        "expansion with [loads] temperature_change)");
  const Vector& across = unknowns.plane_normal;
  for (Index c = 0; c < mesh.n_cells() && !across.isZero(); ++c)
    if (shears_across(to_tensor(unknowns.loads.eigenstrain(mesh, c, loading.end)), across))
      throw InputError(fmt::format("the eigenstrain at {} shears across a mesh one cell thick, which does not follow",
                                   shown(mesh.cell_centre[c])));
}

void require_anisotropy(const Mesh& mesh, const FractureModel& m, const Unknowns& unknowns) {
  for (std::size_t r = 0; r < m.regions.size(); ++r) {
    const RegionModel& region = m.regions[r];
    if (!region.stiffness) continue;
    const auto refuse = [&](const std::string& what) {
      throw InputError(fmt::format("region \"{}\": elasticity that depends on the direction cannot be combined with {}",
                                   mesh.region_names[r], what));
    };
    if (region.material) refuse(fmt::format("the law \"{}\"", region.material->name()));
    if (!region.damageable) continue;
    if (!m.split_of(region).suits_anisotropy())
      refuse(fmt::format("the energy split \"{}\", which is one of isotropic elasticity; allowed: {}",
                         m.split_of(region).name(), splits_for_anisotropy()));
    if (region.strength.is_chosen()) refuse("a model of strength");
    if (m.degradation_of(region).law().needs_strength)
      refuse(fmt::format("the degradation \"{}\", whose strength is that of one modulus",
                         m.degradation_of(region).name()));
  }
  const Vector& across = unknowns.plane_normal;
  for (Index c = 0; c < mesh.n_cells() && !across.isZero(); ++c)
    if (const auto& C = m.in_cell(mesh, c).stiffness; C && !is_symmetric_about(*C, across))
      throw InputError(
          fmt::format("the elasticity at {} is not symmetric about the plane of a mesh one cell thick: stretching it "
                      "would shear it across; turn the axes about the normal of the plane only",
                      shown(mesh.cell_centre[c])));
}

void require_loads(const Mesh& mesh, const FractureModel& m, const Unknowns& unknowns, const LoadingSettings& loading) {
  if (m.motion.any() && (m.has_body_force() || m.has_eigenstrain()))
    throw InputError(
        "a box that follows a mean strain cannot be combined with body forces or eigenstrains ([loads]; eigenstrain)");
  if (m.has_body_force()) require_body_force(mesh, unknowns, loading);
  if (m.has_eigenstrain()) require_eigenstrain(mesh, m, unknowns, loading);
}

}  // namespace

std::string what_excludes_mean_damage(const Mesh& mesh, const FractureModel& m) {
  if (m.is_finite_strain()) return "materials of finite strain";
  if (m.has_strength()) return "a strength model";
  if (m.irreversibility != Irreversibility::bounds) return "an irreversibility other than \"bounds\"";
  for (const RegionModel& region : m.regions) {
    if (!region.damageable) continue;
    if (region.material) return fmt::format("damageable materials of the law \"{}\"", region.material->name());
    if (!m.split_of(region).is_variational())
      return fmt::format("the split \"{}\", whose driving force is not the derivative of an energy",
                         m.split_of(region).name());
  }
  if (std::ranges::find(mesh.shape.begin(), mesh.shape.end(), CellShape::hexahedron) == mesh.shape.end())
    return "a mesh without hexahedra: only they have it";
  return {};
}

void require_complete(const Mesh& mesh, const FractureModel& model) {
  if (model.regions.size() != mesh.region_names.size())
    throw InputError(
        fmt::format("the mesh has {} regions, the model {}", mesh.region_names.size(), model.regions.size()));
  if (model.crack == nullptr || !model.degradation.is_chosen() || !model.split.is_chosen())
    throw InputError("the model names no crack geometric function, degradation or energy split");
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    const RegionModel& region = model.regions[r];
    if (region.damageable && !(region.Gc > 0.0 && region.ell > 0.0))
      throw InputError(
          fmt::format("region \"{}\" can be damaged but has no positive toughness and length", mesh.region_names[r]));
    if (model.is_finite_strain() && !(region.material && region.material->is_finite_strain()))
      throw InputError(
          fmt::format("region \"{}\" has a material of small strain and another region one of finite strain; give all "
                      "of them laws of finite strain (saint_venant_kirchhoff for stiff ones), or none",
                      mesh.region_names[r]));
  }
}

void require_combination(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                         const LoadingSettings& loading) {
  require_plain_interfaces(model, loading);
  require_whole_box(mesh, model, unknowns);
  if (model.viscosity > 0.0 && !(loading.duration > 0.0))
    throw InputError("viscosity (fracture.viscosity) requires loading.duration, the time in which t grows by 1");
  for (const RegionModel& region : model.regions)
    if (region.material && !model.is_finite_strain()) {
      require_history(model, *region.material, loading);
      require_relaxing(model, region);
    }
  if (model.is_finite_strain()) {
    for (const RegionModel& region : model.regions) require_duration(*region.material, loading);
    require_finite(model, unknowns, loading);
  }
  if (model.has_strength()) require_strength(model);
  if (model.stiffness_by == StiffnessBy::mean) require_mean_damage(mesh, model);
  require_loads(mesh, model, unknowns, loading);
  if (model.is_anisotropic()) require_anisotropy(mesh, model, unknowns);
  if (model.heat) require_heat(mesh, model, loading);
  require_temperature(mesh, model, unknowns);
  require_fatigue(mesh, model, loading);
  if (loading.controls_dissipation()) require_path(mesh, model, unknowns, loading);
}

}  // namespace pfdm
