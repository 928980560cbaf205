#include "solver/fracture/bending_words.h"

#include "physics/quantity_text.h"
#include "solver/momentum/bending/bending_layers.h"

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

// Words on the worst error, its reason and its remedy.
std::string words_on(const BendingError& worst, const std::string& why) {
  const BendingLayers& at = worst.layers;
  const double nu = worst.poisson_ratio;
  const auto length = [](double metres, int digits) { return quantity_text(metres, "m", digits); };
  if (!worst.has_lines)
    return fmt::format(
        "too {} (1.5 (1 - nu) (length/thickness)^2 = {:.3g} less (3 - 2/n)/n^2 = {:.3g}; {}). For {:.0f} %: {} layers "
        "of cells up to {} long ([mesh])",
        worst.error > 0.0 ? "high" : "low", at.excess(nu), at.lack(), why, 100.0 * bearable, layers_for_it,
        length(at.thickness * std::sqrt(bearable / (1.5 * (1.0 - nu))), 2));
  if (worst.error > 0.0)
    return fmt::format(
        "too high or, with an odd number of cells along, too low (cells longer than the body is thick: 0.05 "
        "(length/thickness - 1)^1.3 sqrt((1 - nu)/(1 - 2 nu)), within a factor of two). For {:.0f} %: cells up to {} "
        "long ([mesh])",
        100.0 * bearable, length(1.3 * at.thickness, 2));
  return fmt::format(
      "too low (0.7 (t/thickness)^2, within a factor of two; one cell of t = {} across a material). For {:.0f} %: two "
      "cells across it ([mesh])",
      length(at.lone, 3), 100.0 * bearable);
}

}  // namespace

std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model) {
  const bool is_plane = std::ranges::any_of(model.boundary, [](const auto& on) { return is_front_or_back(on); });
  const std::string why = reason(model);
  const bool may_have_lines = why.empty();
  if (may_have_lines && is_plane && !model.is_finite_strain() && !model.has_eigenstrain()) return std::nullopt;
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const auto worst =
      largest_bending_error(mesh, unknowns, may_have_lines ? std::optional(LinesIn::space_and_plane) : std::nullopt);
  if (!worst || std::abs(worst->error) <= bearable) return std::nullopt;
  const BendingLayers& at = worst->layers;
  return fmt::format(
      "region \"{}\": {:g} layer{} of hexahedra {} long across {}: where they bend, their stiffness is about {:.0f} % "
      "{}",
      mesh.region_names[mesh.region[worst->cell]], at.n, at.n == 1.0 ? "" : "s", quantity_text(at.length, "m", 3),
      quantity_text(at.thickness, "m", 3), 100.0 * std::abs(worst->error),
      words_on(*worst, why.empty() ? "one cell across" : why));
}

}  // namespace pfdm
