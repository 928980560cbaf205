#pragma once
// Whether the steps resolve the rate at which cohesive interfaces open: the rate of a step is a mean over it, with an
// error of the first order. A law is passed within 2 toughness/strength; a tenth of that in a step is fine, a quarter
// coarse.

#include "solver/fracture/model/fracture_model.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// Before a run: a line for each interface with rate whose law is passed by what the boundary moves in a few of the
/// largest steps. Levers may slow its faces down: a run tells what they do.
std::vector<std::string> rate_remarks(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading);

/// Watches a run for steps in which faces open too far.
class RateResolution {
 public:
  /// The warning after a step to this load parameter, from one history of all faces to the other; empty if there is
  /// none, and again only when a step is twice as coarse.
  std::string remark(const FractureModel& model, std::span<const InterfaceHistory> from,
                     std::span<const InterfaceHistory> to, double load);

 private:
  double said_ = 0.0;
};

}  // namespace pfdm
