// A case of kind "chain": a homogenised laminate, a mass on a sample of it, and what is refused.

#include "tests/cases/kinds/one_material.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string block(const std::string& modulus) { return one_material("\"" + modulus + "\""); }

constexpr const char* sample = R"(kind = "mass_material"
title = "a mass on a sample of it"
[model]
structure = "1"
mass = "2 kg"
young_modulus = { from = "../block/results/homogenized.json", key = "isotropic.young_modulus_Pa" }
loss_factor = { from = "../block/results/homogenized.json", key = "loss_factors.young_modulus" }
[sample]
length = "50 mm"
area = "10 cm^2"
[sampling]
rate = "1 kHz"
[[test]]
name = "sweep"
excitation = { type = "swept_sine", level = "1 g0", from = "20 Hz", to = "100 Hz", duration = "5 s" }
)";

constexpr const char* chain = R"(kind = "chain"
title = "a block and a sample of it"
[[step]]
case = "block"
figures = [{ says = "modulus", file = "homogenized.json", key = "isotropic.young_modulus_Pa", unit = "Pa" }]
[[step]]
name = "mass on it"
case = "sample"
figures = [{ says = "resonance", key = "linear_resonance_Hz", unit = "Hz" }]
)";

class Chain : public testing::Test {
 protected:
  Chain() : directory(chain) {
    put("block", block("10 MPa"));
    put("sample", sample);
  }
  void put(const std::string& step, const std::string& text) const {
    fs::create_directories(directory.path() / step);
    directory.write(step + "/case.toml", text);
  }
  Outcome command(const std::string& word) const { return run({word, directory.path().string(), "--threads", "1"}); }
  nlohmann::json record() const { return nlohmann::json::parse(content_of(directory.results() / "chain.json")); }

  TemporaryCase directory;
};

// k = E A/L and f = (k/m)^(1/2)/(2 pi), of a bar; its damping dissipates at f what the loss factor says: c omega = eta
// k.
TEST_F(Chain, PassesNumbersOn) {
  const Outcome outcome = command("run");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const double k = 10e6 * 10e-4 / 50e-3, frequency = std::sqrt(k / 2.0) / (2.0 * std::numbers::pi);
  const nlohmann::json json = record();
  EXPECT_EQ(json["status"], "complete");
  ASSERT_EQ(json["steps"].size(), 2u);
  const nlohmann::json &first = json["steps"][0], &second = json["steps"][1];
  EXPECT_NEAR(first["figures"][0]["value"].get<double>(), 10e6, 1.0);
  EXPECT_EQ(second["name"], "mass on it");
  EXPECT_NEAR(second["figures"][0]["value"].get<double>(), frequency, 1e-6 * frequency);
  ASSERT_EQ(second["numbers_taken"].size(), 2u);
  EXPECT_EQ(second["numbers_taken"][0]["into"], "model.young_modulus");
  EXPECT_NEAR(second["numbers_taken"][1]["value"].get<double>(), 0.2, 1e-6);
  EXPECT_TRUE(fs::exists(directory.results() / "report" / "report.pdf"));
  EXPECT_TRUE(fs::exists(directory.path() / "sample" / "results" / "run.log"));
}

TEST_F(Chain, DoesNoStepTwice) {
  ASSERT_EQ(command("run").status, 0);
  const std::string before = content_of(directory.path() / "block" / "results" / "summary.json");
  const Outcome again = command("run");
  EXPECT_THAT(again.out,
              AllOf(HasSubstr("step 1 of 2: block: done before"), HasSubstr("step 2 of 2: mass on it: done")));
  EXPECT_EQ(content_of(directory.path() / "block" / "results" / "summary.json"), before);

  put("sample", replaced(sample, "\"2 kg\"", "\"8 kg\""));  // this step alone
  const Outcome heavier = command("run");
  EXPECT_THAT(heavier.out, AllOf(HasSubstr("block: done before"), Not(HasSubstr("mass on it: done before"))));

  put("block", block("40 MPa"));  // and what depends on it
  const Outcome stiffer = command("run");
  ASSERT_EQ(stiffer.status, 0) << stiffer.err;
  EXPECT_THAT(stiffer.out, Not(HasSubstr("done before")));
  const double frequency = std::sqrt(40e6 * 10e-4 / 50e-3 / 8.0) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(record()["steps"][1]["figures"][0]["value"].get<double>(), frequency, 1e-6 * frequency);

  fs::remove(directory.path() / "block" / "results" / "summary.json");  // done again, to the same numbers
  EXPECT_THAT(command("run").out, AllOf(HasSubstr("block: run"), HasSubstr("mass on it: done before")));
}

