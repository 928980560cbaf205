#include "solver/momentum/finite_strain/turned_weights.h"

#include "solver/momentum/finite_strain/polar_parts.h"

namespace pfdm {
namespace {

// v x, as a matrix.
Tensor cross_with(const Vector& v) {
  Tensor by;
  by << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return by;
}

}  // namespace

TurnedWeights::TurnedWeights(const LayerGradients& layers, std::size_t n_links) : layers_(layers) {
  if (!layers.any()) return;
  number_.assign(n_links, -1);
  for (std::size_t i = 0; i < n_links; ++i) {
    if (!layers.weighs(i)) continue;
    number_[i] = count_of(turns_);
    turns_.emplace_back();
  }
}

void TurnedWeights::linearise(std::size_t link, const Tensor& F_P, const Tensor& F_N, const Tensor& c,
                              const Vector& jump) {
  const Tensor F = 0.5 * (F_P + F_N);
  const PolarParts polar = polar_parts(F);
  Turn& turn = turns_[number_[link]];
  turn.R = polar.R;
  turn.weight = polar.R * layers_.weight(link) * polar.R.transpose();
  const Tensor by_turn = turn.weight * cross_with(jump) - cross_with(turn.weight * jump);
  const Tensor stretch = polar.U.trace() * Tensor::Identity() - polar.U;
  turn.by_axis = c * by_turn * polar.R * stretch.inverse();
  turn.initial = -change(link, F_P - Tensor::Identity(), F_N - Tensor::Identity());
}

Vector TurnedWeights::change(std::size_t link, const Tensor& H_P, const Tensor& H_N) const {
  const Turn& turn = of(link);
  const Tensor A = turn.R.transpose() * (0.5 * (H_P + H_N));
  return turn.by_axis * Vector(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
}

}  // namespace pfdm
