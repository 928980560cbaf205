#include "mesh/generators/lifted_points.h"
#include "physics/portable_math.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double next_to_nothing = 0.01;

// Six times the volume over the cube of the root mean square edge.
double shape(const std::array<Vector, 4>& x) {
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) squares += (x[i] - x[j]).squaredNorm();
  return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / portable::pow(squares / 6.0, 1.5);
}

class Star {
 public:
  Star(Index centre, const std::vector<Index>& cells, TetgenOutput& mesh)
      : centre_(centre), cells_(cells), mesh_(mesh) {}

  bool is_lifted() const {
    double nearest = std::numeric_limits<double>::infinity(), sum = 0.0;
    for (const Index t : cells_)
      for (const Index p : mesh_.tetrahedra[t]) {
        const double distance = (mesh_.points[p] - mesh_.points[centre_]).norm();
        if (p != centre_) nearest = std::min(nearest, distance);
        sum += distance;
      }
    return nearest < next_to_nothing * sum / (3.0 * static_cast<double>(cells_.size()));
  }

  // Steps along the edges, the diagonals of sides and those of a cube, halved where none is better.
  void settle() {
    constexpr double least_step = 1e-3;
    Vector at = mesh_.points[centre_];
    double best = worst_shape(at);
    const double size = extent();
    for (double step = 0.5 * size; step > least_step * size;) {
      Vector next = at;
      for (int k = 0; k < 27; ++k) {
        const int along_x = k % 3 - 1, along_y = k / 3 % 3 - 1, along_z = k / 9 - 1;
        const Vector candidate = at + step * Vector(along_x, along_y, along_z);
        if (const double quality = worst_shape(candidate); quality > best) {
          best = quality;
          next = candidate;
        }
      }
      if (next == at) step *= 0.5;
      at = next;
    }
    mesh_.points[centre_] = at;
  }

 private:
  double worst_shape(const Vector& at) const {
    double worst = std::numeric_limits<double>::infinity();
    for (const Index t : cells_) {
      std::array<Vector, 4> x;
      for (std::size_t i = 0; i < 4; ++i) {
        const Index p = mesh_.tetrahedra[t][i];
        x[i] = p == centre_ ? at : mesh_.points[p];
      }
      worst = std::min(worst, shape(x));
    }
    return worst;
  }

  double extent() const {
    double most = 0.0;
    for (const Index t : cells_)
      for (const Index p : mesh_.tetrahedra[t]) most = std::max(most, (mesh_.points[p] - mesh_.points[centre_]).norm());
    return most;
  }

  Index centre_;
  const std::vector<Index>& cells_;
  TetgenOutput& mesh_;
};

}  // namespace

void settle_lifted_points(std::size_t first, TetgenOutput& mesh) {
  std::vector<std::vector<Index>> cells(mesh.points.size() - first);  // around each of those points
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const Index p : mesh.tetrahedra[t])
      if (as_size(p) >= first) cells[p - first].push_back(static_cast<Index>(t));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Star star(static_cast<Index>(first + i), cells[i], mesh);
    if (star.is_lifted()) star.settle();
  }
}

}  // namespace pfdm
