#pragma once
// A case of kind "homogenize" as a program: what check, mesh, run and report do with it.

#include "cases/program/session/runnable_case.h"

namespace pfdm {

RunnableCase read_homogenization_program(const CaseFile& file);

}  // namespace pfdm
