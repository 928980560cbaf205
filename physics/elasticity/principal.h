#pragma once
// Symmetric tensors that are isotropic functions of another, given by its principal values: sigma = sum_i
// sigma_i(eps_1, eps_2, eps_3) n_i (x) n_i, and their derivative (Carlson, Hoger, J. Elasticity 16 (1986) 221), also
// where principal values are equal.

#include "physics/elasticity/mandel.h"

namespace pfdm {

/// Principal values [-] in ascending order and their unit directions, the columns.
struct PrincipalAxes {
  Vector value;
  Tensor direction;
};
PrincipalAxes principal_axes(const Tensor& a);

/// Principal stresses [Pa] at some principal strains, and their slopes d sigma_i / d eps_j [Pa], symmetric.
struct PrincipalStress {
  Vector stress = Vector::Zero();
  Tensor slope = Tensor::Zero();
};

/// d sigma / d eps [Pa] at the strain of these axes; symmetric.
MandelMatrix tangent(const PrincipalAxes& strain, const PrincipalStress& sigma);

}  // namespace pfdm
