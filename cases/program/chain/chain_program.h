#pragma once
// kind = "chain": jobs of other cases one after the other. A step that is done is not done again as long as its case,
// its data, the numbers that it takes and its outcome are as they were.

#include "cases/program/input/case_file.h"
#include "cases/program/session/runnable_case.h"

namespace pfdm {

RunnableCase read_chain_program(const CaseFile& file);

}  // namespace pfdm
