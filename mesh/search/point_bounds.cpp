#include "mesh/search/point_bounds.h"

#include <fmt/format.h>

#include "physics/error.h"
#include "physics/quantity_text.h"

namespace pfdm {

void require_bounded(const std::vector<Vector>& points, const std::string& body) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector& x = points[i];
    if ((x.array().abs() <= farthest_point).all()) continue;
    throw InputError(
        fmt::format("{} has point {} at {}; coordinates may be up to {}: is the unit of length "
                    "right, and the file whole?",
                    body, i, point_text(x), quantity_text(farthest_point, "m", 6)));
  }
}

}  // namespace pfdm
