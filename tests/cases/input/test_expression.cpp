#include "cases/program/input/config/expression.h"
#include "physics/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace pfdm::this_file {
namespace {

TEST(Expression, IsAFunctionOfPlaceAndLoad) {
  const Expression f("x + 10*y + 100*z + 1000*t + sin(pi/2)");
  EXPECT_DOUBLE_EQ(f(Vector(1, 2, 3), 4), 4322.0);
  EXPECT_DOUBLE_EQ(Expression("t < 0.5 ? 2*t : 1")(Vector::Zero(), 0.25), 0.5);
}

TEST(Expression, SaysWhatIsWrong) {
  try {
    const Expression f("0.1*q");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"0.1*q\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("x, y, z"), std::string::npos);
  }
  EXPECT_THROW(Expression("1 +"), InputError);
  EXPECT_THROW(Expression(""), InputError);
  EXPECT_THROW(Expression("1, 2"), InputError);
}

TEST(Expression, RefusesValuesThatAreNotFinite) {
  const Expression f("1/t");
  EXPECT_DOUBLE_EQ(f(Vector::Zero(), 2.0), 0.5);
  EXPECT_THROW(f(Vector::Zero(), 0.0), InputError);
}

TEST(Expression, MayBeCalledFromSeveralThreads) {
  const Expression f("2*x");
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (int i = 0; i < 2000; ++i)
        if (f(Vector(k, 0, 0), 0) != 2.0 * k) ++wrong;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace pfdm::this_file
