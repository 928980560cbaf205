#pragma once
// Fields of a frame for the tests: of a sound body, and of one that has opened across a band of broken cells.

#include "solver/fracture/model/state.h"

#include <algorithm>
#include <cmath>

namespace pfdm::test {

inline OutputFields sound_fields(const Mesh& mesh) {
  const std::size_t n = mesh.n_cells();
  return {.displacement = CellField<Vector>(n),
          .damage = CellField<double>(n),
          .stress = CellField<Tensor>(n),
          .strain = CellField<Tensor>(n),
          .gradient = CellField<Tensor>(n),
          .energy_density = CellField<double>(n),
          .driving_energy = CellField<double>(n),
          .fracture_energy_density = CellField<double>(n),
          .traction = {}};
}

// Cells with their centre above move by w, those within the band are broken and stretch.
inline OutputFields opened_fields(const Mesh& mesh, const Vector& normal, double band, const Vector& w) {
  OutputFields output = sound_fields(mesh);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double height = normal.dot(mesh.cell_centre[c]);
    output.displacement[c] = std::clamp(0.5 + 0.5 * height / band, 0.0, 1.0) * w;
    if (std::abs(height) >= band) continue;
    output.damage[c] = 1.0;
    output.gradient[c] = w * normal.transpose() / (2.0 * band);
  }
  return output;
}

}  // namespace pfdm::test
