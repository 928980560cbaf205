#include "solver/fracture/finite_combinations.h"

#include "physics/error.h"
#include "physics/materials/prony.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <string_view>

namespace pfdm {
namespace {

// Opened interfaces have to pull along their separation, or they would transfer a moment. The slip of the friction is
// not turned with the body.
void require_finite_interfaces(const FractureModel& m) {
  for (const CohesiveSurface& surface : m.interfaces) {
    if (!surface.law.pulls_along_separation())
      throw InputError(fmt::format(
          "materials of finite strain can only be combined with cohesive interfaces that pull along their separation: "
          "\"camacho_ortiz\" whose shear_ratio is 1, or another mixed_mode than \"xu_needleman\"; that of \"{}\" is "
          "\"{}\" with {:g}",
          surface.name, surface.law.mixed_mode->name, surface.law.shear_ratio));
    if (surface.law.friction > 0.0)
      throw InputError(fmt::format(
          "materials of finite strain cannot be combined with the friction of the interface \"{}\"", surface.name));
  }
}

// Gaps across a sheet have the modulus of its shear branches, and what a split keeps in closed cracks is elastic.
void require_bulk_branches(const FractureModel& m, const RegionModel& region) {
  if (region.material->relaxing()->bulk.empty()) return;
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("a material of the law \"{}\" with bulk_branches cannot be combined with {}",
                                 region.material->name(), what));
  };
  if (m.is_plane_stress()) refuse("plane stress");
  const std::string_view split = m.split_of(region).name();
  if (region.damageable && split != "none")
    refuse(fmt::format("the energy split \"{}\"; leave out bulk_branches, or choose the split \"none\"", split));
}

// One modulus makes no strength.
void require_finite_branches(const FractureModel& m) {
  for (const RegionModel& region : m.regions) {
    if (!region.material || region.material->relaxing() == nullptr) continue;
    require_bulk_branches(m, region);
    const std::string_view law = region.material->name();
    const bool rational = region.damageable && m.degradation_of(region).law().needs_strength;
    if (rational || region.strength.is_chosen())
      throw InputError(fmt::format(
          "a material of the law \"{}\" with branches cannot be combined with {}, whose strength is that of one "
          "modulus",
          law,
          rational ? fmt::format("the degradation \"{}\"", m.degradation_of(region).name()) : "a model of strength"));
  }
}

// The faces of a sheet have the stiffness of one that damage degrades as a whole. The thickness on which a pressure
// would push is known to the laws of the cells only.
void require_finite_plate(const FractureModel& m) {
  for (const BoundaryCondition& condition : m.boundary)
    if (condition.pressure)
      throw InputError(fmt::format(
          "materials of finite strain in plane stress cannot be combined with the pressure on patch \"{}\", "
          "which would follow the thickness; give a traction, which is per reference area",
          condition.patch));
  for (const RegionModel& region : m.regions) {
    if (region.damageable && m.split_of(region).name() != "none")
      throw InputError(
          fmt::format("materials of finite strain in plane stress can only be combined with the energy split \"none\", "
                      "not \"{}\"",
                      m.split_of(region).name()));
    if (region.material->name() == "saint_venant_kirchhoff")
      throw InputError(
          "a material of the law \"saint_venant_kirchhoff\", which is not convex, cannot be combined with plane "
          "stress");
  }
  if (!m.interfaces.empty())
    throw InputError("materials of finite strain in plane stress cannot be combined with cohesive interfaces");
}

}  // namespace

void require_finite(const FractureModel& m, const Unknowns& unknowns, const LoadingSettings& loading) {
  const auto refuse = [](std::string_view what) {
    throw InputError(fmt::format("materials of finite strain cannot be combined with {}", what));
  };
  for (const RegionModel& region : m.regions) {
    const std::string_view split = m.split_of(region).name();
    if (!region.damageable) continue;
    if (split != "none" && region.material->name() == "saint_venant_kirchhoff")
      refuse(
          fmt::format("the energy split \"{}\" where their law is saint_venant_kirchhoff, which is not convex", split));
  }
  require_finite_interfaces(m);
  if (unknowns.plane_stress) require_finite_plate(m);
  require_finite_branches(m);
  if (m.motion.any()) refuse("a prescribed mean strain or stress: the means are those of small strain");
  if (loading.controls_dissipation())
    refuse("dissipation control (loading.maximum_dissipation): their displacements are not proportional to the load");
}

void require_free_deformation(const Mesh& mesh, const Unknowns& unknowns, const LoadingSettings& loading) {
  constexpr double least_stretch = 0.5;
  constexpr int parts = 8;  // of the load: eigenstrains may be any function of it
  for (int k = 1; k <= parts; ++k) {
    const double load = loading.end * k / parts;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const Tensor strain = to_tensor(unknowns.loads.eigenstrain(mesh, c, load));
      const double least = 1.0 + principal_axes(strain).value[0];
      if (!(least >= least_stretch))
        throw InputError(fmt::format(
            "the eigenstrain at {} shrinks the free body to {:.3g} of its length at the load {:.3g}; at finite strain "
            "at least {:g} is required",
            point_text(mesh.cell_centre[c], 4), least, load, least_stretch));
    }
  }
}

}  // namespace pfdm
