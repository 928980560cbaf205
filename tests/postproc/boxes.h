#pragma once
// Small meshes for the tests.

#include "mesh/generators/box_hexes.h"

namespace pfdm::test {

inline Mesh box_mesh(const AxisBlock& x, const AxisBlock& y, const AxisBlock& z) {
  BoxHexesSettings settings;
  settings.axes = {{{x}, {y}, {z}}};
  return make_box_hexes(settings);
}

/// A cube of n x n x n cells.
inline Mesh cube_mesh(double length, Index n) { return box_mesh({length, n, 1.0}, {length, n, 1.0}, {length, n, 1.0}); }

}  // namespace pfdm::test
