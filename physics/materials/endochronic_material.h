#pragma once
// The endochronic law (physics/point/endochronic.h) as a material of the field solver.

#include "physics/materials/material.h"
#include "physics/point/endochronic.h"

#include <memory>

namespace pfdm {

/// Throws InputError if the law makes no sense. Its results show plastic_strain and plastic_path_length (zeta).
std::shared_ptr<const Material> make_endochronic_material(EndochronicLaw law);

}  // namespace pfdm
