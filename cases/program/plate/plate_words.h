#pragma once
// What is said of meshes of plates: what their frequencies are off by.

#include "cases/program/plate/plate_run.h"

#include <optional>
#include <span>
#include <string>

namespace pfdm {

/// What is left of the error of frequencies in layers of hexahedra, as measured (solver/dynamics/README.md): one layer
/// does not bend, and pressure unknowns soften bending. Empty without layers, and where they are right.
std::optional<std::string> words_on_layers(const Mesh& mesh, const Unknowns& unknowns);

/// Of the modes up to a frequency [Hz] the one with the fewest cells to a half wave, and what its frequency is off by;
/// empty where that is little. `resonances`: of the modes of the run, in their order.
std::optional<std::string> words_on_half_waves(const PlateRun& run, std::span<const Resonance> resonances,
                                               double highest);

}  // namespace pfdm
