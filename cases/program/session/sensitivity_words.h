#pragma once
// What `pfdm sensitivity` was given, as it was typed.

#include <string>
#include <vector>

namespace pfdm {

struct SensitivityWords {
  std::vector<std::string> parameters{};  ///< keys; several joined by "+" keep their ratios. None: the default ones
  std::string method = "differences";     ///< or "direct"
  double step = 0.01;                     ///< of the differences, relative to the parameter
};

}  // namespace pfdm
