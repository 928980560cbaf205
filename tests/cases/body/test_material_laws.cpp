// Laws of materials, splits and degradations with parameters in a case of kind "fracture".

#include "physics/damage/degradation.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

const std::string j2 = R"(law = "j2_plasticity"
yield_stress = "2 MPa"
isotropic_hardening = "3 GPa"
)";

std::string with_material(const std::string& keys) {
  return replaced(bar_case(), "toughness = \"100 J/m^2\"\n", "toughness = \"100 J/m^2\"\n" + keys);
}

CsvTable curve_of(const std::string& text) {
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return read_csv(directory.results() / "force_displacement.csv");
}

// Plane strain, held sideways: beyond yield the bar's modulus is K + 4 mu_t/3, mu_t = mu h/(3 mu + h), and plastic work
// turns into heat.
TEST(MaterialLaws, AnUndamageableBarOfJ2PlasticityHardensAsItsLawSays) {
  const CsvTable curve = curve_of(with_material(j2 + "damageable = false\n"));
  const auto &force = curve.column("force_x_N"), &u = curve.column("displacement_m");
  const double E = 30e9, nu = 0.2, K = E / (3.0 - 6.0 * nu), mu = E / (2.0 + 2.0 * nu), h = 3e9, Y = 2e6;
  const double mu_t = mu * h / (3.0 * mu + h), first_yield = Y / (2.0 * mu);
  const auto stress = [&](double e) {
    return e < first_yield ? (K + 4.0 / 3.0 * mu) * e
                           : (K + 4.0 / 3.0 * mu) * first_yield + (K + 4.0 / 3.0 * mu_t) * (e - first_yield);
  };
  for (std::size_t i = 1; i < u.size(); ++i)
    EXPECT_NEAR(force[i], stress(u[i] / 20e-3) * 1e-6, 1e-4 * stress(u.back() / 20e-3) * 1e-6) << i;
  EXPECT_GT(curve.column("plastic_dissipation_J").back(), 0.0);
}

// Plane strain, held sideways: P_11 of diag(l, 1, 1) is mu (l - 1/l) + lambda (l - 1), to a stretch of 2.
TEST(MaterialLaws, AnUndamageableBarOfRubberStretchesAsItsLawSays) {
  std::string text = with_material("law = \"neo_hookean\"\ndamageable = false\n");
  text = replaced(text, "0.015 mm", "20 mm");
  text = replaced(text, "frames_at = [\"0.006 mm\"]", "frames_at = [\"20 mm\"]");
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  const auto &force = curve.column("force_x_N"), &u = curve.column("displacement_m");
  const double E = 30e9, nu = 0.2, mu = E / (2.0 + 2.0 * nu), lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
  for (std::size_t i = 1; i < u.size(); ++i) {
    const double l = 1.0 + u[i] / 20e-3, P = mu * (l - 1.0 / l) + lambda * (l - 1.0);
    EXPECT_NEAR(force[i], P * 1e-6, 1e-5 * P * 1e-6) << i;
  }
  const double l = 1.0 + u.back() / 20e-3;
  const double W = 0.5 * mu * (l * l - 1.0) - mu * std::log(l) + 0.5 * lambda * (l - 1.0) * (l - 1.0);
  EXPECT_NEAR(curve.column("elastic_energy_J").back(), W * 20e-9, 1e-5 * W * 20e-9);
  bool shown = false;
  for (const auto& entry : std::filesystem::directory_iterator(directory.results() / "fields"))
    shown = shown || content_of(entry.path()).find("deformation_gradient") != std::string::npos;
  EXPECT_TRUE(shown);
}

