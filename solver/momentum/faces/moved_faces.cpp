#include "solver/momentum/faces/moved_faces.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

Vector triangle(const Vector& a, const Vector& b, const Vector& apex) { return 0.5 * (a - apex).cross(b - apex); }

}  // namespace

void MovedFaces::weigh(const CellField<double>& g) {
  parallel_for(count_of(corners_), [&](Index k) {
    const Corner& corner = corners_[k];
    const auto normalise = [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t s = begin; s < end; ++s) sum += samples_[s].weight;
      return sum;
    };
    constexpr double least = 1e-3;  // of the largest distance: an apex may be the centre of a face
    double largest = 1e-9;          // [m]: where there is only one face, of which it is the centre
    for (std::size_t s = corner.begin; s < corner.end; ++s) largest = std::max(largest, samples_[s].d.norm());
    for (std::size_t s = corner.begin; s < corner.end; ++s)
      samples_[s].weight = g[samples_[s].cell] / std::max(samples_[s].d.norm(), least * largest);
    const double all = normalise(corner.begin, corner.end);
    for (std::size_t s = corner.begin; s < corner.end; ++s) samples_[s].weight /= all;
    for (std::size_t h = corner.first_hold; h < corner.end_of_holds; ++h)
      holds_[h].sum = normalise(holds_[h].begin, holds_[h].end);
  });
}

Vector MovedFaces::mean(const Field& by, std::size_t begin, std::size_t end) const {
  Vector sum = Vector::Zero();
  for (std::size_t s = begin; s < end; ++s) {
    const Sample& of = samples_[s];
    const Tensor& H = of.bonded < 0 ? by.gradients[of.cell] : by.bonded_gradients[of.bonded];
    sum += of.weight * (by.u[of.node] + H * of.d);
  }
  return sum;
}

// Points of faces that glide stay on their surface, whatever the gradients of the cells say of it.
Vector MovedFaces::held(const Field& by, const Hold& hold) const {
  if (!hold.glides) return mean(by, hold.begin, hold.end) / hold.sum;
  Vector sum = Vector::Zero();
  for (std::size_t s = hold.begin; s < hold.end; ++s) sum += samples_[s].weight * by.u[samples_[s].node];
  for (std::size_t r = hold.first_rise; r < hold.end_rise; ++r) {
    const Sample& from = samples_[rises_[r].sample];
    sum += from.weight * rises_[r].part * (by.u[rises_[r].node] - by.u[from.node]);
  }
  return sum / hold.sum;
}

void MovedFaces::move(const Field& by, std::vector<Vector>& moves) const {
  moves.resize(corners_.size());
  parallel_for(count_of(corners_), [&](Index k) {
    const Corner& corner = corners_[k];
    Vector u = mean(by, corner.begin, corner.end);
    for (std::size_t h = corner.first_hold; h < corner.end_of_holds; ++h) {
      const Hold& hold = holds_[h];
      u += hold.directions * (held(by, hold) - u);
    }
    moves[k] = turns_.empty() ? u : (turns_[k] * u).eval();
  });
}

// Calls f(a, b, apex of the places, a, b, apex of the moves, number of the triangle) of each triangle.
void MovedFaces::each_triangle(const Loop& loop, const std::vector<Vector>& moves, const auto& at,
                               const auto& f) const {
  const std::size_t n = loop.end - loop.begin;
  Vector apex = Vector::Zero(), apex_move = Vector::Zero();
  if (loop.apex >= 0) {
    apex = at(loop.apex), apex_move = moves[loop.apex];
  } else {
    for (std::size_t k = loop.begin; k < loop.end; ++k) {
      apex += at(loop_corners_[k]) / double(n);
      apex_move += moves[loop_corners_[k]] / double(n);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Index a = loop_corners_[loop.begin + k], b = loop_corners_[loop.begin + (k + 1) % n];
    f(at(a), at(b), apex, moves[a], moves[b], apex_move, loop.begin + k);
  }
}

Vector MovedFaces::area_change(const Loop& loop, const std::vector<Vector>& moves) const {
  const std::size_t n = loop.end - loop.begin;
  if (n == 0) return Vector::Zero();
  Vector change = Vector::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    const Index a = loop_corners_[loop.begin + k], b = loop_corners_[loop.begin + (k + 1) % n];
    change += moves[a].cross(place_in(loop, b)) + place_in(loop, a).cross(moves[b]);
  }
  return (0.5 / loop.size) * change;
}

