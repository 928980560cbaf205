// What pfdm check and a run say of cells that do not resolve a crack.

#include "postproc/fields/pvd.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace pfdm::this_file {
namespace {

// 1 mm over 50 is a little more than 20 um in double precision.
TEST(Program, DoesNotWarnOfCellsOfHalfTheLength) {
  const TemporaryCase plate(R"(kind = "fracture"
title = "a plate"
boundary = [{ patch = "ymin", displacement = ["0 mm", "0 mm", "free"] },
            { patch = "ymax", displacement = ["free", "8 um", "free"] },
            { patches = ["zmin", "zmax"], type = "plane" }]
mesh.generator = "box_hexes"
mesh.x = [{ length = "1 mm", cells = 50 }]
mesh.y = [{ length = "1 mm", cells = 50 }]
mesh.z = [{ length = "1 mm", cells = 1 }]
[materials.steel]
regions = ["body"]
young_modulus = "210 GPa"
poisson_ratio = 0.3
toughness = "2.7 kJ/m^2"
[fracture]
length = "40 um"
[output]
curve = { patch = "ymax", component = "y" }
)");
  const Outcome outcome = run({"check", plate.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("would not be resolved"), std::string::npos) << outcome.out;
}

// A band is as thin as wanted, but its columns are two ell wide.
TEST(Program, WarnsOfCellsThatAreTooWideAlongABand) {
  const auto bead = [](const std::string& size) {
    return R"(kind = "fracture"
title = "a bead"
boundary = [{ patch = "zmin", displacement = ["0 um", "0 um", "0 um"] },
            { patch = "zmax", displacement = ["free", "free", "1 um"] }]
[mesh]
generator = "particles_in_box"
size = ["200 um", "200 um", "200 um"]
particles = [{ diameter = "80 um", surface_size = )" +
           size + R"( }]
layers = { count = 4, thickness = "4 um" }
[materials.sylgard]
regions = ["matrix", "interface", "bead"]
young_modulus = "75 MPa"
poisson_ratio = 0.44
toughness = "400 J/m^2"
[fracture]
length = "10 um"
effective_toughness = "as_given"
[output]
curve = { patch = "zmax", component = "z" }
)";
  };
  const auto check_of = [&](const std::string& size) {
    const TemporaryCase directory(bead(size));
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_NE(check_of("\"20 um\"").find("wide along the band"), std::string::npos);
  EXPECT_EQ(check_of("\"9 um\"").find("wide along the band"), std::string::npos);
  const auto cells_of = [](const std::string& text) { return text.substr(text.find("\ncells "), 20); };
  EXPECT_EQ(cells_of(check_of("{ ell = 0.9 }")), cells_of(check_of("\"9 um\"")));
  expect_refused(TemporaryCase(replaced(bead("{ ell = 0.9 }"), "length = \"10 um\"\n", "")),
                 {"NoEll", "", "", {"surface_size", "[fracture]"}});
}

TEST(Program, WarnsOfCellsThatAreTooThickForTheLength) {
  const TemporaryCase fine(bar_case()), coarse(replaced(bar_case(), "\"4 mm\"", "\"0.6 mm\""));
  EXPECT_EQ(run({"check", fine.path().string()}).out.find("would not be resolved"), std::string::npos);
  const Outcome outcome = run({"check", coarse.path().string()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("region \"bar\": cells are up to 500 um thick, ell is 600 um"), std::string::npos)
      << outcome.out;
}

/// Cells of 0.2 mm in the middle, where the bar breaks, and 2 mm elsewhere, all 0.5 mm across; ell is 0.6 mm.
std::string graded_bar() {
  std::string text =
      replaced(bar_case(), "{ length = \"20 mm\", cells = 21 }",
               "{ length = \"8 mm\", cells = 4 }, { length = \"4 mm\", cells = 20 }, { length = \"8 mm\", "
               "cells = 4 }");
  return replaced(replaced(text, "\"4 mm\"\n\n", "\"0.6 mm\"\n\n"), "\"80 J/m^2\"", "\"8 J/m^2\"");
}

TEST(Program, DoesNotWarnOfCoarseCellsThatNoCrackEnters) {
  const TemporaryCase fine(graded_bar());
  const Outcome within = run({"run", fine.path().string()});
  ASSERT_EQ(within.status, 0) << within.err;
  EXPECT_THAT(within.out, ::testing::HasSubstr("region \"bar\": cells are up to 500 um thick, ell is 600 um: a crack "
                                               "is resolved in 32 of 48 cells"));
  EXPECT_THAT(within.out, ::testing::Not(::testing::HasSubstr("warning")));
}

TEST(Program, WarnsOfABandThatIsNarrowerThanItsCracksProfile) {
  const TemporaryCase directory(replaced(bar_case(), "toughness = \"80 J/m^2\"\n",
                                         "toughness = \"80 J/m^2\"\nband = { width = \"0.8 mm\", between = [\"bar\", "
                                         "\"bar\"] }\n"));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("region \"weak\" is 800 um wide: the profile of a crack in it, 16 mm"), std::string::npos)
      << outcome.out;
}

}  // namespace
}  // namespace pfdm::this_file
