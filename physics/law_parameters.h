#pragma once
// Parameters of laws: what a row of a table asks for, and the values that a material gives.

#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace pfdm {

/// Positive, unless it may be zero.
struct LawParameter {
  static constexpr double required = std::numeric_limits<double>::quiet_NaN();
  std::string_view name;
  std::string_view unit;  ///< SI, "1" for pure numbers
  bool may_be_zero = false;
  double otherwise = required;  ///< the value where none is given
};

/// Parameters of a law, at most four, in the order of its row.
using LawParameters = std::array<double, 4>;

constexpr LawParameters default_values(std::span<const LawParameter> parameters) {
  LawParameters p{};
  for (std::size_t i = 0; i < parameters.size(); ++i) p[i] = parameters[i].otherwise;
  return p;
}

}  // namespace pfdm