Vector MovedFaces::area_change(std::size_t i, const std::vector<Vector>& moves) const {
  return area_change(loops_[i], moves);
}

double MovedFaces::section_change(Index cell, const std::vector<Vector>& moves) const {
  const Index k = section_of_cell_[cell];
  if (k < 0) return 0.0;
  const Loop& loop = sections_[k];
  return loop.area.normalized().dot(area_change(loop, moves));
}

void MovedFaces::place(const std::vector<Vector>& moves) {
  at_ = moves;
  const auto find_area = [&](Loop& loop) {
    const std::size_t n = loop.end - loop.begin;
    Vector area = Vector::Zero();
    for (std::size_t k = 0; k < n; ++k)
      area +=
          place_in(loop, loop_corners_[loop.begin + k]).cross(place_in(loop, loop_corners_[loop.begin + (k + 1) % n]));
    if (n > 0) loop.area = (0.5 / loop.size) * area;
  };
  parallel_for(count_of(loops_), [&](Index i) { find_area(loops_[i]); });
  parallel_for(count_of(sections_), [&](Index i) { find_area(sections_[i]); });
}

void MovedFaces::follow(const std::vector<Vector>& u_face) {
  parallel_for(count_of(loops_), [&](Index i) {
    Loop& loop = loops_[i];
    if (loop.begin == loop.end) return;
    loop.gap = u_face[i];
    each_triangle(
        loop, at_, [&](Index c) { return place_in(loop, c); },
        [&](const auto&, const auto&, const auto&, const Vector& a, const Vector& b, const Vector& apex,
            std::size_t t) { loop.gap -= (shares_[t] / 3.0) * (a + b + apex); });
  });
}

double MovedFaces::flux(std::size_t i, const std::vector<Vector>& moves, const Vector& u_face,
                        const Vector& area_change) const {
  const Loop& loop = loops_[i];
  if (loop.begin == loop.end) return 0.0;
  double between = 0.0;
  Vector gap = u_face;
  each_triangle(
      loop, moves, [&](Index c) { return place_in(loop, c); },
      [&](const Vector& A, const Vector& B, const Vector& C, const Vector& a, const Vector& b, const Vector& c,
          std::size_t t) {
        const Vector mean = (a + b + c) / 3.0;
        between += mean.dot(triangle(A, B, C));
        gap -= shares_[t] * mean;
      });
  return between + loop.size * (gap.dot(loop.area) + loop.gap.dot(area_change));
}

// Along straight paths the area of a triangle is of second degree in time: Simpson's rule is exact.
double MovedFaces::swept(std::size_t i, const std::vector<Vector>& moves, const Vector& u_face) const {
  const Loop& loop = loops_[i];
  if (loop.begin == loop.end) return 0.0;
  double between = 0.0;
  Vector gap = u_face;
  each_triangle(
      loop, moves, [&](Index c) -> Vector { return corners_[c].point - loop.centre; },
      [&](const Vector& A, const Vector& B, const Vector& C, const Vector& a, const Vector& b, const Vector& c,
          std::size_t t) {
        const Vector mean = (a + b + c) / 3.0, end = triangle(A + a, B + b, C + c);
        const Vector middle = triangle(A + 0.5 * a, B + 0.5 * b, C + 0.5 * c);
        between += mean.dot(triangle(A, B, C) + 4.0 * middle + end) / 6.0;
        gap -= shares_[t] * mean;
      });
  return between + loop.size * gap.dot(loop.area);
}

}  // namespace pfdm
