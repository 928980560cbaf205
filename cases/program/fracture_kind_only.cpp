// The table of the executable pfdm_fracture, which takes two thirds of the time to build: what the launcher makes for
// the first run of a fracture case.
#include "cases/program/fracture/fracture_program.h"
#include "cases/program/kinds.h"

namespace pfdm {

std::span<const CaseKind> case_kinds() {
  static const CaseKind table[] = {fracture_kind()};
  return table;
}

}  // namespace pfdm
