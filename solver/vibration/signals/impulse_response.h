#pragma once
// The exponentials in a sampled impulse response, g(t) = sum beta exp(-alpha t), of a conjugate pair 2 Re[beta
// exp(-alpha t)]: poles by the matrix pencil (Hua, Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38 (1990) 814),
// and from there by least squares over the poles alone, as the weights are linear (Golub, Pereyra, SIAM J. Numer. Anal.
// 10 (1973) 413); under white noise that is the likeliest sum.

#include "physics/point/mass_material.h"

#include <Eigen/Core>

#include <vector>

namespace pfdm {

struct ImpulseFit {
  std::vector<HereditaryTerm> terms;  ///< poles that do not decay are left out
  int order = 0;                      ///< number of poles that were looked for, a pair counting two
  double misfit = 0.0;                ///< norm of what is left over that of g
};

/// `g`: samples at t = 0, 1/rate ... (at least 12). `order` 0: as many poles as singular values of the samples' Hankel
/// matrix stand out from their median (Gavish, Donoho, IEEE Trans. Inf. Theory 60 (2014) 5040, eq. 5). Throws
/// InputError for fewer samples than three times the order, or none that differs from zero.
ImpulseFit matrix_pencil(const Eigen::VectorXd& g, double rate, int order = 0);

/// The same, then least squares. Of the orders up to that one it takes the one with the least Bayesian information
/// criterion.
ImpulseFit fit_impulse_response(const Eigen::VectorXd& g, double rate, int order = 0);

}  // namespace pfdm
