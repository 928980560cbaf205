#pragma once
// What a fit of the endochronic law has to find.

#include "physics/point/endochronic.h"

#include <gtest/gtest.h>

namespace pfdm {

/// Compares each parameter with the truth, within these relative errors.
inline void expect_parameters(const EndochronicLaw& found, const EndochronicLaw& truth, double f_inf, double b,
                              double C, double alpha) {
  ASSERT_EQ(found.kernel.size(), truth.kernel.size());
  for (std::size_t r = 0; r < truth.kernel.size(); ++r) {
    EXPECT_NEAR(found.kernel[r].C / truth.kernel[r].C, 1.0, C) << "term " << r + 1;
    EXPECT_NEAR(found.kernel[r].alpha / truth.kernel[r].alpha, 1.0, alpha) << "term " << r + 1;
  }
  EXPECT_NEAR(found.hardening.with_path.p[0] / truth.hardening.with_path.p[0], 1.0, f_inf);
  EXPECT_NEAR(found.hardening.with_path.p[1] / truth.hardening.with_path.p[1], 1.0, b);
}

}  // namespace pfdm
