#pragma once
// Rows of the keys of [mesh], for every generator.

#include "cases/program/input/config/key.h"

namespace pfdm {

const KeyTable& mesh_keys();

/// Of one of [[mesh.particles]]; decided is "sphere" or "file", where its surface comes from.
const KeyTable& particle_keys();
/// Of a distribution of diameters, { distribution = ..., ... }.
const KeyTable& diameter_keys();
/// { ell = 1.0 }
const KeyTable& size_keys();

}  // namespace pfdm
