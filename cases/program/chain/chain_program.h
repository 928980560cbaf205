#pragma once
// kind = "chain": jobs of other cases one after the other. A step that is done is not done again as long as its case,
// its data, the numbers that it takes and its outcome are as they were.

#include "cases/program/session/case_kind.h"

namespace pfdm {

CaseKind chain_kind();

}  // namespace pfdm
