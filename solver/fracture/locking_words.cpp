#include "solver/fracture/locking_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

std::string reason(const FractureModel& model) {
  for (const RegionModel& region : model.regions)
    if (region.material && !region.material->is_finite_strain())
      return fmt::format("beside a material of the law \"{}\"", region.material->name());
  if (model.is_anisotropic()) return "beside elasticity that depends on the direction";
  return "with a split without secant moduli";
}

}  // namespace

std::optional<std::string> locking_warning(const Mesh& mesh, const FractureModel& model) {
  ElasticBody body = elastic_body(model);
  if (body.has_pressure) return std::nullopt;
  body.has_pressure = true;
  const std::vector<Index> cells = place_unknowns(mesh, body).pressure_cells;
  if (cells.empty()) return std::nullopt;
  const auto nu = [&](Index cell) { return model.in_cell(mesh, cell).elasticity.poisson_ratio(); };
  const Index worst = *std::ranges::max_element(cells, {}, nu);
  return fmt::format(
      "region \"{}\" is nearly incompressible (nu = {:.5g}), and {} cells have no pressure unknown: the body is too "
      "stiff "
      "where it is confined (a bonded disc of hexahedra by 0.5 % at nu = 0.49, by 20 % at 0.4997); compare a finer "
      "mesh, "
      "or lower materials.NAME.poisson_ratio",
      mesh.region_names[as_size(mesh.region[worst])], nu(worst), reason(model));
}

}  // namespace pfdm
