#pragma once
// The signals that files of other programs hold.

#include "postproc/records/signal_table.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

namespace pfdm::test {

inline const std::filesystem::path data = PFDM_TEST_DATA;

inline double base(int i) { return 0.5 * std::sin(0.7 * i); }
inline double relative(int i) { return -2.0 * std::cos(0.3 * i); }

inline void expect_example(const SignalTable& table, bool even, double accuracy) {
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_EQ(table.columns[1].unit, "m/s^2");
  ASSERT_EQ(table.columns[2].values.size(), 9);
  for (int i = 0; i < 9; ++i) {
    const double t = i / 100.0;
    EXPECT_NEAR(table.columns[0].values[i], even ? t : t * t + 0.25, 1e-5);
    EXPECT_NEAR(table.columns[1].values[i], base(i), accuracy);
    EXPECT_NEAR(table.columns[2].values[i], relative(i), accuracy);
  }
}

}  // namespace pfdm::test
