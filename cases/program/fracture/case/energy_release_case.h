#pragma once
// Reads [[output.energy_release_rate]]: around which crack tips the energy release rate is measured.

#include "cases/program/input/config/config.h"
#include "postproc/fields/energy_release_rate.h"

#include <span>
#include <vector>

namespace pfdm {

/// `output` is the table [output]; `boundary` tells whether the body is a sector about the axis z.
std::vector<TipRegion> read_energy_release(const ConfigTable& output, std::span<const BoundaryCondition> boundary);

}  // namespace pfdm
