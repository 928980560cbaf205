#pragma once
// The forces of cells whose spin the unknowns do not see (spin_holds.h), by the energy 1/2 k (of_cell : G - target)^2
// of each hold.

#include "solver/momentum/faces/boundary_loads.h"
#include "solver/momentum/faces/face_tractions.h"
#include "solver/scalar/gradient.h"

#include <vector>

namespace pfdm {

class SpinForces {
 public:
  SpinForces(const FaceSkeleton& skeleton, const Gradient& gradient) : skeleton_(skeleton), gradient_(gradient) {}

  /// out += the forces by gradients of the cells [N].
  void add(const FaceTractions& tractions, const CellField<Tensor>& gradients, std::vector<Vector>& out) const;
  /// load += those of the prescribed slopes at the load parameter t [N].
  void add_targets(const FaceTractions& tractions, const BoundaryLoads& loads, double t,
                   std::vector<Vector>& load) const;

 private:
  void resist(const SpinHold& hold, const FaceTractions& tractions, double much, std::vector<Vector>& v) const;
  void add_free_part(std::vector<Vector>& forces, std::vector<Vector>& out) const;

  const FaceSkeleton& skeleton_;
  const Gradient& gradient_;
};

}  // namespace pfdm
