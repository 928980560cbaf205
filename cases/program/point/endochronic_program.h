#pragma once
// A case of kind "endochronic" as a program: what check, run and fit do with it.

#include "cases/program/session/runnable_case.h"

namespace pfdm {

RunnableCase read_endochronic_program(const CaseFile& file);

}  // namespace pfdm
