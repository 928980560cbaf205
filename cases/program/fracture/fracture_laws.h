#pragma once
// The laws, conditions and generators that a case of kind "fracture" may name.

#include "cases/program/session/case_kind.h"

#include <vector>

namespace pfdm {

std::vector<LawTable> fracture_laws();

}  // namespace pfdm