// Plane strain, held sideways, with the strain rate e': (K + 4 mu/3) e + 4/3 sum mu_i tau_i e' (1 - exp(-t/tau_i)).
TEST(MaterialLaws, AViscoelasticBarAnswersByItsBranches) {
  const std::string prony =
      "law = \"prony\"\nshear_branches = [{ modulus = \"10 GPa\", time = \"0.1 s\" }, { modulus = \"4 GPa\", time = "
      "\"3 "
      "s\" }]\ndamageable = false\n";
  const CsvTable curve = curve_of(replaced(with_material(prony), "[loading]\n", "[loading]\nduration = \"1 s\"\n"));
  const auto &force = curve.column("force_x_N"), &u = curve.column("displacement_m"), &load = curve.column("load");
  const double E = 30e9, nu = 0.2, K = E / (3.0 - 6.0 * nu), mu = E / (2.0 + 2.0 * nu);
  for (std::size_t i = 1; i < u.size(); ++i) {
    const double e = u[i] / 20e-3, t = load[i];
    const double viscous = 10e9 * 0.1 * -std::expm1(-t / 0.1) + 4e9 * 3.0 * -std::expm1(-t / 3.0);
    const double stress = (K + 4.0 / 3.0 * mu) * e + 4.0 / 3.0 * viscous * e / t;
    EXPECT_NEAR(force[i], stress * 1e-6, 1e-6 * stress * 1e-6) << i;
  }
  EXPECT_GT(curve.column("plastic_dissipation_J").back(), 0.0);
}

TEST(MaterialLaws, ViscoelasticityRefusesWhatItCannotBe) {
  const std::string branch = "[{ modulus = \"10 GPa\", time = \"0.1 s\" }]\n",
                    timed = "[loading]\nduration = \"1 s\"\n";
  const auto refused = [&](const std::string& keys, const std::string& loading, const char* split,
                           const char* message) {
    SCOPED_TRACE(message);
    std::string text = replaced(with_material("law = \"prony\"\n" + keys), "[loading]\n", loading);
    const TemporaryCase directory(replaced(text, "\"none\"", "\"" + std::string(split) + "\""));
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  refused("", timed, "none", "needs shear_branches or bulk_branches");
  refused("shear_branches = " + branch, "[loading]\n", "none", "duration = \"1 s\" in [loading]");
  refused("bulk_branches = " + branch, timed, "volumetric_deviatoric", "keeps the bulk modulus of closed cracks");
  refused("shear_branches = " + branch, timed, "hybrid", "whose driving energy is not the one that is stored");
  refused("degradation = \"rational\"\nstrength = \"3 MPa\"\nshear_branches = " + branch, timed, "none",
          "whose strength is that of one modulus");
  refused("shear_branches = " + branch, timed, "spectral", "cannot be combined with the energy split");
  refused("shear_branches = [{ modulus = \"10 GPa\", time = \"-1 s\" }]\n", timed, "none", "time");
  refused("shear_branches = [{ modulus = \"10 GPa\" }]\n", timed, "none", "time");
  refused("yield_stress = \"2 MPa\"\nshear_branches = " + branch, timed, "none", "yield_stress");
}

// Gaps at the faces of relaxing cells relax, and nearly incompressible cells have a pressure, as plastic ones have.
TEST(MaterialLaws, HistoriesAreNotTooStiffAndNotWarnedOf) {
  const std::string prony = "law = \"prony\"\nshear_branches = [{ modulus = \"10 GPa\", time = \"0.1 s\" }]\n";
  const std::string timed = replaced(with_material(prony), "[loading]\n", "[loading]\nduration = \"1 s\"\n");
  const auto said = [](const std::string& text) {
    const TemporaryCase directory(text);
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err + outcome.out;
  };
  EXPECT_THAT(said(timed), ::testing::Not(HasSubstr("nearly incompressible")));
  EXPECT_THAT(said(replaced(timed, "poisson_ratio = 0.2", "poisson_ratio = 0.495")),
              ::testing::Not(HasSubstr("nearly incompressible")));
  EXPECT_THAT(said(replaced(with_material(j2), "poisson_ratio = 0.2", "poisson_ratio = 0.495")),
              ::testing::Not(HasSubstr("nearly incompressible")));
}

struct Refused {
  const char *keys, *split, *message;
};

TEST(MaterialLaws, WhatFiniteStrainCannotBeCombinedWithIsRefused) {
  for (const auto& [keys, split, message] :
       {Refused{"law = \"neo_hookean\"\n", "spectral", "only be combined with the energy splits"},
        Refused{"law = \"neo_hookean\"\nsecond_invariant = 0.5\n", "none", "not known here"},
        Refused{"law = \"ogden\"\nexponents = [2.0]\nshares = [0.5]\n", "none", "sum to 0.5"},
        Refused{"law = \"ogden\"\nexponents = [2.0]\n", "none", "\"shares\" is missing"},
        Refused{"law = \"saint_venant_kirchhoff\"\n", "volumetric_deviatoric", "not convex"}}) {
    SCOPED_TRACE(message);
    const TemporaryCase directory(replaced(with_material(keys), "\"none\"", "\"" + std::string(split) + "\""));
    const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(message));
  }
}

