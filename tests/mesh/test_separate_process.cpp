// A foreign library's crash ends a process of its own.

#include "mesh/surfaces/separate_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include "physics/error.h"

namespace pfdm {
namespace {

TEST(SeparateProcess, ReturnsItsBytes) {
  const std::string many(1000000, '\0');  // more than a pipe holds
  EXPECT_EQ(computed_separately([&] { return many + "end"; }), many + "end");
  EXPECT_EQ(computed_separately([] { return std::string(); }), "");
}

TEST(SeparateProcess, SurvivesACrash) {
  EXPECT_EQ(computed_separately([]() -> std::string {
              std::raise(SIGKILL);
              return "alive";
            }),
            std::nullopt);
  EXPECT_EQ(computed_separately([]() -> std::string { std::quick_exit(0); }), std::nullopt);
}

TEST(SeparateProcess, PassesErrorsOn) {
  const auto message_of_input = [] {
    try {
      computed_separately([]() -> std::string { throw InputError("line 3"); });
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message_of_input(), "line 3");
  EXPECT_THROW(computed_separately([]() -> std::string { throw std::out_of_range("7"); }), ComputationError);
}

}  // namespace
}  // namespace pfdm
