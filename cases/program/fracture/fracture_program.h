#pragma once
// A case of kind "fracture" as a program: what check, mesh and run do with it.

#include "cases/program/session/runnable_case.h"

namespace pfdm {

RunnableCase read_fracture_program(const CaseFile& file);

}  // namespace pfdm
