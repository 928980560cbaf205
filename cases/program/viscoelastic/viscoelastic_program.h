#pragma once
// A case of kind "viscoelastic" as a program: what check, run and fit do with it.

#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind viscoelastic_kind();

}  // namespace pfdm
