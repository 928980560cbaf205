// A run that stops because its smallest increment does not converge says which cell, and what this case allows.

#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace pfdm::this_file {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// A bar that is allowed few iterations a step, too few where its weak cells, at 10 mm, break.
std::string hasty_bar(int iterations = 5) {
  const std::string text = replaced(bar_case(), "toughness = \"80 J/m^2\"", "toughness = \"60 J/m^2\"");
  return replaced(text, "maximum_increment = 0.1\n", "maximum_increment = 0.1\nminimum_increment = 0.02\n") +
         "\n[solver]\nmaximum_iterations = " + std::to_string(iterations) + "\n";
}

std::string failure_of(const std::string& text) {
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const auto last = outcome.err.find("with loading.minimum_increment");
  return last == std::string::npos ? outcome.err : outcome.err.substr(last);
}

TEST(Unconverged, NamesTheCellThatBreaksAndWhatHelps) {
  const std::string words = failure_of(hasty_bar());
  EXPECT_THAT(words, HasSubstr("with loading.minimum_increment = 0.02: "));
  EXPECT_THAT(words, ContainsRegex("the damage of cell 2[01] at \\(0\\.01, 0\\.000[27]5, 0\\.0005\\) m changes by "
                                   "[0-9.]+e-0[0-9] an iteration \\(solver\\.damage_tolerance = 0\\.0001\\)"));
  EXPECT_THAT(words, HasSubstr("may help: solver.maximum_iterations above 5, fracture.viscosity"));
  EXPECT_THAT(words, Not(HasSubstr("maximum_dissipation")));  // nothing is loaded by tractions

  const TemporaryCase patient(hasty_bar(500));
  const Outcome outcome = run({"run", patient.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(Unconverged, OffersWhatTheCaseAllows) {
  const std::string viscous =
      replaced(replaced(hasty_bar(), "length = \"4 mm\"", "length = \"4 mm\"\nviscosity = \"1 Pa s\""), "[loading]\n",
               "[loading]\nduration = \"1 s\"\n");
  EXPECT_THAT(failure_of(viscous), Not(HasSubstr("fracture.viscosity")));
  std::string pulled = replaced(hasty_bar(3), "displacement = [\"0.015 mm\", \"free\", \"free\"]",
                                "traction = [\"30 MPa\", \"0 Pa\", \"0 Pa\"]");
  pulled = replaced(pulled, "frames_at = [\"0.006 mm\"]", "");
  EXPECT_THAT(failure_of(pulled), HasSubstr("loading.maximum_dissipation"));
}

TEST(Unconverged, IsSaidInAShortLine) {
  const std::string pulled = replaced(hasty_bar(3), "displacement = [\"0.015 mm\", \"free\", \"free\"]",
                                      "traction = [\"30 MPa\", \"0 Pa\", \"0 Pa\"]");
  const TemporaryCase directory(replaced(pulled, "frames_at = [\"0.006 mm\"]", ""));
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_LE(outcome.err.size(), 300U) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("may help: solver.maximum_iterations above 3, fracture.viscosity, "
                                     "loading.maximum_dissipation\n"));
}

}  // namespace
}  // namespace pfdm::this_file
