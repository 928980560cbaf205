#pragma once
// The distribution of chi^2 (Wilson, Hilferty, Proc. Natl. Acad. Sci. 17 (1931) 684).

#include <cmath>

namespace pfdm {

/// What chi^2 over its number of degrees of freedom exceeds as seldom as a standard normal variable exceeds `normal`;
/// 0: its median.
inline double chi_square_over_mean(double freedom, double normal) {
  const double share = 2.0 / (9.0 * freedom);
  return std::pow(1.0 - share + normal * std::sqrt(share), 3);
}

}  // namespace pfdm
