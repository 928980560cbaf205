#pragma once
// Whether cracks enter cells that do not resolve them, looked at while a run goes on.

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

#include <string>
#include <vector>

namespace pfdm {

/// Cells in which a crack is not resolved, of regions of which others are fine enough.
class CoarseCells {
 public:
  CoarseCells(const Mesh& mesh, const FractureModel& model);
  /// A warning for each region in which a crack (d > 0.5) has now entered cells that are too thick. Also for one in
  /// which the damage of neighbours differs by more than 0.6, where it changes most: profiles are no steeper than
  /// 1/ell. Neighbours are 0.6 ell apart at least in a crack of one or two hexahedra, 1.25 ell elsewhere, as at fronts
  /// that run along bands. Each region is named once.
  std::vector<std::string> look(const CellField<double>& damage);

 private:
  bool is_narrow(Index cell, Index face, const CellField<double>& damage) const;
  void look_at_neighbours(const CellField<double>& damage, std::vector<std::string>& warnings);

  const Mesh& mesh_;
  const FractureModel& model_;
  std::vector<Index> cells_;
  std::vector<bool> told_;  // region by region
};

}  // namespace pfdm
