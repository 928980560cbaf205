#include "solver/momentum/body/cell_eigenstrain.h"

#include "solver/parallel.h"

namespace pfdm {

bool shears_across(const Tensor& eigenstrain, const Vector& plane_normal) {
  constexpr double close_to_zero = 1e-9;  // relative to the whole: its part across may be nothing but rounding
  const Vector strain = eigenstrain * plane_normal;
  return (strain - plane_normal.dot(strain) * plane_normal).norm() > close_to_zero * eigenstrain.norm();
}

bool CellEigenstrain::set(const Mesh& mesh, const VolumeLoads& loads, std::optional<double> t,
                          const CellField<double>& rise) {
  const bool is_warm = loads.expansion && rise.size() > 0;
  if (!loads.eigenstrain || (t == load_ && (!is_warm || rise == rise_))) return false;
  load_ = t;
  if (is_warm) rise_ = rise;
  of_cell_ = CellField<Mandel>(t ? as_size(mesh.n_cells()) : 0);
  parallel_for(of_cell_.size(), [&](Index c) {
    of_cell_[c] = loads.eigenstrain(mesh, c, *t);
    if (is_warm) of_cell_[c] += rise[c] * loads.expansion(mesh, c);
  });
  return true;
}

}  // namespace pfdm
