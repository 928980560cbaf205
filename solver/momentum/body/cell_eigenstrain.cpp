#include "solver/momentum/body/cell_eigenstrain.h"

#include "solver/parallel.h"

namespace pfdm {

bool CellEigenstrain::set(const Mesh& mesh, const VolumeLoads& loads, std::optional<double> t) {
  if (!loads.eigenstrain || t == load_) return false;
  load_ = t;
  of_cell_ = CellField<Mandel>(t ? as_size(mesh.n_cells()) : 0);
  parallel_for(of_cell_.size(), [&](Index c) { of_cell_[c] = loads.eigenstrain(mesh, c, *t); });
  return true;
}

}  // namespace pfdm
