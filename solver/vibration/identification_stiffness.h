#pragma once
// The complex stiffness of a linear sample from random vibration: from the frequency response H = Z''/Y'' of the mass
// follows K = m omega^2 (1 + 1/H), and k + j omega c + j omega sum beta/(alpha + j omega), all parameters positive (so
// passive), is fitted to H by maximum likelihood, every frequency weighted by its coherence.

#include "solver/vibration/identification.h"
#include "solver/vibration/signals_spectra.h"

namespace pfdm {

struct StiffnessFit {
  MassMaterial model;
  double bic = 0.0;
  double chi2 = 0.0;  ///< mean square of the weighted residuals; 1 where the model and the variances are right
  bool converged = false;
};

/// Frequency responses of all records averaged by their segments; `order` kernel terms on z'.
StiffnessFit fit_stiffness(const Spectra& spectra, double mass, double low, double high, int order);

struct StiffnessIdentification {
  StiffnessFit fit;
  std::vector<OrderTrial> orders;
};
/// Orders from 0 on until BIC no longer falls.
StiffnessIdentification identify_stiffness(std::span<const VibrationRecord> records,
                                           const IdentificationSettings& settings);

}  // namespace pfdm
