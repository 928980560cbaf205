// Jumps over cycles of a body with fatigue, against computing every cycle; threads.

#include "solver/parallel.h"
#include "tests/verification/tired_plate.h"

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

using namespace tired;

// While no damage grows alpha_bar is the same as without jumps.
TEST(FatigueJumps, AreExactWhileTheCyclesAreAlike) {
  constexpr FatigueCycles jumping{.cycle = 1.0, .steps = 4, .jump_tolerance = 0.02};
  const Plate computed{.law = asymptotic, .alpha_T = 2e4};
  Plate jumped = computed;
  jumped.cycles = jumping;
  const Outcome a = stretch(computed, 20.0, 4), b = stretch(jumped, 20.0, 4);
  EXPECT_EQ(a.rows.back().damage, 0.0);
  EXPECT_EQ(b.rows.back().cycles, 20.0);
  EXPECT_GT(b.state.fatigue.jumped_cycles, 10.0);
  EXPECT_LT(4.0 * (20.0 - b.state.fatigue.jumped_cycles), double(b.rows.size()) + 0.5);
  EXPECT_NEAR(b.rows.back().energy, a.rows.back().energy, 1e-9 * a.rows.back().energy);
}

// With damage that grows the result comes nearer as the tolerance falls.
TEST(FatigueJumps, ConvergeWithTheirTolerance) {
  const Plate computed{.law = asymptotic, .alpha_T = 1e5};
  const double exact = stretch(computed, 250.0, 4).rows.back().damage;
  ASSERT_GT(exact, 0.2);
  ASSERT_LT(exact, 0.8);
  std::vector<double> errors, cycles;
  for (const double tolerance : {0.04, 0.02, 0.01}) {
    Plate jumped = computed;
    jumped.cycles = {.cycle = 1.0, .steps = 4, .jump_tolerance = tolerance};
    const Outcome outcome = stretch(jumped, 250.0, 4);
    errors.push_back(std::abs(outcome.rows.back().damage - exact));
    cycles.push_back(250.0 - outcome.state.fatigue.jumped_cycles);
  }
  report_row("error of d",
             {{"0.04", errors[0]}, {"0.02", errors[1]}, {"0.01", errors[2]}, {"computed cycles", cycles[2]}});
  EXPECT_LT(errors[2], errors[0]);
  EXPECT_LT(errors[2], 0.01);
  EXPECT_LT(cycles[2], 125.0);
}

TEST(FatigueJumps, AreTheSameOnAnyNumberOfThreads) {
  Plate plate{.crack = "AT2", .law = asymptotic, .cells = 40, .weakness = 0.05};
  plate.cycles = {.cycle = 1.0, .steps = 2, .jump_tolerance = 0.1, .computed_cycles = 1};
  const auto end = [&](int threads) {
    set_threads(threads);
    FractureState state = stretch(plate, 6.0, 2, 1e-4).state;
    set_threads(1);
    return state;
  };
  const FractureState alone = end(1), together = end(2);
  EXPECT_GT(alone.fatigue.jumped_cycles, 0.0);
  EXPECT_TRUE(alone.damage == together.damage);
  EXPECT_TRUE(alone.displacement == together.displacement);
  EXPECT_TRUE(alone.fatigue == together.fatigue);
  EXPECT_TRUE(alone.energy == together.energy);
}

}  // namespace
}  // namespace pfdm::verification::this_file
