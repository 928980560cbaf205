#include "cases/program/fracture/fracture_laws.h"

#include "cases/program/fracture/body/boundary_reader.h"
#include "cases/program/fracture/body/interface_reader.h"
#include "cases/program/fracture/body/material_laws.h"
#include "cases/program/fracture/body/mesh/mesh_recipe.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "physics/damage/crack_geometry.h"
#include "physics/damage/degradation.h"
#include "physics/damage/energy_split.h"
#include "physics/damage/fatigue.h"
#include "physics/damage/softening_law.h"
#include "physics/interfaces/interface_rate.h"
#include "physics/interfaces/traction_separation.h"
#include "physics/materials/strength_model.h"
#include "postproc/fields/energy_release_rate.h"

namespace pfdm {

std::vector<LawTable> fracture_laws() {
  return {law_table("mesh generators ([mesh] generator)", mesh_generators()),
          law_table("cells ([mesh] cells)", cell_kinds()),
          law_table("laws of materials ([materials.NAME] law)", material_laws()),
          law_table("crack geometric functions ([fracture] model)", crack_geometries()),
          law_table("strength models ([fracture] model)", strength_laws()),
          law_table("degradation functions ([fracture] degradation)", degradations()),
          law_table("softening laws of the rational degradation ([fracture] softening)", softening_laws()),
          law_table("energy splits ([fracture] split)", energy_splits()),
          law_table("fatigue laws ([materials.NAME] fatigue)", fatigue_laws()),
          law_table("laws of cohesive interfaces ([[interface]] law)", interface_laws()),
          law_table("their mixed mode ([[interface]] mixed_mode)", mixed_modes()),
          law_table("their dependence on the rate ([[interface]] rate)", interface_rate_laws()),
          law_table("traction-separation laws that pfdm cohesive fits", traction_separation_laws()),
          law_table("boundary conditions ([[boundary]] type)", boundary_types()),
          law_table("displacement fields (displacement = { field = ... })", displacement_fields()),
          law_table("energy release rate of a crack ([[output.energy_release_rate]] shape)", region_shapes()),
          law_table("linear solvers ([solver] linear)", linear_solvers())};
}

}  // namespace pfdm