// Damageable or not: before anything asks a cell for its law of finite strain.
TEST(MaterialLaws, SmallStrainBesideFiniteStrainIsRefused) {
  const std::string left = "[materials.stone]\nregions = [\"left\", \"right\"]\n",
                    rubber =
                        "[materials.rubber]\nregions = [\"right\"]\nlaw = \"neo_hookean\"\nyoung_modulus = \"1 "
                        "MPa\"\npoisson_ratio = 0.4\ndamageable = false\n";
  const std::string text =
      replaced(glued_blocks(linear_glue), left, rubber + "[materials.stone]\nregions = [\"left\"]\n");
  const std::string whole = text.substr(0, text.find("[[interface]]"));
  for (const std::string keys : {"damageable = false\n", "toughness = \"100 J/m^2\"\nlength = \"1 mm\"\n"}) {
    const std::string good = "poisson_ratio = 0.0\ndamageable = false\n";
    expect_refused(TemporaryCase(replaced(whole, good, "poisson_ratio = 0.0\n" + keys)),
                   {.name = "mixed",
                    .good = "",
                    .bad = "",
                    .message = {"region \"left\" has a material of small strain", "saint_venant_kirchhoff"}});
  }
}

// The frame of an interface's law turns with the body.
TEST(MaterialLaws, InterfacesThatDoNotTurnWithTheBodyAreRefused) {
  const std::string rubber = with_material("law = \"neo_hookean\"\ndamageable = false\n");
  const std::string interface =
      "\n[[interface]]\nbetween = [\"bar\", \"weak\"]\nlaw = \"linear\"\nstrength = \"3 MPa\"\ntoughness = \"80 "
      "J/m^2\"\n";
  for (const auto& [keys, message] : {std::pair{"shear_ratio = 0.7\n", "whose shear_ratio is 1, or another mixed_mode"},
                                      std::pair{"friction = 0.3\n", "cannot be combined with the friction"}}) {
    SCOPED_TRACE(message);
    const TemporaryCase directory(rubber + interface + keys);
    const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(message));
  }
}

TEST(MaterialLaws, FramesShowTheHistory) {
  const TemporaryCase directory(with_material(j2));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  bool shown = false;
  for (const auto& entry : std::filesystem::directory_iterator(directory.results() / "fields"))
    shown = shown || content_of(entry.path()).find("equivalent_plastic_strain") != std::string::npos;
  EXPECT_TRUE(shown);
}

