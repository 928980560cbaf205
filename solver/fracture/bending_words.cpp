#include "solver/fracture/bending_words.h"

#include "physics/quantity_text.h"
#include "solver/momentum/bending_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double bearable = 0.03;
constexpr int layers_for_it = 10;  // (3 - 2/n)/n^2 is then 2.8 %

// Why gradients are of one ring wherever layers bend; empty where lines of cells or cubics may serve.
std::string reason(const FractureModel& model) {
  const auto has = [&](BoundaryCondition::Kind kind) {
    return std::ranges::any_of(model.boundary, [&](const BoundaryCondition& on) { return on.kind == kind; });
  };
  if (has(BoundaryCondition::Kind::axisymmetric)) return "a body about an axis";
  if (model.is_finite_strain()) return "";
  if (model.is_anisotropic()) return "elasticity that depends on the direction";
  if (!model.is_isotropic()) return "a split without secant moduli";
  if (std::ranges::any_of(model.regions, [](const RegionModel& region) { return region.material != nullptr; }))
    return "a material with a history";
  return "";
}

}  // namespace

std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model) {
  const bool is_plane = std::ranges::any_of(model.boundary, [](const auto& on) { return is_front_or_back(on); });
  const bool is_finite = model.is_finite_strain();
  std::string why = reason(model);
  const bool may_have_lines = why.empty();
  if (may_have_lines && is_plane && !is_finite) return std::nullopt;
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const LinesIn where = is_finite ? LinesIn::space_and_plane : LinesIn::space;
  const auto worst = largest_bending_error(
      mesh, unknowns, [&](const BendingCell& in) { return !may_have_lines || !has_lines(mesh, unknowns, in, where); });
  if (may_have_lines)
    why = fmt::format("{} with fewer than three cells of one material across",
                      is_finite ? "at finite strain" : "in space");
  if (!worst || std::abs(worst->error) <= bearable) return std::nullopt;
  const BendingLayers& at = worst->layers;
  const double nu = worst->poisson_ratio;
  return fmt::format(
      "region \"{}\": {:g} layer{} of hexahedra {} long across {}: where they bend, their stiffness is about {:.0f} % "
      "too {} (1.5 (1 - nu) (length/thickness)^2 = {:.3g} less (3 - 2/n)/n^2 = {:.3g}; {}). For {:.0f} %: {} layers of "
      "cells up to {} long ([mesh])",
      mesh.region_names[as_size(mesh.region[worst->cell])], at.n, at.n == 1.0 ? "" : "s",
      quantity_text(at.length, "m", 3), quantity_text(at.thickness, "m", 3), 100.0 * std::abs(worst->error),
      worst->error > 0.0 ? "high" : "low", at.excess(nu), at.lack(), why, 100.0 * bearable, layers_for_it,
      quantity_text(at.thickness * std::sqrt(bearable / (1.5 * (1.0 - nu))), "m", 2));
}

}  // namespace pfdm
