#pragma once
// A case of kind "fracture" as a program: what check, mesh and run do with it.

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind fracture_kind();

/// What can be done with a box that is loaded by its mean strain, read from this file.
RunnableCase runnable_box(const CaseFile& file, FractureCase box);

}  // namespace pfdm
