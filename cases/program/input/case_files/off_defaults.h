#pragma once
// Which keys of a case are not at their defaults.

#include "cases/program/input/config/config.h"

#include <string>
#include <vector>

namespace pfdm {

/// A key and what stands at it.
struct OffDefault {
  std::string path;       ///< "solver.linear.tolerance"
  std::string value;      ///< as TOML has it, with its unit; long lists are cut
  std::string otherwise;  ///< the default, as it would stand in the file or in words
};

/// Of a case that was read: the keys that have a default and another value, in the order of the text. Values in
/// different units that are the same quantity are the same. A default in words, which the program finds when it runs,
/// is another one whatever the value.
std::vector<OffDefault> off_defaults(const Config& config);

}  // namespace pfdm
