#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/config/units.h"
#include "physics/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace pfdm::this_file {
namespace {

std::string message_of(std::string_view text, const Dimension& due) {
  try {
    parse_quantity(text, due);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Units, ReadsQuantitiesInSi) {
  EXPECT_DOUBLE_EQ(parse_quantity("75 MPa", dimension::stress), 75e6);
  EXPECT_DOUBLE_EQ(parse_quantity("20 um", dimension::length), 20e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("20 µm", dimension::length), 20e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("-1.5e2mm", dimension::length), -0.15);
  EXPECT_DOUBLE_EQ(parse_quantity(" +10 J/m^2 ", dimension::toughness), 10.0);
  EXPECT_DOUBLE_EQ(parse_quantity("2.7 N/mm", dimension::toughness), 2700.0);
  EXPECT_DOUBLE_EQ(parse_quantity("1 N/mm^2", dimension::stress), 1e6);
  EXPECT_DOUBLE_EQ(parse_quantity("30 %", dimension::number), 0.3);
  EXPECT_DOUBLE_EQ(parse_quantity("20 degC", dimension::temperature), 293.15);
}

TEST(Units, ReadsMultiplesOfGravity) {
  constexpr double g0 = 9.80665;
  EXPECT_DOUBLE_EQ(parse_quantity("1e-5/K", dimension::per_temperature), 1e-5);
  EXPECT_NEAR(parse_quantity("62.43 lbm/ft^3", dimension::density), 1000.0, 0.05);
  EXPECT_NEAR(parse_quantity("1 Msi", dimension::stress), 6.894757e9, 1e3);
  EXPECT_NEAR(parse_quantity("1 kp/cm^2", dimension::stress), 98066.5, 1e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("20 dyn/cm^2", dimension::stress), 2.0);
  EXPECT_DOUBLE_EQ(parse_quantity("2 thou", dimension::length), 50.8e-6);
  EXPECT_NEAR(parse_quantity("2 oz", dimension::mass), 56.699e-3, 1e-6);
  EXPECT_THROW(parse_quantity("5/2 mm", dimension::length), InputError);
  EXPECT_DOUBLE_EQ(parse_quantity("2 thou2", dimension::area), 2.0 * 25.4e-6 * 25.4e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("0.05 g02/Hz", dimension::acceleration_density), 0.05 * g0 * g0);
  EXPECT_DOUBLE_EQ(parse_quantity("5 g0", dimension::acceleration), 5.0 * g0);
  EXPECT_DOUBLE_EQ(parse_quantity("0.05 g0^2/Hz", dimension::acceleration_density), 0.05 * g0 * g0);
  EXPECT_NE(message_of("5 g", dimension::acceleration).find("write g0 for multiples of gravity"), std::string::npos);
  EXPECT_EQ(message_of("5 m", dimension::acceleration).find("g0 for"), std::string::npos);
}

TEST(Units, SaysWhatWasFoundAndWhatIsDue) {
  EXPECT_EQ(message_of("20 um", dimension::stress), "\"20 um\" is a length; expected a stress, as in \"75 MPa\"");
  EXPECT_EQ(message_of("20", dimension::length), "\"20\" has no unit; expected a length, as in \"20 um\"");
  EXPECT_DOUBLE_EQ(parse_quantity("1.5e-4", dimension::number), 1.5e-4);  // none is due
  EXPECT_EQ(message_of("20 parsnips", dimension::length),
            "\"20 parsnips\": the unit \"parsnips\" is not known; expected a length, as in \"20 um\"");
  EXPECT_EQ(message_of("fast", dimension::length),
            "\"fast\" does not start with a number; expected a length, as in \"20 um\"");
  EXPECT_EQ(message_of("20 30 um", dimension::length),
            "\"20 30 um\" has two numbers; expected a length, as in \"20 um\"");
  EXPECT_NE(message_of("0,5 mm", dimension::length).find("\"0,5 mm\" has a comma; numbers have a decimal point"),
            std::string::npos);
  EXPECT_NE(message_of("1 mol", dimension::energy).find("expected an energy"), std::string::npos);
}

TEST(Units, DoesNotTakeATimeForAFrequency) {
  EXPECT_NE(message_of("1 s", dimension::frequency).find("is a time; expected a frequency"), std::string::npos);
}

TEST(Units, RefusesWhatIsNotFinite) {
  EXPECT_NE(message_of("inf m", dimension::length), "no error");
  EXPECT_NE(message_of("nan m", dimension::length), "no error");
  EXPECT_NE(message_of("1e999 m", dimension::length), "no error");
  EXPECT_NE(message_of("", dimension::length), "no error");
}

TEST(Units, GivesTheFactorOfAUnit) {
  EXPECT_DOUBLE_EQ(unit_in_si("um", dimension::length), 1e-6);
  EXPECT_DOUBLE_EQ(unit_in_si("50 g0", dimension::acceleration), 490.3325);  // the full scale of a file of integers
  EXPECT_DOUBLE_EQ(unit_in_si("degC", dimension::temperature), 1.0);
  EXPECT_THROW(unit_in_si("kg", dimension::length), InputError);
}

TEST(Units, AreReadByThreadsAtOnce) {
  std::atomic<int> n_wrong = 0;
  const auto read = [&] {
    for (int i = 0; i < 3000; ++i)
      if (parse_quantity("75 N/mm^2", dimension::stress) != 75e6 || !is_unit("kg m s-2")) ++n_wrong;
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(read);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(n_wrong, 0);
}

}  // namespace
}  // namespace pfdm::this_file
