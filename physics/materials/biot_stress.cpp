#include "physics/materials/biot_stress.h"

#include "physics/elasticity/principal.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Principal forces by the principal H, and their slopes: rows and columns 0, 4, 8 of the tangent.
struct PrincipalForces {
  double energy = 0.0;
  Vector force;
  Tensor slope;
};

PrincipalForces principal_forces(const HyperelasticMaterial& material, const Vector& H) {
  const PotentialAt at = material.potential(H.asDiagonal());
  PrincipalForces result{.energy = at.energy, .force = at.stress.diagonal(), .slope = Tensor::Zero()};
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) result.slope(i, j) = at.tangent(4 * i, 4 * j);
  return result;
}

// Newton's method from H, which it leaves at the principal forces that are wanted. Steps change no stretch by more than
// a fifth.
bool find_stretches(const HyperelasticMaterial& material, const Vector& wanted, Vector& H) {
  constexpr int most_steps = 50;
  constexpr double precision = 1e-10, longest = 0.2;
  for (int k = 0; k < most_steps; ++k) {
    const PrincipalForces at = principal_forces(material, H);
    const Vector missing = wanted - at.force;
    if (!missing.allFinite()) return false;
    if (missing.norm() <= precision * wanted.norm()) return true;
    const Vector step = at.slope.fullPivLu().solve(missing);
    const double relative = step.cwiseAbs().cwiseQuotient(Vector::Ones() + H).maxCoeff();
    if (!std::isfinite(relative)) return false;
    H += std::min(1.0, longest / relative) * step;
  }
  return false;
}

}  // namespace

// U^-1 F^T P, which is R^T P of any F that is not singular.
Tensor biot_stress(const Tensor& H, const Tensor& P) {
  const Tensor F = Tensor::Identity() + H;
  const PrincipalAxes axes = principal_axes(symmetric_part(F.transpose() * F));
  constexpr double least_square = 1e-12;  // of a stretch
  const Vector inverse = axes.value.cwiseMax(least_square).cwiseSqrt().cwiseInverse();
  return symmetric_part(axes.direction * inverse.asDiagonal() * axes.direction.transpose() * F.transpose() * P);
}

double energy_at_biot_stress(const HyperelasticMaterial& material, const Vector& principal) {
  constexpr int n_parts = 20;
  Vector H = Vector::Zero();
  for (int k = 1; k <= n_parts; ++k)
    if (!find_stretches(material, (double(k) / n_parts) * principal, H))
      throw InputError(
          fmt::format("a material of the law \"{}\" does not reach the principal Biot stresses {:.4g}, {:.4g}, {:.4g} "
                      "Pa: its stress has a maximum before; a lower strength is required",
                      material.name(), principal[0], principal[1], principal[2]));
  return principal_forces(material, H).energy;
}

Tensor stretch_part(const Tensor& F) {
  constexpr double least = 0.1;
  const Eigen::SelfAdjointEigenSolver<Tensor> C(F.transpose() * F);
  Vector part;
  for (Index i = 0; i < 3; ++i) part[i] = 1.0 - 1.0 / std::max(std::sqrt(std::max(C.eigenvalues()[i], 0.0)), least);
  return F * C.eigenvectors() * part.asDiagonal() * C.eigenvectors().transpose();
}

}  // namespace pfdm