TEST_F(Chain, KeepsWhatIsDoneWhereAStepFails) {
  put("sample", replaced(sample, "\"2 kg\"", "\"-2 kg\""));
  const Outcome outcome = command("run");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("case.toml:8: [step] case"), HasSubstr("must be positive")));
  EXPECT_EQ(record()["status"], "incomplete");
  put("sample", sample);
  EXPECT_THAT(command("run").out, HasSubstr("block: done before"));
}

TEST_F(Chain, IsCheckedAsFarAsItCanBeRead) {
  const Outcome before = command("check");
  EXPECT_EQ(before.status, 0) << before.err;
  EXPECT_THAT(before.out,
              AllOf(HasSubstr("step block: run, to be done"), HasSubstr("mass on it: run, waits for \"block\"")));
  ASSERT_EQ(command("run").status, 0);
  EXPECT_THAT(command("check").out,
              AllOf(HasSubstr("step block: run, done"), HasSubstr("model.young_modulus = 1e+07")));
  put("block", "kind = 1");
  EXPECT_EQ(command("check").status, 2);
}

// Keys that no run writes are refused before anything is computed.
TEST_F(Chain, RefusesFiguresThatNoRunHas) {
  for (const auto& [good, bad, message] :
       {std::tuple("isotropic.young_modulus_Pa", "isotropic.young_modulus_Paa", "did you mean \"young_modulus_Pa\"?"),
        std::tuple("isotropic.young_modulus_Pa", "stiffness_Pa[6][0]", "(there is: a list of 6)"),
        std::tuple("isotropic.young_modulus_Pa", "isotropic", "is not a number"),
        std::tuple("unit = \"Pa\"", "unit = \"Pa\", interval = [\"bounds.reuss_voigt.bulk_modulus_lower_Pa\", \"x\"]",
                   "homogenized.json has no \"x\"")}) {
    directory.write("case.toml", replaced(chain, good, bad));
    for (const char* word : {"check", "run"}) {
      const Outcome outcome = command(word);
      EXPECT_EQ(outcome.status, 2) << word;
      EXPECT_THAT(outcome.err, AllOf(HasSubstr("case.toml:5: [step.figures] "), HasSubstr(message)));
    }
  }
  EXPECT_FALSE(fs::exists(directory.path() / "block/results"));
  EXPECT_FALSE(fs::exists(directory.results()));
}

// What is known of the file is what runs write into it.
TEST_F(Chain, TakesAllNumbersThatARunWrites) {
  ASSERT_EQ(command("run").status, 0);
  const auto json = nlohmann::json::parse(content_of(directory.path() / "block/results/homogenized.json")).flatten();
  int n = 0;
  std::string figures;
  for (const auto& [pointer, value] : json.items()) {
    if (!value.is_number()) continue;
    std::string key = pointer.substr(1);
    for (char& c : key)
      if (c == '/') c = '.';
    figures += fmt::format("{{ says = \"{}\", file = \"homogenized.json\", key = \"{}\" }},\n", n++, key);
  }
  EXPECT_GT(n, 80);
  directory.write("case.toml", replaced(chain,
                                        "{ says = \"modulus\", file = \"homogenized.json\", key = "
                                        "\"isotropic.young_modulus_Pa\", unit = \"Pa\" }",
                                        figures));
  fs::remove_all(directory.path() / "block/results");
  const Outcome outcome = command("check");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// A later run may give other numbers than are there: a warning.
TEST_F(Chain, WarnsOfFiguresThatEarlierResultsLack) {
  ASSERT_EQ(command("run").status, 0);
  directory.write("case.toml", replaced(chain, "\"linear_resonance_Hz\"", "\"linear_resonanc_Hz\""));
  const Outcome outcome = command("check");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("warning: "), HasSubstr("of the results that are there")));
}

struct WrongChain {
  const char* good;
  const char* bad;
  const char* message;
};
class WrongChains : public Chain, public testing::WithParamInterface<WrongChain> {};

TEST_P(WrongChains, AreRefused) {
  directory.write("case.toml", replaced(chain, GetParam().good, GetParam().bad));
  const Outcome outcome = command("run");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongChains,
    testing::Values(
        WrongChain{"case = \"block\"", "case = \"blok\"", "there is no such case directory"},
        WrongChain{"case = \"block\"", "case = \".\"", "cannot be a chain itself"},
        WrongChain{"case = \"block\"", "case = \"block\"\ndoes = \"fit\"", "has no \"fit\""},
        WrongChain{"case = \"block\"", "case = \"block\"\ndoes = \"runn\"", "did you mean \"run\""},
        WrongChain{"\"mass on it\"", "\"block\"", "there are two steps \"block\""},
        WrongChain{"\"linear_resonance_Hz\"", "\"linear_resonance\"", "did you mean \"linear_resonance_Hz\""},
        WrongChain{"[[step]]\ncase", "[sweep]\n[[step]]\ncase", "a chain has no sweep"},
        WrongChain{"case = \"block\"", "case = \"../block\"",
                   "case.toml:4: [step] case: \"../block\" lies outside of the chain's folder, and the step's "
                   "results would go there: outside = true in its [[step]] allows it"},
        WrongChain{"case = \"block\"", "case = \"block\"\noutside = 1", "outside"},
        WrongChain{"file = \"homogenized.json\"", "file = \"../x.json\"", "not the name of a file"}));

