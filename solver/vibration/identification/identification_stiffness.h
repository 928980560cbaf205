#pragma once
// The complex stiffness of a linear sample from random vibration: from the frequency response H = Z''/Y'' of the mass
// follows K = m omega^2 (1 + 1/H), and k + j omega c + j omega sum beta/(alpha + j omega), all parameters positive (so
// passive), is fitted to H by maximum likelihood, every frequency weighted by its coherence.

#include "solver/vibration/identification/identification_values.h"
#include "solver/vibration/signals/signals_spectra.h"

#include <optional>

namespace pfdm {

/// Samples in the segments of the records' spectra: 8192, or the largest power of two that leaves sixteen of them, end
/// to end, in the shortest record. None if so short ones resolve fewer than 100 frequencies of what all records excite,
/// or if the records differ in their sampling rate.
std::optional<Eigen::Index> segment_length(std::span<const VibrationRecord> records);

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
/// Orders from 0 on until BIC no longer falls. Segments shorter than 8192 samples blur the resonance by more than noise
/// does: the estimates are then near, but their BIC does not tell the order.
StiffnessIdentification identify_stiffness(std::span<const VibrationRecord> records,
                                           const IdentificationSettings& settings);

/// Of this order alone.
StiffnessFit fit_stiffness(std::span<const VibrationRecord> records, int order, const IdentificationSettings& settings);

}  // namespace pfdm
