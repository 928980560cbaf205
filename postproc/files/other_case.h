#pragma once
// Results that are not those of the case.

#include "physics/error.h"

namespace pfdm {

/// Results belong to another case, or to this one before it was changed. Who knows both may name what was changed.
struct OtherCase : InputError {
  using InputError::InputError;
};

}  // namespace pfdm
