#include "cases/program/kinds.h"

#include "cases/program/chain/chain_program.h"
#include "cases/program/fracture/fracture_program.h"
#include "cases/program/homogenization/homogenization_program.h"
#include "cases/program/plate/plate_program.h"
#include "cases/program/point/endochronic_program.h"
#include "cases/program/vibration/mass_material_program.h"
#include "cases/program/viscoelastic/viscoelastic_program.h"

namespace pfdm {

std::span<const CaseKind> case_kinds() {
  static const CaseKind table[] = {chain_kind(),         endochronic_kind(), fracture_kind(),    homogenization_kind(),
                                   mass_material_kind(), plate_kind(),       viscoelastic_kind()};
  return table;
}

}  // namespace pfdm
