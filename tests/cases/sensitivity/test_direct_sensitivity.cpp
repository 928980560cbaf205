// pfdm sensitivity --method direct, against closed forms and against differences.

#include "cases/program/studies/sensitivity/direct_sensitivity.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/sensitivity/closed_forms.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> direct{"--method", "direct"};

TEST(DirectSensitivity, OfABarThatSoftensEvenlyHasItsClosedForm) {
  const TemporaryCase directory(short_bar());
  const auto found = found_in(directory, direct);
  const CsvTable table = read_csv(directory.results() / "sensitivity.csv", {.has_gaps = true});
  const std::vector<double>& u = table.column("displacement_m");
  ASSERT_EQ(u.size(), 51u);
  for (const auto& [key, value] : bar_values) {
    const std::vector<double>& e = table.column("elasticity_" + key);
    for (std::size_t i = 1; i < u.size(); ++i) {
      const double due = elasticity_of([&](const Values& p) { return force_of_bar(p, u[i]); }, bar_values, key);
      EXPECT_NEAR(e[i], due, 5e-5 * std::max(1.0, std::abs(due))) << key << " at " << u[i];
    }
  }
  const std::map<std::string, double> of_force{{E_key, 0.5}, {Gc_key, 0.5}, {ell_key, -0.5}};
  for (const auto& [key, due] : of_force) {
    EXPECT_NEAR(value_of(found, "greatest force", "force", key), due, 1e-3) << key;
    EXPECT_NEAR(value_of(found, "greatest force", "displacement", key), key == E_key ? -0.5 : due, 5e-3) << key;
  }
  EXPECT_FALSE(std::filesystem::exists(directory.results() / "runs"));
}

/// So long that its damage gathers at its weak end, and it jumps. One cell wide and weak at an end, lest it has ways to
/// break that differ by rounding.
std::string long_bar() {
  std::string text = replaced(bar_case(), "cells = 21", "cells = 41");
  text = replaced(text, "cells = 2 }", "cells = 1 }");
  text = replaced(text, "lower = [\"9.6 mm\"", "lower = [\"-1 mm\"");
  text = replaced(text, "upper = [\"10.4 mm\"", "upper = [\"1 mm\"");
  text = replaced(text, "\"AT1\"", "\"AT2\"");
  text = replaced(text, "\"4 mm\"", "\"2 mm\"");
  text = replaced(text, "\ninitial_increment = 0.1",
                  "\nenergy_release = 0.02\nfinest_increment = 1e-5\ninitial_increment = 0.0015");
  text = replaced(text, "\nmaximum_increment = 0.1", "\nmaximum_increment = 0.0015");
  return text +
         "[solver]\ndamage_tolerance = 1e-7\nenergy_tolerance = 1e-9\nequilibrium_tolerance = 1e-8\nmaximum_iterations "
         "= 20000\n";
}

const std::string concrete_E = "materials.concrete.young_modulus", weak_Gc = "regions.weak.toughness";

// Up to the peak and past it, as long as both steps of the differences agree.
TEST(DirectSensitivity, OfABarThatBreaksIsThatOfDifferences) {
  const TemporaryCase one(long_bar()), other(long_bar());
  const auto found = found_in(one, direct);
  const auto differences =
      found_in(other, {"--step", "0.002", "--parameters", concrete_E + ",materials.concrete.toughness," + weak_Gc});
  const CsvTable by_one = read_csv(one.results() / "sensitivity.csv", {.has_gaps = true}),
                 by_other = read_csv(other.results() / "sensitivity.csv", {.has_gaps = true});
  const std::size_t peak =
      static_cast<std::size_t>(std::ranges::max_element(by_one.column("force_N")) - by_one.column("force_N").begin());
  for (const std::string& key : {concrete_E, std::string("materials.concrete.toughness"), weak_Gc}) {
    const std::vector<double>&e = by_one.column("elasticity_" + key), &due = by_other.column("elasticity_" + key),
          &error = by_other.column("error_" + key);
    std::size_t n = 0, n_beyond = 0;
    for (std::size_t i = 1; i < e.size(); ++i) {
      if (!(error[i] < 1e-3)) continue;
      const double share = error[i] > 3e-5 ? 1e-2 : 1e-4;  // next to the jump the differences err by more than they say
      EXPECT_NEAR(e[i], due[i], share * std::max(1.0, std::abs(due[i]))) << key << " in row " << i;
      ++(error[i] > 3e-5 ? n_beyond : n);
    }
    EXPECT_GT(n, 0.95 * static_cast<double>(peak)) << key;
    EXPECT_GT(n + n_beyond, peak + 5) << key;  // rows beyond the peak are among them
  }
  // u (E/Gc)^(1/2) is alone what equilibrium depends on.
  EXPECT_NEAR(value_of(found, "jump 1", "displacement", concrete_E), -0.5, 0.01);
  EXPECT_NEAR(value_of(found, "jump 1", "displacement", "materials.concrete.toughness") +
                  value_of(found, "jump 1", "displacement", weak_Gc),
              0.5, 0.01);
  EXPECT_NEAR(value_of(found, "jump 1", "displacement", weak_Gc),
              value_of(differences, "jump 1", "displacement", weak_Gc), 0.02 * 0.5);
}

