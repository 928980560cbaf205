#include "mesh/generators/expected_cells.h"

#include "physics/error.h"
#include "physics/system/machine_limits.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace pfdm {

void require_memory_for(double cells, const std::string& what) {
  constexpr double bytes_of_a_cell = 5.7e3;  // of a run, by its three faces; what `check` says
  if (!(cells < most_cells))
    throw InputError(fmt::format("{} would have about {:.3g} cells, too many to number", what, cells));
  require_memory(bytes_of_a_cell * cells, fmt::format("{} of about {:.3g} cells", what, cells));
}

// Where a size is far below the distance of the points, they are taken closer: a single one may lie in a small sphere.
double expected_tetrahedra(const SizeField& size, const Vector& lower, const Vector& upper) {
  constexpr std::size_t most_looked_at = 200;
  const auto each_part = [](const Vector& from, const Vector& edges, int n, const auto& see) {
    const Vector step = edges / n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) see(Vector(from + step.cwiseProduct(Vector(i, j, k))), step);
  };
  const auto cells_in = [&](const Vector& from, const Vector& edges) {
    return edges.prod() / (regular_volume * std::pow(size(from + 0.5 * edges), 3));
  };
  double cells = 0.0;
  std::vector<Vector> fine;  // lower corners
  Vector edges = Vector::Zero();
  each_part(lower, upper - lower, 20, [&](const Vector& from, const Vector& step) {
    edges = step;
    if (size(from + 0.5 * step) < 0.25 * step.minCoeff())
      fine.push_back(from);
    else
      cells += cells_in(from, step);
  });
  const int closer = fine.size() <= most_looked_at ? 10 : 1;
  for (const Vector& from : fine)
    each_part(from, edges, closer, [&](const Vector& at, const Vector& step) { cells += cells_in(at, step); });
  return cells;
}

}  // namespace pfdm
