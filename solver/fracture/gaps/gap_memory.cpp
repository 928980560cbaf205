#include "solver/fracture/gaps/gap_memory.h"

#include "solver/fracture/gaps/flowing_gaps.h"
#include "solver/fracture/gaps/relaxing_gaps.h"

#include <utility>

namespace pfdm {

std::vector<std::unique_ptr<GapMemory>> gap_memories(const Mesh& mesh, const CellField<const Material*>& materials,
                                                     const FractureModel& model) {
  std::vector<std::unique_ptr<GapMemory>> all;
  const auto add = [&](std::unique_ptr<GapMemory> memory) {
    if (memory->any()) all.push_back(std::move(memory));
  };
  add(std::make_unique<RelaxingGaps>(mesh, materials, model));
  add(std::make_unique<FlowingGaps>(mesh, materials, model));
  return all;
}

}  // namespace pfdm
