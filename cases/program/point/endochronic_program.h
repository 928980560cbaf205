#pragma once
// A case of kind "endochronic" as a program: what check, run and fit do with it.

#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind endochronic_kind();

}  // namespace pfdm
