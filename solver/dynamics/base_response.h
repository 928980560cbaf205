#pragma once
// Harmonic response to a moving base. The base has the acceleration exp(i omega t) along d; u is the displacement
// relative to it:
//
//   (c K - omega^2 M) u = -M d,   u = -(1/c) (I - s A)^-1 A d,   s = omega^2/c,
//
// with the complex factor c of the modulus (real part: storage, imaginary part: loss, over the modulus of K) and A =
// K^-1 M. All frequencies and moduli share one Krylov space of A. Per unit of the base's acceleration throughout.

#include "solver/dynamics/krylov_space.h"

#include <complex>
#include <span>

namespace pfdm {

/// A frequency and the modulus that the body has there.
struct Harmonic {
  double omega = 0.0;           ///< [rad/s], positive
  std::complex<double> factor;  ///< c, imaginary part not negative
  std::complex<double> s() const { return omega * omega / factor; }
};

class BaseResponse {
 public:
  /// `direction` a unit vector. The space is extended until the residual is at most `tolerance` of A d at all of
  /// `wanted`. Throws ComputationError if that takes more than `most_vectors`.
  BaseResponse(const VibratingBody& body, const Vector& direction, std::span<const Harmonic> wanted,
               double tolerance = 1e-7, Eigen::Index most_vectors = 200);
  /// Extends the space as far as the residual at all of these asks for. Throws likewise.
  void reach(std::span<const Harmonic> wanted);

  /// u of all unknowns, pressures of the modulus of K included [m per m/s^2].
  Eigen::VectorXcd displacement(const Harmonic& at) const;
  /// Acceleration of an unknown over the base's, along the base's direction [-].
  std::complex<double> transmission(const Harmonic& at, Index unknown) const;
  /// Mean mechanical power that the base puts in [W per (m/s^2)^2]: 1/2 omega Im(d.M u).
  double power(const Harmonic& at) const;
  /// Residual at a frequency, relative to A d.
  double residual(const Harmonic& at) const;
  Eigen::Index dimension() const { return space_.n_projected(); }

 private:
  Eigen::VectorXcd weights(const Harmonic& at) const;

  const VibratingBody& body_;
  Vector direction_;
  KrylovSpace space_;
  double tolerance_;
  Eigen::Index most_vectors_;
  bool is_complete_ = false;
  Eigen::MatrixXd H_;
  Eigen::VectorXd mass_moment_;  // d.M v of each vector
};

/// Twice the mean strain energy of the motion exp(i omega t) u in each cell at the modulus of K: Re(sigma:conj(eps))
/// over the cell, per volume [J/m^3]. The heat source is 1/2 omega Im(c) times it.
CellField<double> strain_power(const VibratingBody& body, const Eigen::VectorXcd& u);

}  // namespace pfdm
