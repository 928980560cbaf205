#include "solver/momentum/finite_strain/finite_memory.h"

#include "solver/momentum/finite_strain/polar_parts.h"
#include "solver/parallel.h"

namespace pfdm {

void FiniteMemory::set(const std::vector<GapStress>& gaps) {
  left_.clear();
  if (gaps.empty()) return;
  left_.assign(skeleton_.n_turns(), Vector::Zero());
  turned_.assign(skeleton_.n_turns(), Vector::Zero());
  bulk_left_.assign(skeleton_.n_turns(), 0.0);
  bulk_.assign(skeleton_.n_turns(), 0.0);
  rotation_ = CellField<Tensor>(skeleton_.mesh.n_cells(), Tensor::Identity());
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    visit_sides(c, [&](std::size_t at, Index, std::size_t turn) {
      left_[turn] = outwards(turn) * gaps[at].shear;
      bulk_left_[turn] = gaps[at].bulk;
    });
  });
}

void FiniteMemory::turn(const FiniteStates& states) {
  if (!any()) return;
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    if (!(states.law(c).memory.share > 0.0)) return;
    rotation_[c] = polar_parts(states.deformation()[c]).R;
    visit_sides(c, [&](std::size_t, Index, std::size_t turn) {
      turned_[turn] = states.law_at(c, turn).memory.share * (rotation_[c] * left_[turn]);
      bulk_[turn] = states.law_at(c, turn).memory.bulk * bulk_left_[turn];
    });
  });
}

}  // namespace pfdm