TEST(DirectSensitivity, OfGluedBlocksHasItsClosedForm) {
  const TemporaryCase directory(finely_pulled_blocks());
  const auto found = found_in(directory, direct);
  const CsvTable table = read_csv(directory.results() / "sensitivity.csv", {.has_gaps = true});
  const std::vector<double>& u = table.column("displacement_m");
  const Values values{{modulus, 1e9}, {law_strength, strength}, {law_toughness, toughness}};
  int n = 0;
  for (const auto& [key, value] : values) {
    const std::vector<double>& e = table.column("elasticity_" + key);
    for (std::size_t i = 1; i < u.size(); ++i) {
      if (std::isnan(e[i]) || std::abs(u[i] - 4e-6) < 1e-6) continue;
      const double due = elasticity_of([&](const Values& p) { return force_of_blocks(p, u[i]); }, values, key);
      EXPECT_NEAR(e[i], due, 2e-3 * std::max(1.0, std::abs(due))) << key << " at " << u[i];
      ++n;
    }
  }
  EXPECT_GT(n, 100);
  EXPECT_THAT(found["remarks"].dump(), HasSubstr("does not look for the first debonding"));
}

TEST(DirectSensitivity, OfAPrescribedDisplacementHasItsClosedForm) {
  const TemporaryCase directory(block_pulled_twice());
  const auto found = found_in(directory, {"--method", "direct", "--parameters", sideways});
  EXPECT_NEAR(found["parameters"][0]["mean_magnitude"].get<double>(), 0.3, 1e-4);
}

// Both displacements together leave the force at a displacement as it is; the ratio of 3 is none of few digits.
TEST(DirectSensitivity, OfJoinedKeysKeepsTheirRatio) {
  const TemporaryCase directory(replaced(block_pulled_twice(), "\"0.001 mm\"", "\"0.00033333333 mm\""));
  const auto found =
      found_in(directory, {"--method", "direct", "--parameters", "boundary[1].displacement[0]+" + sideways});
  EXPECT_EQ(found["parameters"][0]["keys"].size(), 2u);
  EXPECT_NEAR(found["parameters"][0]["mean_magnitude"].get<double>(), 0.0, 1e-5);
}

TEST(DirectSensitivity, RefusesWhatItDoesNotFollow) {
  const TemporaryCase directory(block_pulled_twice());
  const std::string increment = "loading.maximum_increment";
  const auto found = found_in(directory, {"--method", "direct", "--parameters", increment + "," + E_key});
  EXPECT_THAT(found["parameters"][1]["failure"].get<std::string>(), HasSubstr("keeps the mesh and the steps"));
  const auto refused = [&](const std::string& option, const std::string& value, const std::string& message) {
    const Outcome outcome = run({"sensitivity", directory.path().string(), "--method", "direct", option, value});
    EXPECT_EQ(outcome.status, 2) << option;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << option;
  };
  refused("--parameters", increment, "take --method differences");
  refused("--step", "0.1", "--method direct takes none");
}

