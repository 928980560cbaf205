// Where surfaces around particles came off, in words, from tables written by hand.

#include "cases/program/fracture/outcome/debonded_poles.h"
#include "physics/angle.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

const Vector up = Vector::UnitZ();
const CurveUnits microns{.displacement = {.name = "um", .si_unit = "m", .in_si = 1e-6}, .force = {.si_unit = "N"}};

/// Results of two surfaces, 0.5 and 0.2 mm^2, with these rows of the second one.
struct TwoSurfaces : TemporaryCase {
  TwoSurfaces(const std::string& rows, const std::string& debonded) : TemporaryCase("") {
    write("cohesive.json", R"({"surfaces": [{"name": "a", "area_m2": 5e-7, "debonded_area_m2": 0.0},
                                            {"name": "b", "area_m2": 2e-7, "debonded_area_m2": )" +
                               debonded + "}]}");
    write(
        "debonding.csv",
        "surface,step,load,displacement_m,force_N,debonded_area_m2,debonding_angle_plus_deg,debonding_angle_minus_deg\n"
        "0,0,0,0,0,0,0,0\n0,1,0.5,1e-4,1,0,70,0\n" +
            rows);
  }
};

TEST(DebondedPoles, AreNamedByTheAxis) {
  EXPECT_EQ(pole_of(121 * degree, 175 * degree, up), "lower pole");
  EXPECT_EQ(pole_of(4 * degree, 90 * degree, up), "upper pole");
  EXPECT_EQ(pole_of(121 * degree, 175 * degree, Vector::UnitX()), "pole against the load");
  EXPECT_EQ(pole_of(40 * degree, 120 * degree, up), std::nullopt);
}

// The upper cap creeps to 10 degrees and jumps to 80 in the step from 30 to 40 um.
TEST(DebondedPoles, TellTheJumpOfTheLaterOne) {
  const TwoSurfaces folder(
      "1,0,0,0,0,0,0,0\n1,1,0.2,10e-6,1,1e-8,0,60\n1,2,0.4,20e-6,2,1e-8,8,70\n1,3,0.6,30e-6,3,1e-8,10,75\n"
      "1,4,0.8,40e-6,2.5,1e-7,80,88\n1,5,1,50e-6,3,1.9e-7,89,89\n",
      "1.9e-7");
  EXPECT_EQ(rest_of_debonding("b", up, microns, folder.path()),
            "\"b\" debonds at its upper pole between 30 and 40 um, where the force goes from 3 to 2.5 N, and the "
            "debonding angle from 10 to 80 degrees; at the end 95 % of it has debonded");
}

TEST(DebondedPoles, TellThatThereIsNoJump) {
  const TwoSurfaces folder(
      "1,0,0,0,0,0,0,0\n1,1,0.2,10e-6,1,1e-8,40,0\n1,2,0.4,20e-6,1,1e-8,42,8\n1,3,0.6,30e-6,1,1e-8,44,20\n", "5e-8");
  EXPECT_EQ(rest_of_debonding("b", Vector::UnitX(), microns, folder.path()),
            "\"b\" debonds at its pole against the load little by little from 20 um on; at the end 25 % of it has "
            "debonded");
}

TEST(DebondedPoles, TellOfBothThatComeOffInOneStep) {
  const TwoSurfaces folder("1,0,0,0,0,0,0,0\n1,1,0.2,10e-6,4,0,0,0\n1,2,0.4,20e-6,2,1e-8,30,40\n", "5e-8");
  EXPECT_EQ(rest_of_debonding("b", up, microns, folder.path()),
            "\"b\" debonds at both poles in one step, between 10 and 20 um, where the force goes from 4 to 2 N; at the "
            "end 25 % of it has debonded");
}

TEST(DebondedPoles, TellNothingOfASurfaceWithoutArea) {
  for (const char* area : {"0.0", "null"}) {
    const TwoSurfaces folder("1,0,0,0,0,0,0,0\n1,1,0.2,10e-6,1,0,0,60\n", "0.0");
    folder.write("cohesive.json",
                 std::string(R"({"surfaces": [{"name": "b", "debonded_area_m2": 0.0, "area_m2": )") + area + "}]}");
    EXPECT_EQ(rest_of_debonding("b", up, microns, folder.path()), "");
  }
}

TEST(DebondedPoles, TellOfOnePoleAloneHowMuchHasComeOff) {
  const TwoSurfaces folder("1,0,0,0,0,0,0,0\n1,1,0.2,10e-6,1,1e-8,0,60\n", "5e-8");
  EXPECT_EQ(rest_of_debonding("b", up, microns, folder.path()), "at the end 25 % of \"b\" has debonded");
  EXPECT_EQ(rest_of_debonding("c", up, microns, folder.path()), "");
  EXPECT_EQ(rest_of_debonding("b", up, microns, folder.path() / "nothing"), "");
}

}  // namespace
}  // namespace pfdm::this_file