// Also by a link within.
TEST_F(Chain, LeavesFoldersOutsideAloneUnlessItMayWriteThere) {
  const TemporaryCase outside(block("10 MPa"));
  const std::string way = "../" + outside.path().filename().string();
  fs::create_directory_symlink(outside.path(), directory.path() / "linked");
  for (const std::string& place : {way, std::string("linked")}) {
    directory.write("case.toml", replaced(chain, "case = \"block\"", "case = \"" + place + "\""));
    for (const char* word : {"check", "run"}) EXPECT_EQ(command(word).status, 2) << place;
    EXPECT_FALSE(fs::exists(outside.results()));
  }
  directory.write("case.toml", replaced(replaced(chain, "case = \"block\"", "case = \"" + way + "\"\noutside = true"),
                                        "[[step]]\nname = \"mass on it\"", "[[step]]\nname = \"other\""));
  put("sample", block("20 MPa"));
  directory.write("case.toml",
                  replaced(content_of(directory.path() / "case.toml"),
                           "figures = [{ says = \"resonance\", key = \"linear_resonance_Hz\", unit = \"Hz\" }]", ""));
  for (const char* word : {"check", "run"}) {
    const Outcome outcome = command(word);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string says = "results of 1 step go outside of the chain's folder: " + way + " (";
    EXPECT_THAT(outcome.out, HasSubstr(says));
    EXPECT_EQ(outcome.out.find(says), outcome.out.rfind(says));
  }
  EXPECT_TRUE(fs::exists(outside.results() / "summary.json"));
}

TEST_F(Chain, HasNoLoadSteps) { EXPECT_EQ(run({"run", directory.path().string(), "--max-steps", "3"}).status, 2); }

// With its steps, one of which lies outside: the copy stands for itself.
TEST_F(Chain, IsCopiedWithItsSteps) {
  const TemporaryCase outside(block("10 MPa"));
  const std::string name = outside.path().filename().string();
  directory.write("case.toml", replaced(chain, "case = \"block\"", "case = \"../" + name + "\"\noutside = true"));
  std::string text = sample;
  for (int i = 0; i < 2; ++i) {
    const std::size_t at = text.find("\"../block/");
    text.replace(at, 10, "\"../../" + name + "/");
  }
  put("sample", text);
  const TemporaryCase place("");
  const fs::path made = place.path() / "deep" / "new";
  const Outcome copied = run({"init", made.string(), "--like", directory.path().string()});
  ASSERT_EQ(copied.status, 0) << copied.err;
  EXPECT_THAT(content_of(made / "case.toml"),
              AllOf(HasSubstr("case = \"" + name + "\""), HasSubstr("outside = false"), HasSubstr("edit this title")));
  EXPECT_THAT(content_of(made / "sample" / "case.toml"), HasSubstr("\"../" + name + "/results/homogenized.json\""));
  const Outcome outcome = run({"run", made.string(), "--threads", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(made / name / "results" / "homogenized.json"));
  EXPECT_FALSE(fs::exists(outside.results()));
}

// A step may be a case that an earlier one writes, as case.fitted.toml: it is not there yet, and no copy of it is made.
TEST_F(Chain, IsCopiedWithoutTheCasesThatItsStepsWrite) {
  directory.write("case.toml", replaced(chain, "case = \"sample\"", "case = \"block/results/case.fitted.toml\""));
  const TemporaryCase place("");
  const fs::path made = place.path() / "new";
  const Outcome copied = run({"init", made.string(), "--like", directory.path().string()});
  ASSERT_EQ(copied.status, 0) << copied.err;
  EXPECT_THAT(content_of(made / "case.toml"),
              AllOf(HasSubstr("case = \"block\""), HasSubstr("case = \"block/results/case.fitted.toml\"")));
  EXPECT_TRUE(fs::exists(made / "block" / "case.toml"));
  EXPECT_FALSE(fs::exists(made / "block" / "results"));
}

}  // namespace
}  // namespace pfdm::this_file
