#pragma once
// Volume changes of relaxing materials (physics/materials/prony.h): the Poisson's ratios that they come to have, and by
// them whether their cells have a pressure unknown (cell_pressure.h).

#include "physics/materials/material.h"

namespace pfdm {

/// The elasticities [Pa] of a relaxing material when its Poisson's ratio is least and greatest, after a strain that is
/// held: at once, at last or between, as where the shear has relaxed and the bulk has not.
struct PoissonRange {
  IsotropicElasticity least, greatest;
};
/// Both are the elasticity of a material that does not relax.
PoissonRange poisson_range(const Material& material);

/// Whether the cells of a material relax with a pressure: it relaxes, and nu is above 0.4 at some time. Without one,
/// rough modes of coarse meshes grew in time (85 tetrahedra, nu = 0.46: by 150 % of the force within 400 relaxation
/// times). At 0.3 and 0.4 none did.
bool relaxes_with_pressure(const Material& material);

}  // namespace pfdm
