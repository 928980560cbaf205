// Jumps over cycles of a body with fatigue, against computing every cycle; threads.

#include "solver/fracture/damage/cycled_fatigue.h"
#include "solver/parallel.h"
#include "tests/verification/fatigue_plate.h"

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

using namespace fatigue_plate;

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

// What a jump takes from the toughness of damage that is there has been dissipated before.
TEST(FatigueJumps, GiveNoSurfaceEnergyBack) {
  for (const Law& law : {asymptotic, logarithmic}) {
    Plate plate{.law = law, .alpha_T = 2e4};
    plate.cycles = {.cycle = 1.0, .steps = 4, .jump_tolerance = 0.05};
    const Outcome outcome = stretch(plate, 120.0, 4);
    ASSERT_GT(outcome.state.fatigue.jumped_cycles, 10.0);
    ASSERT_GT(outcome.rows.back().damage, 0.5);
    double before = 0.0;
    for (const EnergyAccount& account : outcome.accounts) {
      EXPECT_GE(account.fracture, before * (1.0 - 1e-12)) << law.name;
      before = account.fracture;
    }
  }
}

// Two computed cycles and a jump over 997, to ten million: each part of a cycle has its length, each cycle counts once.
TEST(FatigueJumps, KeepTheirPlaceInTheCycles) {
  struct Case {
    double cycle;
    Index steps;
  };
  const Mesh mesh = mesh_of(1);
  for (const auto& [cycle, steps] : {Case{0.7, 3}, Case{0.1, 4}, Case{1.0, 3}}) {
    const double part = cycle / double(steps), end = 1e7 * cycle;
    const Plate plate{.law = asymptotic, .cycles = {.cycle = cycle, .steps = steps, .jump_tolerance = 0.02}};
    const FractureModel model = model_of(plate, mesh);
    const CycledFatigue cells(mesh, model);
    FractureState state;
    state.fatigue = cells.virgin();
    for (double cycles = 0.0; state.load < 0.999 * end; cycles += 999.0) {
      for (Index k = 0; k < 2 * steps; ++k) {
        const double stop = cells.next_stop(state.load, end);
        ASSERT_NEAR(stop - state.load, part, 1e-6 * part) << "at " << state.load << " of cycles of " << cycle;
        state.load = stop;
        state.fatigue.energy[0] += 1.0;
        cells.end_cycle(state.load, state.fatigue);
      }
      ASSERT_EQ(state.fatigue.computed_cycles, 2) << "at " << state.load << " of cycles of " << cycle;
      ASSERT_EQ(state.fatigue.cycle_growth[0], double(steps));
      cells.jump(997.0, state);
      ASSERT_NEAR(state.load / cycle, cycles + 999.0, 1e-6);
    }
  }
}

// A frame whose time has an error of rounding is the end of the cycle, which counts once.
TEST(FatigueJumps, TakeAFrameForTheEndOfItsCycle) {
  const Mesh mesh = mesh_of(1);
  const Plate plate{.law = asymptotic, .cycles = {.cycle = 1.0, .steps = 2, .jump_tolerance = 0.02}};
  const FractureModel model = model_of(plate, mesh);
  const CycledFatigue cells(mesh, model);
  for (const double error : {-1e-10, 1e-10}) {
    const double frame = 7.0 + error;
    EXPECT_EQ(cells.next_stop(6.5, frame), frame);
    EXPECT_EQ(cells.next_stop(frame, 100.0), 7.5);
    FatigueState fatigue = cells.virgin();
    fatigue.energy[0] = 3.0;
    cells.end_cycle(frame, fatigue);
    cells.end_cycle(7.0, fatigue);
    EXPECT_EQ(fatigue.computed_cycles, 1);
    EXPECT_EQ(fatigue.cycle_growth[0], 3.0);
  }
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
