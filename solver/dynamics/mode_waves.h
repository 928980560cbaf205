#pragma once
// How many cells there are to a half wave of a mode, which says what its frequency is off by.

#include "solver/dynamics/modes.h"

#include <optional>

namespace pfdm {

/// Along lines of hexahedra through faces whose normal is nearest to an axis.
struct HalfWaves {
  Index axis = 0;      ///< of the mesh: 0, 1, 2
  double cells = 0.0;  ///< to a half wave [-]; of a mode whose waves differ in length in the mean
};

/// The axis with the fewest cells to a half wave; empty without hexahedra side by side. Of u = sin(phi i) of cell i the
/// mean of (u_i+1 - u_i)^2 over that of u_i^2 is 4 sin(phi/2)^2, and pi/phi cells are a half wave.
std::optional<HalfWaves> fewest_cells_to_half_wave(const VibratingBody& body, const Mode& mode);

/// What the frequency of a mode is too low by at most, relative: 0.2 phi^2/(1 + 0.3 phi^2) with phi = pi/cells, as
/// measured with strips and plates (solver/dynamics/README.md); beside clamps up to twice that.
double most_error_by_half_waves(double cells);

}  // namespace pfdm
