// pfdm help KEY: what it says of keys, and how keys are found by words.

#include "cases/program/kinds.h"
#include "cases/program/reference/key_help.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;

std::string help_on(const std::string& asked) {
  std::vector<KindKeys> kinds;
  for (const CaseKind& kind : case_kinds()) kinds.push_back({kind.name, kind.keys()});
  return help_on_key(asked, kinds).value_or("");
}

TEST(KeyHelp, SaysWhatAKeyIs) {
  const std::string help = help_on("toughness");
  EXPECT_THAT(help, HasSubstr("critical energy release rate Gc"));
  EXPECT_THAT(help, HasSubstr("energy per area (\"10 J/m^2\"), positive"));
  EXPECT_THAT(help, HasSubstr("materials.NAME.toughness (fracture)"));
  EXPECT_THAT(help, HasSubstr("example    toughness = \"10 J/m^2\""));
}

TEST(KeyHelp, FindsAKeyByWhereItStands) {
  const std::string help = help_on("materials.poisson_ratio");
  EXPECT_THAT(help, HasSubstr("number, above -1 and at most 0.4999"));
  EXPECT_THAT(help, testing::Not(HasSubstr("(plate)")));
  EXPECT_EQ(help, help_on("materials.steel.poisson_ratio"));
  EXPECT_THAT(help_on("material.poisson_ratio"), HasSubstr("(plate)"));
  EXPECT_THAT(help_on("mesh.particles[0].diameter"), HasSubstr("Diameter of the sphere"));
  EXPECT_THAT(help_on("solver.damage_tolerance"), HasSubstr("default    0.0001"));
  EXPECT_EQ(help_on("loads.poisson_ratio"), "");
}

TEST(KeyHelp, NamesWhatWasMeant) {
  const Outcome outcome = run({"help", "tougness"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nor is it a key of case.toml (keys like it: toughness"));
  EXPECT_THAT(run({"help", "toughness"}).out, HasSubstr("Fracture toughness"));
}

TEST(KeyHelp, SaysWhereElseAWordMayBeFound) {
  const Outcome outcome = run({"help", "slender"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("all keys: cases/reference; all else: the search of pfdm docs"));
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("available:")));
  EXPECT_LT(outcome.err.size(), 300u);
  EXPECT_THAT(run({"help", "rnu"}).err, HasSubstr("did you mean \"run\"?"));
}

TEST(KeyHelp, FindsKeysByHowAWordBegins) {
  EXPECT_THAT(run({"help", "debond"}).out, HasSubstr("these tell of it:"));
  EXPECT_THAT(run({"help", "viscoel"}).out, HasSubstr("material\n  Viscoelastic material"));
  EXPECT_EQ(run({"help", "vis"}).status, 2);
}

TEST(KeyHelp, FindsKeysByWhatTheyTellOf) {
  const Outcome Gc = run({"help", "gc"});
  EXPECT_EQ(Gc.status, 0) << Gc.err;
  EXPECT_THAT(Gc.out, testing::StartsWith("no key has the name \"gc\"; these tell of it:"));
  EXPECT_THAT(Gc.out, HasSubstr("toughness\n  Fracture toughness, critical energy release rate Gc"));
  const std::string young = run({"help", "young"}).out;
  EXPECT_LT(young.find("young_modulus\n  Young's modulus"), 100U) << young;
  EXPECT_THAT(young, HasSubstr("in         materials.NAME.young_modulus (fracture) and"));
  EXPECT_EQ(run({"help", "critical", "energy"}).out, run({"help", "critical energy"}).out);
  EXPECT_THAT(run({"help", "energy critical"}).out, HasSubstr("toughness\n"));
  EXPECT_THAT(run({"help", "particle"}).out, HasSubstr("particles\n"));
  EXPECT_THAT(run({"help", "ell"}).out, HasSubstr("others that tell of it: "));
  EXPECT_THAT(run({"help", "ell"}).out, HasSubstr("fracture.length"));
}

TEST(KeyHelp, FindsKeysByTheWordsOfTheField) {
  const auto first_of = [](const std::vector<std::string>& words) {
    std::vector<std::string> line{"help"};
    line.insert(line.end(), words.begin(), words.end());
    return run(line).out;
  };
  for (const char* law : {"neo_hookean", "neo-Hookean", "rubber", "hyperelastic"})
    EXPECT_THAT(first_of({law}), HasSubstr("in         materials.NAME.law (fracture)")) << law;
  EXPECT_THAT(first_of({"speed"}), HasSubstr("in         loading.duration (fracture)"));
  EXPECT_THAT(first_of({"cooling"}), HasSubstr("loads.temperature_change"));
  EXPECT_THAT(first_of({"thermal", "expansion"}), HasSubstr("in         materials.NAME.expansion (fracture)"));
  EXPECT_THAT(first_of({"critical energies"}), HasSubstr("these tell of it:"));  // most of the words
  EXPECT_THAT(first_of({"restart"}), HasSubstr("pfdm run --restart\n"));
  EXPECT_THAT(first_of({"step"}), HasSubstr("commands that tell of it: pfdm run --restart, "));
}

}  // namespace
}  // namespace pfdm::this_file
