#include "mesh/generators/expected_cells.h"

#include "physics/error.h"
#include "physics/system/machine_limits.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace pfdm {

void require_memory_for(double cells, const std::string& what) {
  constexpr double bytes_of_a_cell = 5.7e3;  // of a run, by its three faces; what `check` says
  if (cells * 24.0 > std::numeric_limits<Index>::max())
    throw InputError(fmt::format("{} would have about {:.3g} cells, too many to number", what, cells));
  require_memory(bytes_of_a_cell * cells, fmt::format("{} of about {:.3g} cells", what, cells));
}

double expected_tetrahedra(const SizeField& size, const Vector& lower, const Vector& upper) {
  constexpr int n = 20;                          // points along each edge of the box
  const double regular = std::sqrt(2.0) / 12.0;  // volume of a tetrahedron of unit edge
  const Vector step = (upper - lower) / n;
  double cells = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vector at = lower + step.cwiseProduct(Vector(i + 0.5, j + 0.5, k + 0.5));
        cells += step.prod() / (regular * std::pow(size(at), 3));
      }
  return cells;
}

}  // namespace pfdm
