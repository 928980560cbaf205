// Quantities in words of messages.

#include "physics/quantity_text.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace pfdm::this_file {
namespace {

TEST(QuantityText, HasThePrefixThatLeavesFewDigits) {
  EXPECT_EQ(quantity_text(6.01e-5, "m", 3), "60.1 um");
  EXPECT_EQ(quantity_text(75e6, "Pa"), "75 MPa");
  EXPECT_EQ(quantity_text(1500.0, "J/m^2"), "1.5 kJ/m^2");
  EXPECT_EQ(quantity_text(-0.1, "N"), "-100 mN");
  EXPECT_EQ(quantity_text(0.0, "m"), "0 m");
  EXPECT_EQ(quantity_text(999.97e-6, "m"), "1 mm");
  EXPECT_EQ(quantity_text(99.7e-6, "m", 2), "100 um");
}

TEST(QuantityText, TakesPowersOfUnits) {
  EXPECT_EQ(quantity_text(2e-11, "m^3"), "0.02 mm^3");
  EXPECT_EQ(quantity_text(3e-5, "m^2"), "30 mm^2");
}

TEST(QuantityText, HasNoMegametresAndNoPrefixFarFromEverything) {
  EXPECT_EQ(quantity_text(1e6, "m", 6), "1000 km");
  EXPECT_EQ(quantity_text(1e150, "m"), "1e+150 m");
  EXPECT_EQ(quantity_text(1e-30, "Pa"), "1e-30 Pa");
  EXPECT_EQ(quantity_text(std::numeric_limits<double>::quiet_NaN(), "m"), "-");
}

TEST(QuantityText, WritesSeveralInOneUnit) {
  EXPECT_EQ(quantities_text({1e-6, 5e-6}, "m", " and "), "1 and 5 um");
  EXPECT_EQ(quantities_text({9000.0, 1e4}, "N", " to "), "9 to 10 kN");
  EXPECT_EQ(point_text(std::array{1e-4, 0.0, 1e-20}), "(100, 0, 0) um");
}

}  // namespace
}  // namespace pfdm::this_file
