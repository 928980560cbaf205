#pragma once
// The points of a grid of VTK, some of which the cells around them have more than once.

#include "postproc/fields/vtu_writer.h"

#include <vtkUnstructuredGrid.h>

#include <vector>

namespace pfdm {

/// Gives cells copies of points and all points the array "displacement" [m]. `number` is that in the grid of each of
/// the mesh's points, -1 for those that no cell uses. Throws InputError if there are more displacements or fewer.
void add_split_points(vtkUnstructuredGrid& frame, const SplitPoints& split, const std::vector<vtkIdType>& number);

}  // namespace pfdm