// What several jumps leave grows without a bound: 1e151 of a DCB whose cells break one by one.
TEST(DirectSensitivity, BehindJumpsHasNoElasticityPastAllReason) {
  pfdm::DirectSensitivity found;
  found.curve = {.name = "computed", .x = {0.0, 1.0, 2.0, 3.0}, .y = {0.0, 2.0, 2.0, 2.0}};
  found.by_load.assign(4, {});
  found.by = {{{}, {.force = 500.0}, {.force = 1.0, .is_after_jump = true}, {.force = 1e151, .is_after_jump = true}}};
  const std::vector<Elasticity> elasticity = elasticities(found, 0);
  EXPECT_EQ(elasticity[1].value, 250.0);  // before jumps all are told
  EXPECT_EQ(elasticity[2].value, 0.5);
  EXPECT_TRUE(elasticity[2].is_doubtful());
  EXPECT_FALSE(elasticity[3].is_known());
}

// Cells that break one by one make no fall of the force within one row: what breaks them leaves equations unsolved.
TEST(DirectSensitivity, BehindLostRowsHasNoElasticityPastAllReason) {
  pfdm::DirectSensitivity found;
  found.curve = {.name = "computed", .x = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}, .y = {0.0, 2.0, 2.0, 2.0, 2.0, 2.0}};
  found.by_load.assign(6, {});
  const double nan = std::nan("");
  found.by = {{{},
               {.force = 500.0, .unsolved = 1e-9},
               {.force = 1.0, .unsolved = 0.02},
               {.force = 1.0, .unsolved = 1e-9},
               {.force = 2.8e5, .unsolved = 1e-9},
               {.force = -1e144, .unsolved = nan}},
              {{}, {.force = 500.0}, {.force = 500.0}, {.force = 500.0}, {.force = 500.0}, {.force = 500.0}}};
  mark_lost_rows(found);
  const std::vector<Elasticity> elasticity = elasticities(found, 0), other = elasticities(found, 1);
  EXPECT_EQ(elasticity[1].value, 250.0);
  EXPECT_FALSE(elasticity[1].is_doubtful());
  for (const std::size_t i : {2u, 3u}) {
    EXPECT_EQ(elasticity[i].value, 0.5) << i;
    EXPECT_TRUE(elasticity[i].is_doubtful()) << i;
  }
  for (const std::size_t i : {4u, 5u}) EXPECT_FALSE(elasticity[i].is_known()) << i;
  for (std::size_t i = 1; i < 6; ++i) EXPECT_FALSE(other[i].is_doubtful()) << i;  // each parameter has its own
}

TEST(DirectSensitivity, OfAJumpBehindLostRowsHasNoElasticityPastAllReason) {
  pfdm::DirectSensitivity found;
  found.curve = {.name = "computed", .x = {0.0, 1.0, 2.0, 2.1, 3.0}, .y = {0.0, 1.0, 2.0, 0.5, 1.0}};
  found.by_load.assign(5, {.displacement = 1.0});
  const BaseEvent jump{.event = {.kind = EventKind::jump, .number = 1}, .displacement = 2.0, .quantities = {{}}};
  for (const auto& [load, is_told] : {std::pair(10.0, true), {1e30, false}}) {
    found.by = {std::vector<RowDerivative>(5)};
    found.by[0][1].unsolved = 1.0;
    found.by[0][2].jump = {.load = load, .error = 0.0};
    mark_lost_rows(found);
    const std::vector<Elasticity> elasticity = elasticities(found, 0, jump);
    ASSERT_EQ(elasticity.size(), 1u);
    EXPECT_EQ(elasticity[0].is_known(), is_told) << load;
    EXPECT_EQ(elasticity[0].is_doubtful(), is_told);
  }
}

TEST(DirectSensitivity, IsRefusedWhereModelsHaveNone) {
  const TemporaryCase viscous(
      replaced(replaced(bar_case(), "split = \"none\"", "split = \"none\"\nviscosity = \"1 kPa s\""), "[loading]\n",
               "[loading]\nduration = \"1 s\"\n"));
  const Outcome outcome = run({"sensitivity", viscous.path().string(), "--method", "direct"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("there are no direct derivatives of runs with a viscosity"));
  EXPECT_EQ(run({"sensitivity", viscous.path().string(), "--method", "exact"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(viscous.results()));
}

}  // namespace
}  // namespace pfdm::this_file
