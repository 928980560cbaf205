#pragma once
// The kinds of case, and what each can do. To add one, write its `read` and a row of the table at the foot of
// kinds.cpp.

#include "cases/program/session/runnable_case.h"

#include <span>
#include <string_view>

namespace pfdm {

struct CaseKind {
  std::string_view name;
  std::string_view description;
  RunnableCase (*read)(const CaseFile& file);
};
std::span<const CaseKind> case_kinds();

/// Throws InputError for whatever is wrong with the file, unknown keys included.
RunnableCase read_case(const CaseFile& file);

}  // namespace pfdm
