// What the mesh of a plate does to its fit.

#include "cases/program/plate/plate_fit_model.h"
#include "cases/program/studies/runs/finer_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr std::int64_t most_layers = 9;  // of a plate that is given more; ten are exact to 1 %

/// Cells along an axis of box_hexes that has one part; nothing of others.
std::optional<std::int64_t> cells_along(const TomlValue& root, const std::string& axis) {
  try {
    const auto* parts = std::get_if<TomlArray>(&value_at(root, axis).value);
    if (parts == nullptr || parts->size() != 1) return std::nullopt;
    const auto* cells = std::get_if<std::int64_t>(&value_at(parts->front(), "cells").value);
    return cells != nullptr ? std::optional(*cells) : std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The layers of a plate are its fewest cells.
std::optional<CaseVariant> with_more_layers(const CaseFile& file) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  std::string thin;
  std::int64_t layers = most_layers + 1;
  for (const char* axis : {"mesh.x", "mesh.y", "mesh.z"}) {
    const auto cells = cells_along(root, axis);
    if (!cells) return std::nullopt;
    if (*cells < layers) layers = *cells, thin = axis;
  }
  if (thin.empty()) return std::nullopt;
  const std::string key = thin + "[0].cells", more = fmt::format("{}", (5 * layers + 2) / 3);
  return CaseVariant{with_text(file, with_value(file.text, key, more)), fmt::format("{} = {}", key, more)};
}

}  // namespace

std::optional<FinerModel> on_finer_mesh(const CaseFile& file, const PlateFit& fit, const std::vector<double>& values,
                                        Log& log) {
  auto finer = finer_case(fit.where, file);
  if (!finer) finer = with_more_layers(file);
  if (!finer) return std::nullopt;
  log.say(fmt::format("  at the estimates with {}", finer->shown));
  const PlateCase c = read_plate_case(finer->file.config.root(), finer->file.directory);
  const Mesh mesh = c.mesh.make();
  PlateModel model(finer->file, fit, c, mesh);
  auto residuals = model.residuals(model.with(values));
  return residuals ? std::optional(FinerModel{finer->shown, std::move(*residuals)}) : std::nullopt;
}

}  // namespace pfdm
