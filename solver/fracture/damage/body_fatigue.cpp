#include "solver/fracture/damage/body_fatigue.h"

#include "solver/fracture/damage/cycled_fatigue.h"

namespace pfdm {

std::unique_ptr<BodyFatigue> make_body_fatigue(const Mesh& mesh, const FractureModel& model) {
  if (!has_fatigue(mesh, model)) return std::make_unique<BodyFatigue>();
  if (model.fatigue_cycles.any()) return std::make_unique<CycledFatigue>(mesh, model);
  return std::make_unique<FatigueCells>(mesh, model);
}

}  // namespace pfdm
