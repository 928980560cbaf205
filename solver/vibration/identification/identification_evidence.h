#pragma once
// Whether what a model leaves of a record is noise: noise does not move with the test, an error of the model does.

#include "physics/point/mass_material.h"
#include "solver/vibration/identification/identification_traces.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct RecordEvidence {
  std::string name;
  double misfit = 0.0;  ///< norm of simulated less measured z'' over that of measured; infinite if it is unbounded
  bool swept = false;
  /// Rms of what moves with the test in the residual, over what noise alone would leave there. Under a swept sine: at
  /// the driving frequency and two harmonics. Otherwise: coherent with the base's acceleration, also as it grows over
  /// the test, and with the square and the cube of the displacement.
  double excess = 0.0;
  std::optional<Tone> tone{};      ///< in the residual, if it is no negligible one
  bool tone_is_resonance = false;  ///< it is of the mass's free motion
  std::optional<Burst> burst{};    ///< likewise; its time is that of the record
};
RecordEvidence record_evidence(const MassMaterial& model, const VibrationRecord& record, double crop);

/// Reasons against a model that was fitted to these records; none if all that is left is noise, or next to nothing.
/// Noise that is a third of the response is not credible. Tones and bursts are told by traces_in().
std::vector<std::string> doubts_of(std::span<const RecordEvidence> evidence);
/// What else than noise is left, of the records and not of the model.
std::vector<std::string> traces_in(std::span<const RecordEvidence> evidence);

}  // namespace pfdm
