#include "solver/fracture/material_cells.h"

#include "physics/materials/small_strain_material.h"
#include "solver/parallel.h"

#include <algorithm>
#include <limits>

namespace pfdm {
namespace {

// The output field of this name, which is added if there is none.
OutputHistory& output_field(const HistoryField& field, std::size_t n_cells, std::vector<OutputHistory>& fields) {
  const auto found = std::ranges::find(fields, field.name, &OutputHistory::name);
  if (found != fields.end()) return *found;
  OutputHistory& added = fields.emplace_back(OutputHistory{.name = std::string(field.name), .unit = field.unit});
  if (field.size == 1)
    added.scalar = CellField<double>(n_cells, 0.0);
  else
    added.tensor = CellField<Tensor>(n_cells, Tensor::Zero());
  return added;
}

}  // namespace

MaterialCells::MaterialCells(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {
  any_ = !model.is_finite_strain() &&
         std::ranges::any_of(model.regions, [](const RegionModel& region) { return region.material != nullptr; });
  if (!any_) return;
  const auto n = as_size(mesh.n_cells());
  material_ = CellField<const Material*>(n, nullptr);
  for (Index c = 0; c < mesh.n_cells(); ++c) material_[c] = model.in_cell(mesh, c).material.get();
  tangent_ = CellField<MandelMatrix>(n);
  start_step(0.0);
}

void MaterialCells::start_step(double duration) {
  duration_ = duration;
  parallel_for(any_ ? mesh_.n_cells() : 0, [&](Index c) {
    if (has(c)) tangent_[c] = stiffness_matrix(material_[c]->elasticity());
  });
}

double MaterialCells::advance(Index cell, const Tensor& strain, const CellHistories& from, CellHistories& to) {
  const Material& material = *material_[cell];
  const Mandel expected = linearised(cell, to)(to_mandel(strain));
  const MaterialResponse result = material.update({from.gradient(cell), strain, duration_, from.of(cell)}, to.of(cell));
  if (!result.solved) return std::numeric_limits<double>::quiet_NaN();
  to.gradient(cell) = strain;
  tangent_[cell] = by_strain(result.tangent);
  const Mandel stress = to_mandel(result.stress);
  return (stress - expected).norm() * stress.norm() / (2.0 * material.elasticity().mu);
}

LinearStress MaterialCells::linearised(Index cell, const CellHistories& histories) const {
  const MandelMatrix& T = tangent_[cell];
  const Tensor strain = histories.gradient(cell);
  return {T, to_mandel(material_[cell]->stress(strain, histories.of(cell))) - T * to_mandel(strain)};
}

MaterialEnergy MaterialCells::energy(Index cell, const CellHistories& histories) const {
  return material_[cell]->energy(histories.gradient(cell), histories.of(cell),
                                 model_.split_of(model_.in_cell(mesh_, cell)));
}

CellHistories MaterialCells::virgin_histories() const {
  if (!any_) return {};
  std::vector<std::size_t> sizes;
  sizes.reserve(as_size(mesh_.n_cells()));
  for (Index c = 0; c < mesh_.n_cells(); ++c) sizes.push_back(has(c) ? material_[c]->history_size() : 0);
  CellHistories histories(sizes);
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (has(c)) material_[c]->start(histories.of(c));
  return histories;
}

std::vector<OutputHistory> MaterialCells::output(const CellHistories& histories) const {
  std::vector<OutputHistory> fields;
  for (Index c = 0; any_ && c < mesh_.n_cells(); ++c) {
    if (!has(c)) continue;
    const std::span<const double> history = histories.of(c);
    for (const HistoryField& field : material_[c]->history_fields()) {
      OutputHistory& out = output_field(field, material_.size(), fields);
      if (field.size == 1)
        out.scalar[c] = history[field.first];
      else
        out.tensor[c] = to_tensor(Eigen::Map<const Mandel>(history.data() + field.first));
    }
  }
  return fields;
}

}  // namespace pfdm
