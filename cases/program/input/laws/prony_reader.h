#pragma once
// A Prony series out of a case, and back into one.

#include "cases/program/input/config/config.h"
#include "physics/materials/prony.h"

#include <string>
#include <vector>

namespace pfdm {

/// Of the keys young_modulus, poisson_ratio, shear_branches and bulk_branches, which were checked.
PronyLaw read_prony_series(const ConfigTable& material);

/// Of the key shear_branches or bulk_branches alone; none without it.
std::vector<PronyBranch> read_shear_branches(const ConfigTable& material);
std::vector<PronyBranch> read_bulk_branches(const ConfigTable& material);

/// These keys, a line each, with `digits` significant digits.
std::string to_toml(const PronyLaw& law, int digits = 15);

}  // namespace pfdm
