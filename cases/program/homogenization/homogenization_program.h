#pragma once
// A case of kind "homogenize" as a program: what check, mesh, run and report do with it.

#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind homogenization_kind();

}  // namespace pfdm
