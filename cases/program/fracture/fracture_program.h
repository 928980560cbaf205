#pragma once
// A case of kind "fracture" as a program: what check, mesh and run do with it.

#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind fracture_kind();

}  // namespace pfdm
