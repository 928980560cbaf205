#include "solver/fracture/stiffness_words.h"

#include "solver/fracture/relaxing_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace pfdm {
namespace {

bool may_have_pressure(const Material& material) {
  return material.has_linear_volume() && material.relaxing() == nullptr;
}

std::string why_without(const FractureModel& model) {
  if (model.is_anisotropic()) return "beside elasticity that depends on the direction";
  if (!model.is_isotropic()) return "with a split without secant moduli";
  for (const RegionModel& region : model.regions)
    if (region.material && !may_have_pressure(*region.material))
      return fmt::format("in a material of the law \"{}\"", region.material->name());
  return "here";
}

bool all_may_have_pressure(const FractureModel& model) {
  return model.is_isotropic() && std::ranges::all_of(model.regions, [](const RegionModel& region) {
           return !region.material || region.material->is_finite_strain() || may_have_pressure(*region.material);
         });
}

// Cells that are nearly incompressible, by the elasticity to which they relax, and have no pressure.
std::optional<std::string> of_volume(const Mesh& mesh, const FractureModel& model) {
  if (all_may_have_pressure(model)) return std::nullopt;
  ElasticBody body = elastic_body(model);
  const std::vector<Index> with = place_unknowns(mesh, body).pressure_cells;
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    if (const auto& material = model.regions[r].material; material && !material->is_finite_strain())
      if (const IsotropicElasticity relaxed = material->relaxed_elasticity();
          relaxed.poisson_ratio() > body.elasticity[r].poisson_ratio())
        body.elasticity[r] = relaxed;
  body.has_pressure = true;
  body.volume_elasticity = {};
  const Unknowns unknowns = place_unknowns(mesh, body);
  std::vector<Index> without;
  std::ranges::set_difference(unknowns.pressure_cells, with, std::back_inserter(without));
  if (without.empty()) return std::nullopt;
  const auto nu = [&](Index cell) { return unknowns.sound[as_size(unknowns.zone[cell])].poisson_ratio(); };
  const Index worst = *std::ranges::max_element(without, {}, nu);
  return fmt::format(
      "region \"{}\" is nearly incompressible (nu = {:.5g}), and {} cells have no pressure unknown: where it is "
      "confined the body is too stiff (a bonded disc of hexahedra by 0.5 % at nu = 0.49, by 20 % at 0.4997); compare a "
      "finer mesh, or lower materials.NAME.poisson_ratio",
      mesh.region_names[as_size(mesh.region[worst])], nu(worst), why_without(model));
}

// Where gaps do not relax, they meet the instantaneous moduli, however far the body has relaxed.
std::optional<std::string> of_relaxation(const Mesh& mesh, const FractureModel& model) {
  constexpr double usual = 30.0;
  double most = usual;
  std::size_t region = model.regions.size();
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    const auto& material = model.regions[r].material;
    if (!material || material->is_finite_strain() || gaps_relax(*material)) continue;
    const double ratio = material->elasticity().mu / material->relaxed_elasticity().mu;
    if (ratio > most) most = ratio, region = r;
  }
  if (region == model.regions.size()) return std::nullopt;
  return fmt::format(
      "region \"{}\": the instantaneous shear modulus is {:.3g} times the relaxed one: where the body has relaxed and "
      "its strain varies from cell to cell it is too stiff (a thick-walled cylinder of 8 cells by 0.8 % at 21 times, "
      "by 4 "
      "% at 101); compare a finer mesh",
      mesh.region_names[region], most);
}

}  // namespace

std::vector<std::string> stiffness_warnings(const Mesh& mesh, const FractureModel& model) {
  std::vector<std::string> warnings;
  for (const auto& warning : {of_volume(mesh, model), of_relaxation(mesh, model)})
    if (warning) warnings.push_back(*warning);
  return warnings;
}

}  // namespace pfdm
