#pragma once
// A case of kind "mass_material" as a program: what check, run and fit do with it.

#include "cases/program/session/runnable_case.h"

namespace pfdm {

RunnableCase read_mass_material_program(const CaseFile& file);

}  // namespace pfdm
