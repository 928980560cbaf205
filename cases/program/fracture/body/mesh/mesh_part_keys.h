#pragma once
// Rows of the keys of what a mesh is made of: blocks of cells, regions, particles, patches.

#include "cases/program/input/config/key.h"

namespace pfdm {

/// A length, or { ell = 1.0 } in multiples of the phase-field length.
KeyType edge_length();
/// Of { ell = 1.0 }.
const KeyTable& size_keys();

/// Of a block of cells along an axis, by its length.
const KeyTable& blocks_of_length();
/// Of a block of cells along the polar angle.
const KeyTable& blocks_of_angle();
/// Of a shell of a sphere.
const KeyTable& shell_keys();

/// Of a part of a box of hexahedra: a region, slit, hole or patch.
const KeyTable& box_part_keys();
/// Of a part of a cylinder's sector.
const KeyTable& sector_part_keys();
/// Of a patch of an imported mesh.
const KeyTable& imported_patch_keys();

/// Of prism layers around particles.
const KeyTable& particle_layer_keys();
/// Of one of [[mesh.particles]]; decided is "sphere" or "file", where its surface comes from.
const KeyTable& particle_keys();
/// Of a sphere that is placed instead of packed.
const KeyTable& placed_sphere_keys();
/// Of a body that is packed in place of spheres.
const KeyTable& packed_shape_keys();
/// Of a distribution of diameters, { distribution = ..., ... }.
const KeyTable& diameter_keys();

}  // namespace pfdm
