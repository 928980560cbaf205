#include "solver/dynamics/mode_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm {

std::optional<HalfWaves> fewest_cells_to_half_wave(const VibratingBody& body, const Mode& mode) {
  const Mesh& mesh = body.mesh();
  std::array<double, 3> of_steps{}, of_cells{};
  const auto is_hexahedron = [&](Index c) { return mesh.shape[c] == CellShape::hexahedron; };
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const Index a = mesh.owner[f], b = mesh.neighbour[f];
    if (!is_hexahedron(a) || !is_hexahedron(b)) continue;
    const auto u_a = mode.shape.segment<3>(3 * Eigen::Index{a}), u_b = mode.shape.segment<3>(3 * Eigen::Index{b});
    Index axis = 0;
    mesh.face_area[f].cwiseAbs().maxCoeff(&axis);
    of_steps[axis] += (u_a - u_b).squaredNorm();
    of_cells[axis] += 0.5 * (u_a.squaredNorm() + u_b.squaredNorm());
  }
  std::optional<HalfWaves> fewest;
  for (Index axis = 0; axis < 3; ++axis) {
    if (!(of_steps[axis] > 0.0)) continue;
    const double phase = 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(of_steps[axis] / of_cells[axis])));
    const double cells = std::numbers::pi / phase;
    if (!fewest || cells < fewest->cells) fewest = HalfWaves{axis, cells};
  }
  return fewest;
}

double most_error_by_half_waves(double cells) {
  const double squared = std::pow(std::numbers::pi / cells, 2);
  return 0.2 * squared / (1.0 + 0.3 * squared);
}

}  // namespace pfdm
