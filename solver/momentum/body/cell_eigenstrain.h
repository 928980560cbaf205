#pragma once
// Eigenstrains eps* of the cells, one each (thermal expansion, misfit): the stress is C (eps - eps*), at finite
// strain that of F (1 + eps*)^-1.

#include "solver/momentum/body/unknowns.h"

#include <optional>

namespace pfdm {

/// Whether an eigenstrain shears across a mesh one cell thick with this normal, whose cells cannot follow.
bool shears_across(const Tensor& eigenstrain, const Vector& plane_normal);

class CellEigenstrain {
 public:
  /// Takes the eigenstrains of the body at the load parameter t and these rises of the temperature [K], empty: none; or
  /// takes none. Returns whether they have changed.
  bool set(const Mesh& mesh, const VolumeLoads& loads, std::optional<double> t, const CellField<double>& rise);

  bool any() const { return of_cell_.size() > 0; }
  const CellField<Mandel>& all() const { return of_cell_; }  ///< [-]; empty: none
  const Mandel& operator[](Index cell) const { return of_cell_[cell]; }
  Tensor elastic_part(Index cell, const Tensor& strain) const {
    return any() ? (strain - to_tensor(of_cell_[cell])).eval() : strain;
  }

 private:
  std::optional<double> load_;  // parameter at which they are, and
  CellField<double> rise_;      // rises [K]; empty without
  CellField<Mandel> of_cell_;
};

}  // namespace pfdm
