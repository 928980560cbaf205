#pragma once
// The body of a run whose frames say how its cells move, in a vibration, and not its points.

#include "postproc/browser/body.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

/// A field of the frames.
struct CellFieldShown {
  std::string array;    ///< its name in the files
  std::string name;     ///< for people
  std::string si_unit;  ///< "K"; empty: none
};

struct CellBodySettings {
  std::vector<BodyFrame> frames;  ///< in the order of their steps; at least one
  std::vector<CellFieldShown> fields;
  /// Arrays with the parts of the displacement, which the last frame tells [m]; empty: the body stands still.
  std::string real, imaginary;
  int component = 2;         ///< direction of the motion
  Index most_cells = 50000;  ///< as in BodySettings
};

/// Throws InputError for files that are no frames of one run.
Body read_cell_body(const CellBodySettings& settings);

/// What points do whose cells do that: the mean of u_c + G_c (x - x_c) over the cells of a point, where G_c fits the
/// cells that share a point with c best. Exact where the displacement is linear. `cells`: points of each cell's
/// corners.
std::vector<Vector> displacement_of_points(const std::vector<Vector>& points,
                                           const std::vector<std::vector<Index>>& cells,
                                           const std::vector<Vector>& displacement);

}  // namespace pfdm
