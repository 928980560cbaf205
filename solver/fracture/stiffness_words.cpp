#include "solver/fracture/stiffness_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace pfdm {
namespace {

std::string why_without(const FractureModel& model) {
  for (const RegionModel& region : model.regions)
    if (region.material && !region.material->is_finite_strain())
      return fmt::format("beside a material of the law \"{}\"", region.material->name());
  if (model.is_anisotropic()) return "beside elasticity that depends on the direction";
  return "with a split without secant moduli";
}

std::optional<std::string> of_volume(const Mesh& mesh, const FractureModel& model) {
  ElasticBody body = elastic_body(model);
  if (body.has_pressure) return std::nullopt;
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    if (const auto& material = model.regions[r].material; material && !material->is_finite_strain())
      if (const IsotropicElasticity relaxed = material->relaxed_elasticity();
          relaxed.poisson_ratio() > body.elasticity[r].poisson_ratio())
        body.elasticity[r] = relaxed;
  body.has_pressure = true;
  const Unknowns unknowns = place_unknowns(mesh, body);
  if (unknowns.pressure_cells.empty()) return std::nullopt;
  const auto nu = [&](Index cell) { return unknowns.sound[as_size(unknowns.zone[cell])].poisson_ratio(); };
  const Index worst = *std::ranges::max_element(unknowns.pressure_cells, {}, nu);
  return fmt::format(
      "region \"{}\" is nearly incompressible (nu = {:.5g}), and {} cells have no pressure unknown: where it is "
      "confined "
      "the body is too stiff (a bonded disc of hexahedra by 0.5 % at nu = 0.49, by 20 % at 0.4997); compare a finer "
      "mesh, or lower materials.NAME.poisson_ratio",
      mesh.region_names[as_size(mesh.region[worst])], nu(worst), why_without(model));
}

// The faces hold on to the jumps of the displacement by the instantaneous moduli.
std::optional<std::string> of_relaxation(const Mesh& mesh, const FractureModel& model) {
  constexpr double usual = 30.0;
  double most = usual;
  std::size_t region = model.regions.size();
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    const auto& material = model.regions[r].material;
    if (!material || material->is_finite_strain()) continue;
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
