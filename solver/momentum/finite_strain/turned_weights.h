#pragma once
// Weights of the jump at faces across layers that bend (layer_gradients.h), at finite strain. The component that hardly
// counts is that across the layers as they are now: with the mean F of both cells, F = R U, the weights turn with R,
//
//   W = R W_0 R^T,   dW J = (w x) (W J) - W (w x J),   w = R (tr U 1 - U)^-1 a,   a x = R^T dF - dF^T R.
//
// W is exact where it is linearised; a rigid rotation changes nothing but the direction of the traction.

#include "solver/momentum/bending/layer_gradients.h"

#include <vector>

namespace pfdm {

class TurnedWeights {
 public:
  /// Weights of n_links links; for use while the layers exist.
  TurnedWeights(const LayerGradients& layers, std::size_t n_links);

  bool any() const { return !turns_.empty(); }
  bool turns(std::size_t link) const { return any() && number_[link] >= 0; }

  /// Linearises a link that turns(), about the deformation gradients F of both cells, the stiffness c of the jump
  /// [Pa/m], and the jump [m].
  void linearise(std::size_t link, const Tensor& F_P, const Tensor& F_N, const Tensor& c, const Vector& jump);
  /// W J: J itself at links that have no weights.
  Vector weigh(std::size_t link, const Vector& jump) const { return turns(link) ? of(link).weight * jump : jump; }
  /// Change of the traction by changes of F of both cells, c dW J [Pa], and its constant part.
  Vector change(std::size_t link, const Tensor& H_P, const Tensor& H_N) const;
  const Vector& initial(std::size_t link) const { return of(link).initial; }

 private:
  struct Turn {
    Tensor weight = Tensor::Identity(), R = Tensor::Identity();
    Tensor by_axis = Tensor::Zero();  // of a, to the traction [Pa]
    Vector initial = Vector::Zero();  // [Pa]
  };
  const Turn& of(std::size_t link) const { return turns_[number_[link]]; }

  const LayerGradients& layers_;
  std::vector<Index> number_;  // of each link; -1: none
  std::vector<Turn> turns_;
};

}  // namespace pfdm
