#pragma once
// Points of a measured field among those around them: how far apart they are, and which have gone astray.

#include "postproc/displacements/displacement_field.h"

#include <utility>
#include <vector>

namespace pfdm {

/// Which square of this side a point of the plane lies in.
using Square = std::pair<long, long>;
Square square_of(const Vector& p, double side);

/// Median distance of points of the plane from their nearest ones; 0 of fewer than two.
double spacing_of(const std::vector<Vector>& points);

/// Standard deviation of a component's noise [m], whatever slope and curvature the field has: about the surfaces of
/// second degree through the points of squares of 3.5 spacings, 9 to 16 of a grid. The median of the squares, so that
/// a crack does not count. 0 where none has more points than the surface has coefficients.
double noise_of(const RecordedFrame& frame, double spacing, int n_components);

/// Which points differ from the plane through those within 2.3 spacings of them by more than six standard deviations:
/// of the residuals around, or of all where these are larger (1.48 times their median). Beside a crack all residuals
/// around are large, and no point is an outlier. Points with fewer than six around them are none.
std::vector<bool> outliers_of(const RecordedFrame& frame, double spacing, int n_components);

}  // namespace pfdm
