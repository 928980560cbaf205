// Cracks that are there before the first step, what the residual stiffness does to them, and bodies that come apart.

#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <sstream>

namespace pfdm::this_file {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string crack =
    "[[initial.cracks]]\npoints = [[\"0 mm\", \"4.05 mm\", \"0 mm\"], [\"4 mm\", \"4.05 mm\", \"0 mm\"]]\n";
const std::string slit =
    "[[mesh.slits]]\nname = \"slit\"\nlower = [\"0 mm\", \"4 mm\", \"0 mm\"]\nupper = [\"4 mm\", \"4 mm\", \"1 mm\"]\n";

// 8 x 8 x 1 mm in plane strain, drawn along y; the crack, or slit, goes from the left side to the middle.
std::string plate(const std::string& model, const std::string& cut, const std::string& more = "") {
  return fmt::format(R"(kind = "fracture"
title = "a plate with a crack"
[mesh]
generator = "box_hexes"
x = [{{ length = "8 mm", cells = 80 }}]
y = [{{ length = "8 mm", cells = 80 }}]
z = [{{ length = "1 mm", cells = 1 }}]
{}
[materials.steel]
regions = ["body"]
young_modulus = "210 GPa"
poisson_ratio = 0.3
toughness = "2700 J/m^2"
strength = "1 GPa"
[fracture]
{}
split = "none"
length = "0.2 mm"
{}
[[boundary]]
patch = "ymin"
displacement = ["0 mm", "0 mm", "free"]
[[boundary]]
patch = "ymax"
displacement = ["free", "0.001 mm", "free"]
[[boundary]]
patches = ["zmin", "zmax"]
type = "plane"
[loading]
end = 0.1
initial_increment = 0.05
[output]
curve = {{ patch = "ymax", component = "y" }}
)",
                     cut, model, more);
}

struct Ran {
  nlohmann::json summary;
  std::vector<double> fracture_energy;  // by steps [J]
  Outcome outcome;
};

Ran ran(const std::string& case_toml) {
  const TemporaryCase directory(case_toml);
  Ran result{.summary = {}, .fracture_energy = {}, .outcome = run({"run", directory.path().string()})};
  EXPECT_EQ(result.outcome.status, 0) << result.outcome.err;
  result.summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  std::istringstream rows(content_of(directory.results() / "force_displacement.csv"));
  std::string row;
  std::getline(rows, row);
  const std::vector<std::string> names = [&] {
    std::vector<std::string> all;
    std::istringstream cells(row);
    for (std::string name; std::getline(cells, name, ',');) all.push_back(name);
    return all;
  }();
  const auto column = std::ranges::find(names, "fracture_energy_J") - names.begin();
  while (std::getline(rows, row)) {
    std::istringstream cells(row);
    std::string cell;
    for (std::ptrdiff_t i = 0; i <= column; ++i) std::getline(cells, cell, ',');
    result.fracture_energy.push_back(std::stod(cell));
  }
  return result;
}

TEST(InitialCracks, BeginWithTheEnergyOfTheirArea) {
  const double area = 4e-3 * 1e-3, toughness = 2700.0;
  for (const std::string model : {"model = \"AT1\"", "model = \"AT2\"", "model = \"Wu\"\ndegradation = \"rational\""}) {
    const Ran now = ran(plate(model, "", crack));
    ASSERT_EQ(now.fracture_energy.size(), 3U);
    // 3 % are due to cells of ell/2; the front's own half disc comes to about ell of length.
    EXPECT_NEAR(now.fracture_energy[0] / (area * toughness), 1.05, 0.05) << model;
    EXPECT_NEAR(now.fracture_energy[1], now.fracture_energy[0], 1e-3 * now.fracture_energy[0]) << model;
    EXPECT_LT(now.summary.at("energy_balance_error").get<double>(), 1e-3) << model;
  }
}

TEST(InitialCracks, AreAsCompliantAsSlits) {
  const auto stiffness = [](const Ran& now) { return now.summary.at("initial_stiffness_N_per_m").get<double>(); };
  const double cut = stiffness(ran(plate("model = \"AT1\"", slit)));
  const double cracked = stiffness(ran(plate("model = \"AT1\"", "", crack)));
  const double whole = stiffness(ran(plate("model = \"AT1\"", "")));
  EXPECT_LT(cut, 0.75 * whole);
  EXPECT_NEAR(cracked / cut, 1.0, 0.05);
}

TEST(InitialCracks, WhoseResidualStiffnessFalsifiesForcesAreNamed) {
  EXPECT_THAT(ran(plate("model = \"AT1\"", "", crack)).outcome.out, Not(HasSubstr("residual_stiffness")));
  EXPECT_THAT(ran(plate("model = \"AT1\"\nresidual_stiffness = 1e-2", "", crack)).outcome.out,
              AllOf(HasSubstr("would be lower"), HasSubstr("smaller fracture.residual_stiffness")));
}

TEST(InitialCracks, ThatCutAPieceOffAreRefused) {
  const std::string through = replaced(crack, "\"4 mm\", \"4.05 mm\"", "\"8 mm\", \"4.05 mm\"");
  const std::string free_along_x = plate("model = \"AT1\"", "", through);
  const TemporaryCase directory(free_along_x);
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("the initial damage cuts the body into 2 parts"), HasSubstr("along x;")));
  const TemporaryCase held(replaced(free_along_x, "[\"free\", \"0.001 mm\"", "[\"0 mm\", \"0.001 mm\""));
  EXPECT_EQ(run({"check", held.path().string()}).status, 0);
}

// With the preconditioner of the open crack, or a last solve down to 3e-8 alone, none of it could be solved.
TEST(InitialCracks, PressedShutAreSolvedAsExactlyAsIsAskedFor) {
  const std::string through = replaced(crack, "\"4 mm\", \"4.05 mm\"", "\"8 mm\", \"4.05 mm\"");
  for (const std::string split : {"volumetric_deviatoric", "spectral", "no_tension"}) {
    std::string text = plate("model = \"AT1\"", "", through);
    text = replaced(text, "split = \"none\"", "split = \"" + split + "\"");
    text = replaced(text, "[\"free\", \"0.001 mm\"", "[\"0 mm\", \"-0.001 mm\"");
    text = replaced(text, "cells = 80 }]\nz", "cells = 40 }]\nz");
    text = replaced(text, "[output]", "[solver]\nequilibrium_tolerance = 1e-11\n[output]");
    EXPECT_THAT(ran(text).outcome.out, Not(HasSubstr("did not converge"))) << split;
  }
}

std::string pulled_by_traction() {
  std::string text = replaced(bar_case(), "displacement = [\"0.015 mm\", \"free\", \"free\"]",
                              "traction = [\"40 MPa\", \"free\", \"free\"]");
  return replaced(text, "frames_at = [\"0.006 mm\"]\n", "");
}

// AT1 with ell = 4 mm and plane strain: the weak cells break at (3 E' Gc/(8 ell))^(1/2) = 15.8 MPa, load 0.395, or a
// little above.
TEST(DeadLoads, ThatTearTheBodyApartEndTheRun) {
  const TemporaryCase directory(pulled_by_traction());
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("breaks apart between the loads 0.4 and 0.5"), HasSubstr("displacements"),
                                 HasSubstr("loading.maximum_dissipation")));
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_THAT(summary.at("status").get<std::string>(), HasSubstr("failed: "));
  EXPECT_NEAR(summary.at("peak_force_N").get<double>(), 0.4 * 40.0, 1e-3);  // of 1 mm^2
}

}  // namespace
}  // namespace pfdm::this_file
