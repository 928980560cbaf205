#pragma once
// Records of an independent simulator with noise, and what an identification doubts of them.

#include "solver/vibration/diagnosis/identification_faults.h"
#include "solver/vibration/identification/identification_coordinates.h"
#include "solver/vibration/identification/identification_evidence.h"
#include "tests/solver/independent_simulators.h"
#include "tests/solver/mass_material_truth.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

inline const independent::Shaker sweep{};
inline const independent::Shaker random_motion{
    .duration = 20.0, .low = 20.0, .high = 850.0, .level = 60.0, .random = true};

inline VibrationRecord noisy_record(const char* name, const independent::Shaker& shaker, unsigned seed = 1) {
  VibrationRecord record = independent::record_of(independent::sample_of(truth(name)), shaker);
  independent::add_white_noise(record, 40.0, seed);
  return record;
}

struct Judged {
  std::vector<std::string> doubts, faults;
};

inline Judged judged(const VibrationRecord& record, const char* structure) {
  IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .replicates = 0};
  const Identification found = identify(std::span(&record, 1), model_structure(structure), settings);
  const RecordEvidence evidence = record_evidence(found.fit.model, record, settings.crop);
  Judged result{.doubts = doubts_of(std::span(&evidence, 1)), .faults = {}};
  const std::vector<double> misfit{evidence.misfit};
  result.faults = recognised_faults(std::span(&record, 1), misfit, model_structure(structure), settings);
  return result;
}

}  // namespace pfdm
