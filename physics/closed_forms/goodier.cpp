#include "physics/closed_forms/goodier.h"

#include <cmath>

namespace pfdm {

// Outside, with w = e x and q = x.e x:
//   u = swell0 x + C x/r^3 + w + A (2 (1-2nu) w/r^3 + 3 q x/r^5) + B (2 w/r^5 - 5 q x/r^7);
// inside u = swell x + share w. Continuity of displacement and traction at r = R gives the five constants.
Goodier::Goodier(IsotropicElasticity inclusion, IsotropicElasticity matrix, double radius, double stress)
    : inclusion_(inclusion), matrix_(matrix), radius_(radius) {
  const double mu = matrix.mu;
  const double k = 1.0 - 2.0 * matrix.poisson_ratio();
  deviator_ = (stress / (6.0 * mu)) * Vector(-1.0, -1.0, 2.0).asDiagonal().toDenseMatrix();
  remote_swell_ = stress / (9.0 * matrix.bulk_modulus());
  swell_ = (stress / 3.0 + 4.0 * mu * remote_swell_) / (3.0 * inclusion.bulk_modulus() + 4.0 * mu);
  const double R3 = radius * radius * radius;
  C_ = (swell_ - remote_swell_) * R3;
  const double share_of_A = 2.0 * k + 6.0 / 5.0;
  const double traction_of_A = -2.0 * k - 18.0 / 5.0;
  const double A = 2.0 * (mu - inclusion.mu) / (2.0 * inclusion.mu * share_of_A - mu * traction_of_A);
  share_ = 1.0 + share_of_A * A;
  A_ = A * R3;
  B_ = 0.6 * A * R3 * radius * radius;
}

Vector Goodier::displacement(const Vector& x) const {
  const Vector w = deviator_ * x;
  if (inside(x)) return swell_ * x + share_ * w;
  const double k = 1.0 - 2.0 * matrix_.poisson_ratio();
  const double r = x.norm(), r3 = r * r * r, r5 = r3 * r * r, q = x.dot(w);
  const double f = 1.0 + 2.0 * k * A_ / r3 + 2.0 * B_ / r5;
  const double g = 3.0 * A_ / r5 - 5.0 * B_ / (r5 * r * r);
  return f * w + (g * q + remote_swell_ + C_ / r3) * x;
}

Tensor Goodier::gradient(const Vector& x) const {
  if (inside(x)) return swell_ * Tensor::Identity() + share_ * deviator_;
  return matrix_gradient(x);
}

Tensor Goodier::matrix_gradient(const Vector& x) const {
  const Vector w = deviator_ * x;
  const double k = 1.0 - 2.0 * matrix_.poisson_ratio();
  const double r2 = x.squaredNorm(), r = std::sqrt(r2), r3 = r * r2, r5 = r3 * r2, r7 = r5 * r2, q = x.dot(w);
  const double f = 1.0 + 2.0 * k * A_ / r3 + 2.0 * B_ / r5;
  const double g = 3.0 * A_ / r5 - 5.0 * B_ / r7;
  const double f_slope = -6.0 * k * A_ / r5 - 10.0 * B_ / r7;  // (df/dr)/r
  const double g_slope = -15.0 * A_ / r7 + 35.0 * B_ / (r7 * r2);
  const double h_slope = -3.0 * C_ / r5;
  return f_slope * w * x.transpose() + f * deviator_ + (g_slope * q + h_slope) * x * x.transpose() +
         2.0 * g * x * w.transpose() + (g * q + remote_swell_ + C_ / r3) * Tensor::Identity();
}

Tensor Goodier::stress(const Vector& x) const {
  return pfdm::stress(inside(x) ? inclusion_ : matrix_, symmetric_part(gradient(x)));
}

double Goodier::interface_normal_traction(double cos_polar_angle) const {
  const double legendre = 0.5 * (3.0 * cos_polar_angle * cos_polar_angle - 1.0);
  return 3.0 * inclusion_.bulk_modulus() * swell_ + 2.0 * inclusion_.mu * share_ * deviator_(2, 2) * legendre;
}

}  // namespace pfdm
