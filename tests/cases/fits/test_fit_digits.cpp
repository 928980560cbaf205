// Digits of intervals on pages and in the terminal.

#include "cases/program/fracture/page/fit_on_page.h"
#include "cases/program/session/fit_verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

TEST(FitDigits, TellTheEndsOfAnIntervalApart) {
  EXPECT_EQ(interval_text(69.697, 69.997, 0.95, 4), "95 % between 69.697 and 69.997");
  EXPECT_EQ(interval_text(350.2, 441.9, 0.95, 4), "95 % between 350.2 and 441.9");
  EXPECT_EQ(interval_text(-1e-3, 2e3, 0.95, 4), "95 % between -0.001 and 2000");
  EXPECT_EQ(interval_text(5.0, 5.0, 0.95, 4), "95 % between 5 and 5");
}

TEST(FitDigits, AreThoseThatTheIntervalWarrants) {
  EXPECT_EQ(interval_text(5956.47, 6030.75), "95 % between 5956.5 and 6030.8");
  EXPECT_EQ(value_text(5995.06, 5956.47, 6030.75), "5995.1");
  EXPECT_EQ(interval_text(-3788.21, 3674.74), "95 % between -3788 and 3675");
  EXPECT_EQ(value_text(18.616, -3788.21, 3674.74), "19");
  EXPECT_EQ(interval_text(350.2, 441.9), "95 % between 350.2 and 441.9");
  EXPECT_EQ(value_text(392.1234, 350.2, 441.9), "392.1");
  EXPECT_EQ(value_text(47.7433, std::nan(""), std::nan("")), "47.74");
  EXPECT_EQ(ends_text(0.08312, 0.4, " (the bound) and "), "0.0831 (the bound) and 0.4");
}

TEST(FitDigits, OfATableHaveOneUnit) {
  FitReport fit;
  FittedParameter modulus{.name = "modulus", .unit = "Pa", .estimate = 69.847e6};
  modulus.lower = 69.697e6, modulus.upper = 69.997e6;
  FittedParameter toughness{.name = "toughness", .unit = "J/m^2", .estimate = 392};
  toughness.lower = 391.97, toughness.upper = 392.03;
  fit.found.parameters = {modulus, toughness};
  const Table table = estimates_table(fit);
  EXPECT_EQ(table.rows[1][3], "69.697 to 69.997 MPa");
  EXPECT_EQ(table.rows[2][3], "391.97 to 392.03 J/m^2");
}

}  // namespace
}  // namespace pfdm::this_file
