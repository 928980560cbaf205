#include "solver/relaxation.h"

#include "tests/solver/solver_checks.h"

namespace pfdm {
namespace {

using Damage = CellField<double>;

Damage field(std::initializer_list<double> values) { return Damage(std::vector<double>(values)); }

TEST(Relaxation, TakesTheFirstAnswerAsItIs) {
  Relaxation relaxation;
  EXPECT_EQ(relaxation.next(field({0.1, 0.2}), field({0.3, 0.2}), field({0.0, 0.0})), field({0.3, 0.2}));
}

// Whatever the answers do, from wherever they start.
TEST(Relaxation, StaysWithinTheBounds) {
  constexpr Index n = 5000;
  RandomNumbers random;
  const Damage lower = random.field(n, 0.0, 0.9);
  Relaxation relaxation;
  Damage d = lower;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Damage answer(as_size(n));
    for (Index c = 0; c < n; ++c) answer[c] = random.between(lower[c], 1.0);
    d = relaxation.next(d, answer, lower);
    for (Index c = 0; c < n; ++c) {
      ASSERT_GE(d[c], lower[c]);
      ASSERT_LE(d[c], 1.0);
    }
  }
}

// Increments that shrink by the same share each time have a limit, which the secant factor finds in one step.
TEST(Relaxation, FindsTheLimitOfAGeometricSeries) {
  constexpr double rho = 0.6;  // 1/(1 - rho) = 2.5
  const Damage limit = field({0.8, 0.4}), lower = field({0.0, 0.0});
  const auto answer_to = [&](const Damage& d) {
    return field({limit[0] - rho * (limit[0] - d[0]), limit[1] - rho * (limit[1] - d[1])});
  };
  Relaxation relaxation;
  Damage d = field({0.0, 0.0});
  for (int iteration = 0; iteration < 2; ++iteration) d = relaxation.next(d, answer_to(d), lower);
  for (Index c = 0; c < 2; ++c) EXPECT_NEAR(d[c], limit[c], 1e-12);
}

// A slowly creeping front is not extrapolated without limit.
TEST(Relaxation, DoesNotOvershootACreepingFront) {
  Relaxation relaxation;
  const Damage lower = field({0.0});
  relaxation.next(field({0.0}), field({0.01}), lower);
  const double next = relaxation.next(field({0.01}), field({0.02}), lower)[0];
  EXPECT_GT(next, 0.02);
  EXPECT_LE(next, 0.01 + 0.01 * 10.0);
}

// Three cells take turns to go on by two equal increments, which asks for long steps; either each goes on for ever, or
// it goes back the next time.
struct TurnTaking {
  Relaxation relaxation;
  double factor = 0.0;  // of the last step over its increment
};

TurnTaking take_turns(int n_iterations, bool goes_back) {
  TurnTaking cells;
  const Damage lower = field({0.0, 0.0, 0.0});
  Damage d = field({0.5, 0.5, 0.5});
  for (int iteration = 0; iteration < n_iterations; ++iteration) {
    const int turn = iteration / 2;
    const double increment = goes_back && turn / 3 % 2 == 1 ? -1e-4 : 1e-4;
    Damage answer = d;
    answer[turn % 3] += increment;
    const Damage next = cells.relaxation.next(d, answer, lower);
    cells.factor = (next[turn % 3] - d[turn % 3]) / increment;
    d = next;
  }
  return cells;
}

TEST(Relaxation, TakesTheFactorBackWhereStepsLeadNowhere) {
  EXPECT_NEAR(take_turns(12, true).factor, 5.0, 1e-9);
  EXPECT_NEAR(take_turns(24, true).factor, 2.5, 1e-9);
  EXPECT_NEAR(take_turns(72, true).factor, 1.0, 1e-9);
  EXPECT_NEAR(take_turns(72, false).factor, 5.0, 1e-9);
}

TEST(Relaxation, NoticesCircles) {
  EXPECT_FALSE(take_turns(95, true).relaxation.goes_in_circles());
  EXPECT_TRUE(take_turns(96, true).relaxation.goes_in_circles());
  EXPECT_FALSE(take_turns(480, false).relaxation.goes_in_circles());
}

// One cell that flips for ever is damped although the field as a whole creeps.
TEST(Relaxation, HalvesTheIncrementWhereItTurns) {
  Relaxation relaxation;
  const Damage lower = field({0.0, 0.0, 0.0, 0.0});
  relaxation.next(field({0.1, 0.1, 0.1, 0.5}), field({0.3, 0.3, 0.3, 0.52}), lower);
  const Damage next = relaxation.next(field({0.3, 0.3, 0.3, 0.52}), field({0.45, 0.45, 0.45, 0.5}), lower);
  for (Index c = 0; c < 3; ++c) EXPECT_GT(next[c], 0.45);
  EXPECT_NEAR(next[3], 0.51, 1e-12);
}

// A cell that answers every change with three times its opposite, beside one that creeps: half steps would swing for
// ever, and hold up the other.
TEST(Relaxation, SettlesACellThatOverreacts) {
  const Damage lower = field({0.0, 0.0});
  const auto answer_to = [&](const Damage& d) { return field({0.5 - 3.0 * (d[0] - 0.5), 0.8 - 0.9 * (0.8 - d[1])}); };
  Relaxation relaxation;
  Damage d = field({0.501, 0.2});
  for (int iteration = 0; iteration < 40; ++iteration) d = relaxation.next(d, answer_to(d), lower);
  EXPECT_NEAR(d[0], 0.5, 1e-4);
  EXPECT_NEAR(d[1], 0.8, 1e-4);
}

TEST(Relaxation, StandsStillAtAFixedPoint) {
  Relaxation relaxation;
  const Damage d = field({0.2, 0.7}), lower = field({0.0, 0.0});
  for (int iteration = 0; iteration < 3; ++iteration) EXPECT_EQ(relaxation.next(d, d, lower), d);
}

}  // namespace
}  // namespace pfdm
