#pragma once
// The kinds of case that this program knows.

#include "cases/program/input/config/kind_names.h"
#include "cases/program/session/case_kind.h"

#include <span>

namespace pfdm {

/// The table of the executable: all kinds (kinds.cpp), or the one of pfdm_fracture (fracture_kind_only.cpp).
std::span<const CaseKind> case_kinds();

/// False for a kind that there is and that this executable was built without.
bool knows_kind(const CaseFile& file);

/// Throws InputError for whatever is wrong with the file, unknown keys included.
RunnableCase read_case(const CaseFile& file);

/// CaseKind::numbers_like of a kind by name; "" for a kind that this executable was built without.
std::string numbers_like(std::string_view kind, std::string_view file);

}  // namespace pfdm
