#pragma once
// Points that TetGen needed to recover a surface, and has then lifted off it by next to nothing (Si, ACM Trans. Math.
// Softw. 41 (2015) 11, section 3.2): the cells around such a point are thousands of times as long as thick. They are
// moved to where the worst of the cells around them is best.

#include <cstddef>

#include "mesh/generators/tetgen_wrapper.h"

namespace pfdm {

/// Of the points from number `first` on, which lie on no surface: those are moved that are nearer to another point than
/// a hundredth of the mean distance from those around them. Cells keep their points and positive volumes.
void settle_lifted_points(std::size_t first, TetgenOutput& mesh);

}  // namespace pfdm
