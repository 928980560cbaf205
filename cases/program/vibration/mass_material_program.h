#pragma once
// A case of kind "mass_material" as a program: what check, run and fit do with it.

#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind mass_material_kind();

}  // namespace pfdm
