// Keys that a case gives and that change nothing: pfdm check says so.

#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What is said of the case on the terminal.
std::string checked(const std::string& text) {
  const TemporaryCase directory(text);
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out + outcome.err;
}

TEST(IdleKeys, AStrengthThatTheModelHasNotIsTold) {
  const std::string strong =
      replaced(bar_case(), "toughness = \"80 J/m^2\"", "toughness = \"80 J/m^2\"\nstrength = \"2 MPa\"");
  EXPECT_THAT(checked(bar_case()), Not(HasSubstr("changes nothing")));
  EXPECT_THAT(checked(strong),
              HasSubstr("strength of region \"weak\" changes nothing: the degradation \"quadratic\" has none"));
  EXPECT_THAT(checked(replaced(bar_case(), "poisson_ratio = 0.2", "poisson_ratio = 0.2\nstrength = \"2 MPa\"")),
              HasSubstr("strength of regions \"bar\", \"weak\" changes nothing: "));
  const std::string cohesive = replaced(replaced(replaced(strong, "\"AT1\"", "\"Wu\"\ndegradation = \"rational\""),
                                                 "length = \"4 mm\"", "length = \"1 mm\""),
                                        "toughness = \"100 J/m^2\"", "toughness = \"100 J/m^2\"\nstrength = \"2 MPa\"");
  EXPECT_THAT(checked(cohesive), Not(HasSubstr("changes nothing")));
}

TEST(IdleKeys, ADurationWithoutAnythingThatDependsOnTimeIsTold) {
  const std::string timed = replaced(bar_case(), "[loading]\n", "[loading]\nduration = \"1 s\"\n");
  EXPECT_THAT(checked(timed), HasSubstr("[loading] duration gives the frames their time and changes nothing else"));
  EXPECT_THAT(checked(replaced(timed, "poisson_ratio = 0.2",
                               "poisson_ratio = 0.2\nlaw = \"prony\"\nshear_branches = [{ modulus = \"1 GPa\", time = "
                               "\"1 s\" }]")),
              Not(HasSubstr("changes nothing")));
  EXPECT_THAT(checked(replaced(timed, "[output]\n", "[output]\ntime_value = \"time\"\n")),
              Not(HasSubstr("changes nothing")));
  EXPECT_THAT(checked(replaced(timed, "length = \"4 mm\"", "length = \"4 mm\"\nviscosity = \"1 kPa s\"")),
              Not(HasSubstr("changes nothing")));
}

}  // namespace
}  // namespace pfdm::this_file
