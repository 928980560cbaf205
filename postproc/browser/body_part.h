#pragma once
// The cells of a large body that are seen: those at its surface, and those at the planes that cut it.

#include "postproc/browser/body.h"
#include "postproc/fields/stored_cells.h"

#include <functional>
#include <span>
#include <vector>

namespace pfdm {

struct BodyPart {
  std::vector<Index> cells;              ///< numbers in the file
  std::vector<std::uint8_t> is_surface;  ///< as in Body
};

/// All cells, or of more than `most` those with a face at the surface or on a plane across an axis through `cut_at`
/// [m].
BodyPart part_of(const StoredCells& mesh, const std::vector<Vector>& points, const Vector& cut_at, Index most);

/// Cells and points of the part as they are before anything moves, without frames.
Body resting_body(const StoredCells& mesh, const BodyPart& part);

/// Calls `see` with the number of each cell and its corners, as they are in Body::corners.
void for_each_cell(const Body& body, const std::function<void(std::size_t, std::span<const Index>)>& see);

/// The same with each face, cell by cell, in VTK's order.
void for_each_face(const std::vector<std::uint8_t>& shapes, const std::vector<Index>& corners,
                   const std::vector<Index>& faces,
                   const std::function<void(std::size_t, std::span<const Index>)>& see);

}  // namespace pfdm
