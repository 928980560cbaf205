#pragma once
// From recorded points to the data of a fit: what is beyond the body or masked, outliers, and means over squares.

#include "mesh/mesh.h"
#include "postproc/displacements/displacement_field.h"

#include <cstddef>
#include <vector>

namespace pfdm {

/// A strip in which no point counts, as along a crack or an edge.
struct MaskedStrip {
  Vector from = Vector::Zero(), to = Vector::Zero();  ///< in the body [m]
  double within = 0.0;                                ///< distance from the line between them [m]
};

struct FieldSelection {
  std::vector<MaskedStrip> masked{};
  std::size_t most = 400;  ///< places in a frame
  bool drops_outliers = true;
};

/// The data of a field. Points that lie beyond the mesh by more than 1e-4 of its size, or in a masked strip, do not
/// count. Outliers (outliers_of) do not either. Where more
/// points are left than wanted, squares of the plane are places: means over the same points are taken of what is
/// computed. A frame with less than three places is left out. New places come behind those of `places`. Throws
/// InputError where nothing is left.
MeasuredField selected_field(const RecordedField& recorded, const FieldSelection& how, const Mesh& mesh,
                             std::vector<FieldPlace>& places);

}  // namespace pfdm
