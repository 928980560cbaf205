#pragma once
// Rows of the keys of [fit] and [sweep].

#include "cases/program/input/config/key.h"

namespace pfdm {

const KeyTable& sweep_keys();
const KeyTable& curve_fit_keys();

/// "parameters" of a fit.
Key fit_parameters_key();
/// "finer": other values of the case for one more run at the estimates.
Key finer_key(std::string_view otherwise);

}  // namespace pfdm