// The homogeneous solution of AT2 (ell small against the bar, so that it breaks at its peak): psi = (2 Gc d/(2 ell)) /
// -g'(d), and the stress g(d) E eps; here in uniaxial strain.
TEST(MaterialLaws, ABarOfTheCubicDegradationBreaksAtItsPeak) {
  constexpr double s = 0.2;
  std::string text =
      replaced(bar_case(), "model = \"AT1\"", "model = \"AT2\"\ndegradation = { law = \"cubic\", s = 0.2 }");
  text = replaced(text, "length = \"4 mm\"", "length = \"2 mm\"");
  text = replaced(text, "cells = 21", "cells = 41");
  text = replaced(text, "[regions.weak]\ntoughness = \"80 J/m^2\"", "[regions.weak]\ntoughness = \"99.99 J/m^2\"");
  text = replaced(text, "initial_increment = 0.1\nmaximum_increment = 0.1",
                  "initial_increment = 0.02\nmaximum_increment = 0.02");
  text = replaced(text, "0.015 mm", "0.06 mm");
  text = replaced(text, "frames_at = [\"0.006 mm\"]", "frames_every = 0");
  const CsvTable curve = curve_of(text);
  const Degradation law(degradation_law("cubic"), {s});
  const double E = 30e9, nu = 0.2, M = E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  double peak = 0.0;
  for (double d = 1e-4; d < 0.9; d += 1e-4) {
    const double psi = 100.0 / 2e-3 * d / -law.g_prime(d);
    peak = std::max(peak, law.g(d) * std::sqrt(2.0 * M * psi));
  }
  EXPECT_NEAR(std::ranges::max(curve.column("force_x_N")), peak * 1e-6, 0.02 * peak * 1e-6);
  EXPECT_LT(curve.column("force_x_N").back(), 0.01 * peak * 1e-6);
}

TEST(MaterialLaws, ASplitOfTheMaterialIsThatOfTheModel) {
  const std::string in_model =
      replaced(bar_case(), "split = \"none\"", "split = { law = \"star_convex\", gamma = 3.0 }");
  const std::string in_material = with_material("split = { law = \"star_convex\", gamma = 3.0 }\n");
  EXPECT_EQ(curve_of(in_model).column("force_x_N"), curve_of(in_material).column("force_x_N"));
}

class RefusedLaw : public ::testing::TestWithParam<BadInput> {};

TEST_P(RefusedLaw, IsNamed) {
  const BadInput& input = GetParam();
  expect_refused(TemporaryCase(replaced(with_material(j2), input.good, input.bad)), input);
}

INSTANTIATE_TEST_SUITE_P(
    MaterialLaws, RefusedLaw,
    ::testing::Values(
        BadInput{"Law", "j2_plasticity", "j3_plasticity", {"j3_plasticity", "law of a material", "j2_plasticity"}},
        BadInput{"NoYieldStress", "yield_stress = \"2 MPa\"\n", "", {"[materials.concrete]", "yield_stress"}},
        BadInput{"NegativeHardening", "\"3 GPa\"", "\"-3 GPa\"", {"isotropic_hardening", "zero or positive"}},
        BadInput{"KeyOfAnotherLaw", "yield_stress", "beta = 0.5\nyield_stress", {"beta"}},
        BadInput{"LawOfARegion", "[regions.weak]\n", "[regions.weak]\nlaw = \"linear_elastic\"\n", {"law"}},
        BadInput{
            "Split", "split = \"none\"", "split = \"no_tension\"", {"j2_plasticity", "no_tension", "allowed: none"}},
        BadInput{"SplitOfARegion",
                 "[regions.weak]\n",
                 "[regions.weak]\nsplit = \"spectral\"\n",
                 {"j2_plasticity", "spectral"}},
        BadInput{"NoParameter", "split = \"none\"", "split = \"star_convex\"", {"star_convex", "gamma"}},
        BadInput{
            "WrongParameter", "split = \"none\"", "split = { law = \"star_convex\", gama = 1.0 }", {"gama", "gamma"}},
        BadInput{"ParameterOfNone", "split = \"none\"", "split = { law = \"none\", gamma = 1.0 }", {"gamma"}},
        BadInput{"NegativeParameter",
                 "split = \"none\"",
                 "split = { law = \"star_convex\", gamma = -1.0 }",
                 {"gamma", "zero or positive"}},
        BadInput{"Degradation",
                 "split = \"none\"",
                 "split = \"none\"\ndegradation = { law = \"cubic\", s = 0.0 }",
                 {"s", "positive"}},
        BadInput{"Dissipation",
                 "initial_increment = 0.1\n",
                 "initial_increment = 0.1\nmaximum_dissipation = \"1 uJ\"\n",
                 {"maximum_dissipation", "j2_plasticity"}}),
    [](const auto& input) { return input.param.name; });

}  // namespace
}  // namespace pfdm::this_file
