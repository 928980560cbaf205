#pragma once
// Rows of the keys of kind "mass_material".

#include "cases/program/input/config/key.h"

#include <array>

namespace pfdm {

const KeyTable& mass_material_keys();

/// Dimensions of k_1, k_2 ...
const std::array<Dimension, 7>& stiffness_dimensions();
/// Dimensions of the kernel's weight beta, on the displacement, on the stiffness; on the velocity it is that of k_1.
const Dimension& beta_on_displacement();
const Dimension& beta_on_stiffness();

}  // namespace pfdm
