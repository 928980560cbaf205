#include "mesh/point_bounds.h"

#include <fmt/format.h>

#include "physics/error.h"

namespace pfdm {

void require_bounded(const std::vector<Vector>& points, const std::string& body) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector& x = points[i];
    if ((x.array().abs() <= farthest_point).all()) continue;
    throw InputError(
        fmt::format("{} has point {} at ({:.3g}, {:.3g}, {:.3g}) m; coordinates may be up to {:g} m: is the unit of "
                    "length right, and the file whole?",
                    body, i, x[0], x[1], x[2], farthest_point));
  }
}

}  // namespace pfdm
