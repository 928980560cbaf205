#include "solver/fracture/cells/finite_histories.h"

#include "solver/parallel.h"

#include <utility>

namespace pfdm {
namespace {

CellField<const Material*> as_materials(const CellField<const HyperelasticMaterial*>& of) {
  CellField<const Material*> materials(of.size(), nullptr);
  for (Index c = 0; c < of.size(); ++c) materials[c] = of[c];
  return materials;
}

}  // namespace

FiniteHistories::FiniteHistories(const Mesh& mesh, const CellField<const HyperelasticMaterial*>& materials,
                                 const FractureModel& model)
    : mesh_(mesh),
      material_(materials),
      is_plane_stress_(model.is_plane_stress()),
      gaps_(mesh, as_materials(materials), model) {
  if (!any()) return;
  const std::size_t n = mesh.n_cells();
  left_.sound = CellField<IsotropicElasticity>(n);
  left_.relaxes = CellField<char>(n, 0);
  modulus_ = bulk_modulus_ = CellField<double>(n, 0.0);
}

void FiniteHistories::set_own_sides(std::vector<Index> cells) { cells_of_own_ = std::move(cells); }

CellHistories FiniteHistories::virgin_histories() const {
  if (!any()) return {};
  const Index n_cells = mesh_.n_cells(), n_places = n_cells + count_of(cells_of_own_);
  std::vector<std::size_t> sizes(as_size(n_places), 0);
  for (Index k = 0; k < n_places; ++k)
    if (has(place(k).cell)) sizes[k] = law_size(k) + (k < n_cells ? gaps_.size(k) : 0);
  return CellHistories(sizes);
}

void FiniteHistories::start_from(const CellHistories& start, double duration) {
  if (!any()) return;
  start_ = start;
  duration_ = duration;
  gaps_.start_step(duration, shift_);
  left_.volumes = CellField<VolumeStress>(mesh_.n_cells());
  left_.gaps.assign(mesh_.cell_faces.size(), {});
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!has(c)) return;
    modulus_[c] = material_[c]->branches().modulus_over(this->duration(c));
    bulk_modulus_[c] = material_[c]->branches().bulk_modulus_over(this->duration(c));
    gaps_.tell(c, gap_numbers(c, start_), RelaxingGaps::At::start, left_);
  });
}

void FiniteHistories::advance(FinitePlace at, const Tensor& H, CellHistories& to) const {
  const Index k = number(at);
  branches(at.cell).advance(H, before(at), to.of(k).first(law_size(k)));
  to.gradient(k) = H;
}

// The pressure is proportional to the volume strain u of U.
void FiniteHistories::advance_gaps(Index cell, const std::vector<FaceGap>& gaps, double volume_change,
                                   CellHistories& to) const {
  const VolumeChanges now{.by_gradient = 0.0, .by_flux = material_[cell]->volume_strain(volume_change)};
  gaps_.advance(cell, now, gaps, gap_numbers(cell, start_), to.of(cell).subspan(law_size(cell)));
}

MaterialEnergy FiniteHistories::energy(Index cell, const CellHistories& histories) const {
  const std::span<const double> law = law_numbers(cell, histories), gaps = gap_numbers(cell, histories);
  const Tensor H = histories.gradient(cell);
  const double stored = branches(cell).over(H, {H, 0.0, law}).energy;
  const bool drives = material_[cell]->drive() == PronyDrive::stored;
  return {.driving = drives ? stored : 0.0,
          .idle = drives ? 0.0 : stored,
          .locked = RelaxingGaps::locked(gaps),
          .dissipated = branches(cell).heat(law) + RelaxingGaps::dissipated(gaps)};
}

}  // namespace pfdm
