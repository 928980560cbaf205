#pragma once
// Driving energy of the damage at fixed displacements where the energy is not linear in the stiffness factor g.

#include "mesh/fields.h"

#include <functional>

namespace pfdm {

struct DrivingAt {
  double value = 0.0;  ///< psi_plus, the derivative of a cell's energy by g, per volume [J/m^3]
  double slope = 0.0;  ///< its derivative by the variable at hand, g or d
};

/// psi_plus of a cell at the damage d, and its derivative by d.
using DrivingLaw = std::function<DrivingAt(Index cell, double d)>;

}  // namespace pfdm
