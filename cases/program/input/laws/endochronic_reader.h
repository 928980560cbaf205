#pragma once
// [material] of a case of kind "endochronic", read and written.

#include "cases/program/input/config/config.h"
#include "physics/point/endochronic.h"

namespace pfdm {

/// Throws InputError for moduli, kernels and hardening that make no sense.
EndochronicLaw read_endochronic_law(const ConfigTable& material);

/// The law as [material] of a case.toml, every number with all its digits.
std::string to_toml(const EndochronicLaw& law);

}  // namespace pfdm
