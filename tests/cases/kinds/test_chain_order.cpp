// Chains whose steps take from each other: in which order, and of results that are gone.

#include "tests/cases/kinds/one_material.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string chain_of(const std::string& first, const std::string& second) {
  return "kind = \"chain\"\ntitle = \"two blocks\"\n[[step]]\ncase = \"" + first + "\"\n[[step]]\ncase = \"" + second +
         "\"\n";
}

class ChainOrder : public testing::Test {
 protected:
  ChainOrder() : directory(chain_of("given", "taken")) {
    put("given", one_material("\"10 MPa\""));
    put("taken", one_material(R"({ from = "../given/results/homogenized.json", key = "isotropic.young_modulus_Pa" })"));
  }
  void put(const std::string& step, const std::string& text) const {
    fs::create_directories(directory.path() / step);
    directory.write(step + "/case.toml", text);
  }
  Outcome command(const std::string& word) const { return run({word, directory.path().string(), "--threads", "1"}); }

  TemporaryCase directory;
};

TEST_F(ChainOrder, AStepIsDoneAgainWhereALaterOneLacksItsFile) {
  ASSERT_EQ(command("run").status, 0);
  fs::remove(directory.path() / "given" / "results" / "homogenized.json");
  EXPECT_THAT(command("check").out, HasSubstr("step given: run, to be done"));
  const Outcome again = command("run");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, AllOf(Not(HasSubstr("given: done before")), HasSubstr("taken: done before")));
}

// It would be done with the modulus from before, and the chain be complete.
TEST_F(ChainOrder, AStepCannotTakeFromALaterOne) {
  ASSERT_EQ(command("run").status, 0);
  directory.write("case.toml", chain_of("taken", "given"));
  put("given", one_material("\"40 MPa\""));
  for (const char* word : {"check", "run"}) {
    const Outcome outcome = command(word);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err,
                HasSubstr(R"("taken" takes from results of "given", which comes after it; put that first)"));
  }
}

}  // namespace
}  // namespace pfdm::this_file
