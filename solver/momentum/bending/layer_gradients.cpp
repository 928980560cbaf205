#include "solver/momentum/bending/layer_gradients.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

// The least stiffness factor over the greatest one on the lines of a cell.
double LayerGradients::least_factor_ratio(const Cell& in, const CellField<double>& g) const {
  double least = g[in.cell], most = least;
  for (std::size_t k = lines_[in.first_line].first_slope; k < lines_[in.end_line - 1].end_slope; ++k)
    for (const std::size_t at : {slopes_[k].from, slopes_[k].to})
      if (at < as_size(g.size())) {
        least = std::min(least, g[at]);
        most = std::max(most, g[at]);
      }
  return least / most;
}

double LayerGradients::part_of(double factor_ratio) {
  constexpr double steepness = 4.0;
  return std::max(0.0, 1.0 - steepness * (1.0 - factor_ratio));
}

void LayerGradients::weigh(const CellField<double>& g) {
  counts_ = !cells_.empty();
  parallel_for(count_of(cells_), [&](Index i) {
    Cell& in = cells_[i];
    if (in.first_line == in.end_line) return;
    in.weight = part_of(least_factor_ratio(in, g));
    counting_[in.cell] = in.weight;
  });
  parallel_for(count_of(surfaces_), [&](Index i) {
    Surface& at = surfaces_[i];
    const double here = g[at.cell], there = g[at.next];
    at.weight =
        std::min({counting_[at.cell], counting_[at.next], part_of(std::min(here, there) / std::max(here, there))});
  });
  parallel_for(count_of(weights_), [&](Index i) {
    const auto& [P, N] = cells_of_link_[i];
    if (is_weighed_[i] == 0) return;
    const double counts = std::min(counting_[P], counting_[N]);
    weights_[i] = counts * sound_weights_[i] + (1.0 - counts) * Tensor::Identity();
  });
  curvature_.weigh(counting_);
}

std::vector<std::size_t> LayerGradients::surface_sides() const {
  std::vector<std::size_t> sides;
  for (const Surface& at : surfaces_) sides.push_back(at.side);
  return sides;
}

void LayerGradients::correct(const std::vector<Vector>& u, CellField<Tensor>& gradients,
                             std::vector<Tensor>& changes) const {
  parallel_for(count_of(cells_), [&](Index i) {
    const Cell& in = cells_[i];
    if (in.weight == 0.0) return;
    Tensor& G = gradients[in.cell];
    const Tensor of_one_ring = G;
    for (std::size_t l = in.first_line; l < in.end_line; ++l) {
      const Line& line = lines_[l];
      const auto difference = [&](std::size_t k) -> Vector {
        return u[slopes_[k].to] - u[slopes_[k].from] - of_one_ring * slopes_[k].step;
      };
      Vector change = Vector::Zero();
      for (std::size_t k = line.first_slope; k < line.end_slope; ++k)
        change += slopes_[k].weight_over_length * difference(k);
      for (std::size_t h = line.first_held; h < line.end_held; ++h)
        for (std::size_t k = line.first_slope; k < line.end_slope; ++k)
          change += held_[h].change[k - line.first_slope] * (held_[h].part * difference(k));
      G += in.weight * change * line.along.transpose();
    }
  });
  parallel_for(count_of(surfaces_), [&](Index i) {
    const Surface& at = surfaces_[i];
    const Tensor more = at.weight * at.ratio * (gradients[at.cell] - gradients[at.next]);
    Tensor& change = changes[at.side];
    change = more - more * at.n * at.n.transpose();
    if (at.first_slope == at.end_slope) return;
    Vector sum = Vector::Zero();
    for (std::size_t k = at.first_slope; k < at.end_slope; ++k)
      sum += slopes_[k].weight_over_length *
             (u[slopes_[k].to] - u[slopes_[k].from] - gradients[at.cell] * slopes_[k].step);
    const Vector slope = at.weight * (at.of_slopes * sum) - change * at.along;
    change += at.across * slope * at.n.transpose() / at.n.dot(at.along);
  });
  curvature_.add(gradients, changes);
}

}  // namespace pfdm
