#include "solver/fracture/cells/material_cells.h"

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

CellField<const Material*> materials_of(const Mesh& mesh, const FractureModel& model) {
  const bool any =
      std::ranges::any_of(model.regions, [](const RegionModel& region) { return region.material != nullptr; });
  CellField<const Material*> materials(any ? as_size(mesh.n_cells()) : 0, nullptr);
  for (Index c = 0; c < materials.size(); ++c) materials[c] = model.in_cell(mesh, c).material.get();
  return materials;
}

}  // namespace

MaterialCells::MaterialCells(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh),
      model_(model),
      material_(materials_of(mesh, model)),
      memories_(gap_memories(mesh, material_, model)) {
  any_ = material_.size() > 0;
  if (!any_) return;
  memory_ = CellField<GapMemory*>(mesh.n_cells(), nullptr);
  for (const auto& memory : memories_)
    for (Index c = 0; c < mesh.n_cells(); ++c)
      if (memory->has(c)) memory_[c] = memory.get();
  tangent_ = CellField<MandelMatrix>(mesh.n_cells());
  start_step(0.0);
}

void MaterialCells::start_step(double duration, const CellField<double>& shift) {
  duration_ = duration;
  shift_ = shift;
  for (const auto& memory : memories_) memory->start_step(duration, shift);
  parallel_for(any_ ? mesh_.n_cells() : 0, [&](Index c) {
    if (has(c)) tangent_[c] = stiffness_matrix(memory_[c] ? memory_[c]->elasticity(c) : material_[c]->elasticity());
  });
}

void MaterialCells::hold(CellHistories& histories) {
  parallel_for(any_ ? mesh_.n_cells() : 0, [&](Index c) {
    if (!has(c) || material_[c]->relaxing() == nullptr) return;
    const std::size_t n = material_[c]->history_size();
    const Tensor strain = histories.gradient(c);
    const std::span<double> of_law = histories.of(c).first(n);
    const std::vector<double> from(of_law.begin(), of_law.end());
    tangent_[c] = by_strain(material_[c]->update({strain, strain, duration(c), from}, of_law).tangent);
    if (memory_[c]) memory_[c]->hold(c, histories.of(c).subspan(n));
  });
}

double MaterialCells::advance(Index cell, const CellMechanics& mechanics, const CellHistories& from,
                              CellHistories& to) {
  const Material& material = *material_[cell];
  Tensor strain = mechanics.reconstructed_strain[cell];
  if (mechanics.eigenstrain.size() > 0) strain -= to_tensor(mechanics.eigenstrain[cell]);
  const Mandel expected = linearised(cell, to)(to_mandel(strain));
  const std::size_t n = material.history_size();
  const MaterialStep step{from.gradient(cell), strain, duration(cell), law_numbers(cell, from)};
  const MaterialResponse result = material.update(step, to.of(cell).first(n));
  if (!result.solved) return std::numeric_limits<double>::quiet_NaN();
  if (memory_[cell])
    memory_[cell]->advance(cell, material.left_by_flow(step, law_numbers(cell, to)), mechanics, gap_numbers(cell, from),
                           to.of(cell).subspan(n));
  to.gradient(cell) = strain;
  tangent_[cell] = by_strain(result.tangent);
  const Mandel stress = to_mandel(result.stress);
  return (stress - expected).norm() * stress.norm() / (2.0 * material.elasticity().mu);
}

LinearStress MaterialCells::linearised(Index cell, const CellHistories& histories) const {
  const MandelMatrix& T = tangent_[cell];
  const Tensor strain = histories.gradient(cell);
  return {T, to_mandel(material_[cell]->stress(strain, law_numbers(cell, histories))) - T * to_mandel(strain)};
}

IsotropicElasticity MaterialCells::beyond_elasticity(Index cell) const {
  if (!memory_[cell]) return {};
  const IsotropicElasticity now = memory_[cell]->elasticity(cell), &at_once = material_[cell]->elasticity();
  return {.lambda = now.lambda - at_once.lambda, .mu = now.mu - at_once.mu};
}

HistoryStress MaterialCells::history_stress(const CellHistories& histories) const {
  const std::size_t n = mesh_.n_cells();
  HistoryStress history{.stress = CellField<LinearStress>(n)};
  if (memories_.empty()) return history;
  history.sound = CellField<IsotropicElasticity>(n);
  history.relaxes = CellField<char>(n, 0);
  history.volumes = CellField<VolumeStress>(n);
  history.gaps.resize(mesh_.cell_faces.size());
  parallel_for(mesh_.n_cells(), [&](Index c) {
    history.sound[c] = model_.in_cell(mesh_, c).elasticity;
    if (memory_[c]) memory_[c]->tell(c, gap_numbers(c, histories), history);
  });
  return history;
}

MaterialEnergy MaterialCells::energy(Index cell, const CellHistories& histories) const {
  MaterialEnergy energy = material_[cell]->energy(histories.gradient(cell), law_numbers(cell, histories),
                                                  model_.split_of(model_.in_cell(mesh_, cell)));
  if (!memory_[cell]) return energy;
  const std::span<const double> gaps = gap_numbers(cell, histories);
  if (!all_drives(cell)) energy.idle += memory_[cell]->in_branches(gaps);
  energy.locked += GapMemory::locked(gaps);
  energy.dissipated += GapMemory::dissipated(gaps);
  return energy;
}

bool MaterialCells::all_drives(Index cell) const {
  const PronyLaw* relaxing = material_[cell]->relaxing();
  return relaxing == nullptr || relaxing->drive == PronyDrive::stored;
}

CellHistories MaterialCells::virgin_histories() const {
  if (!any_) return {};
  std::vector<std::size_t> sizes;
  sizes.reserve(mesh_.n_cells());
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    sizes.push_back(has(c) ? material_[c]->history_size() + (memory_[c] ? memory_[c]->size(c) : 0) : 0);
  CellHistories histories(sizes);
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (has(c)) material_[c]->start(histories.of(c).first(material_[c]->history_size()));
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
