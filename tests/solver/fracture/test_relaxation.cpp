#include "solver/fracture/equilibrium/relaxation.h"

#include "tests/solver/solver_checks.h"

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
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
    Damage answer(n);
    for (Index c = 0; c < n; ++c) answer[c] = random.between(lower[c], 1.0);
    d = relaxation.next(d, answer, lower);
    for (Index c = 0; c < n; ++c) {
      ASSERT_GE(d[c], lower[c]);
      ASSERT_LE(d[c], 1.0);
    }
  }
}

int iterations_to(double precision, double rho, Relaxation* relaxation) {
  const Damage limit = field({0.8, 0.4}), lower = field({0.0, 0.0});
  Damage d = field({0.0, 0.0});
  int iteration = 0;
  for (; std::abs(d[0] - limit[0]) > precision && iteration < 20000; ++iteration) {
    const Damage answer = field({limit[0] - rho * (limit[0] - d[0]), limit[1] - rho * (limit[1] - d[1])});
    d = relaxation != nullptr ? relaxation->next(d, answer, lower) : answer;
  }
  return iteration;
}

// Where each answer leaves the share rho of the error, plain alternation takes log(precision)/log(rho) iterations, and
// momentum with restarts a multiple of 1/sqrt(1 - rho).
TEST(Relaxation, TakesTheSquareRootOfTheIterations) {
  for (const double rho : {0.9, 0.99, 0.999}) {
    Relaxation relaxation;
    const int plain = iterations_to(1e-4, rho, nullptr), accelerated = iterations_to(1e-4, rho, &relaxation);
    EXPECT_GT(plain, 8.0 / (1.0 - rho));
    EXPECT_LT(accelerated, 9.0 / std::sqrt(1.0 - rho)) << rho;
  }
}

// On the way from an unstable state each increment is 1 + epsilon times the one before.
TEST(Relaxation, LeavesAnUnstableStateInTheSquareRootOfTheIterations) {
  constexpr double epsilon = 1e-3;
  Relaxation relaxation;
  const Damage lower = field({0.0});
  Damage d = field({1e-6});
  int iteration = 0;
  for (; d[0] < 0.5 && iteration < 20000; ++iteration)
    d = relaxation.next(d, field({std::min((1.0 + epsilon) * d[0], 1.0)}), lower);
  EXPECT_LT(iteration, 1000);  // log(0.5e6)/epsilon = 13,000 without
}

// Equal increments: the momentum grows as t does, 1, 1.618, 2.194 (t' = (1 + sqrt(1 + 4 t^2))/2).
TEST(Relaxation, CarriesEachIterateOnAlongTheLastStep) {
  Relaxation relaxation;
  const Damage lower = field({0.0});
  const auto next = [&](double d) { return relaxation.next(field({d}), field({d + 0.01}), lower)[0]; };
  EXPECT_NEAR(next(0.00), 0.01, 1e-12);
  EXPECT_NEAR(next(0.01), 0.02, 1e-12);
  EXPECT_NEAR(next(0.02), 0.03 + 0.618034 / 2.193527 * 0.01, 1e-7);
}

TEST(Relaxation, StartsAnewWhereTheIncrementsPointBack) {
  Relaxation relaxation;
  const Damage lower = field({0.0});
  Damage d = field({0.1});
  for (int iteration = 0; iteration < 10; ++iteration) d = relaxation.next(d, field({d[0] + 0.01}), lower);
  const double turn = d[0];
  EXPECT_DOUBLE_EQ(relaxation.next(d, field({turn - 0.02}), lower)[0], turn - 0.01);  // half an increment, no momentum
}

// Three cells take turns to go on by two equal increments; either each goes on for ever, or it goes back the next time.
struct TurnTaking {
  Relaxation relaxation;
  double factor = 0.0;  // of the last step over its increment
};

TurnTaking take_turns(Relaxation::Way way, int n_iterations, bool goes_back) {
  TurnTaking cells{Relaxation(way)};
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

TEST(Relaxation, SecantTakesTheFactorBackWhereStepsLeadNowhere) {
  constexpr auto way = Relaxation::Way::secant;
  EXPECT_NEAR(take_turns(way, 12, true).factor, 5.0, 1e-9);
  EXPECT_NEAR(take_turns(way, 24, true).factor, 2.5, 1e-9);
  EXPECT_NEAR(take_turns(way, 72, true).factor, 1.0, 1e-9);
  EXPECT_NEAR(take_turns(way, 72, false).factor, 5.0, 1e-9);
}

// Increments that shrink by the same share each time have a limit, which the secant factor finds in one step.
TEST(Relaxation, SecantFindsTheLimitOfAGeometricSeries) {
  constexpr double rho = 0.6;  // 1/(1 - rho) = 2.5
  const Damage limit = field({0.8, 0.4}), lower = field({0.0, 0.0});
  const auto answer_to = [&](const Damage& d) {
    return field({limit[0] - rho * (limit[0] - d[0]), limit[1] - rho * (limit[1] - d[1])});
  };
  Relaxation relaxation(Relaxation::Way::secant);
  Damage d = field({0.0, 0.0});
  for (int iteration = 0; iteration < 2; ++iteration) d = relaxation.next(d, answer_to(d), lower);
  for (Index c = 0; c < 2; ++c) EXPECT_NEAR(d[c], limit[c], 1e-12);
}

// A slowly creeping front is not extrapolated without limit.
TEST(Relaxation, SecantDoesNotOvershootACreepingFront) {
  Relaxation relaxation(Relaxation::Way::secant);
  const Damage lower = field({0.0});
  relaxation.next(field({0.0}), field({0.01}), lower);
  const double next = relaxation.next(field({0.01}), field({0.02}), lower)[0];
  EXPECT_NEAR(next, 0.01 + 5.0 * 0.01, 1e-12);  // equal increments ask for an infinite step; five are the most
}

// Around (0.5, 0.5) by an eighth of a turn at each answer, as alternation does where neither of two cells is the
// weaker.
Damage turned(const Damage& d) {
  const double x = d[0] - 0.5, y = d[1] - 0.5, half = std::numbers::sqrt2 / 2.0;
  return field({0.5 + half * (x - y), 0.5 + half * (x + y)});
}

double distance_from_the_middle(const Damage& d) { return std::hypot(d[0] - 0.5, d[1] - 0.5); }

TEST(Relaxation, FindsTheMiddleOfCircles) {
  Relaxation relaxation;
  const Damage lower = field({0.0, 0.0});
  Damage d = field({0.52, 0.5});
  for (int iteration = 0; iteration < 95; ++iteration) d = relaxation.next(d, turned(d), lower);
  EXPECT_GT(distance_from_the_middle(d), 1e-3);
  for (int iteration = 0; iteration < 10; ++iteration) d = relaxation.next(d, turned(d), lower);
  EXPECT_LT(distance_from_the_middle(d), 1e-9);
  EXPECT_FALSE(relaxation.goes_in_circles());
}

TEST(Relaxation, NoticesCirclesThatHaveNoMiddle) {
  Relaxation relaxation;
  const Damage lower = field({0.0});
  Damage d = field({0.45});
  const auto go_on = [&](int n_iterations) {
    for (int i = 0; i < n_iterations; ++i) d = relaxation.next(d, field({d[0] < 0.5 ? d[0] + 0.1 : d[0] - 0.1}), lower);
  };
  go_on(191);
  EXPECT_FALSE(relaxation.goes_in_circles());
  // Two stretches of 48 must make no way in a row; by rounding, Anderson's may make some.
  int stretches = 0;
  for (go_on(1); !relaxation.goes_in_circles() && stretches < 10; ++stretches) go_on(48);
  EXPECT_LE(stretches, 4);
}

TEST(Relaxation, DoesNotTakeAFrontForCircles) {
  for (const auto way : {Relaxation::Way::momentum, Relaxation::Way::secant})
    EXPECT_FALSE(take_turns(way, 480, false).relaxation.goes_in_circles());
}

TEST(AndersonMixing, SolvesALinearProblemOfSoManyUnknownsInSoManySteps) {
  // Answers that grow by a half in one direction, turn in the plane of two and fall in the last.
  const auto answer_to = [](const Damage& d) {
    return field(
        {0.3 + 1.5 * (d[0] - 0.3), 0.4 - 1.1 * (d[2] - 0.5), 0.5 + 1.1 * (d[1] - 0.4), 0.6 + 0.2 * (d[3] - 0.6)});
  };
  AndersonMixing mixing;
  const Damage lower = field({0.0, 0.0, 0.0, 0.0});
  Damage d = field({0.31, 0.42, 0.5, 0.57});
  for (int iteration = 0; iteration < 6; ++iteration) d = mixing.next(d, answer_to(d), lower);
  const Damage fixed = field({0.3, 0.4, 0.5, 0.6});
  for (Index c = 0; c < 4; ++c) EXPECT_NEAR(d[c], fixed[c], 1e-9) << c;
}

// One cell that flips for ever is damped although the field as a whole creeps.
TEST(Relaxation, HalvesTheIncrementWhereItTurns) {
  Relaxation relaxation;
  const Damage lower = field({0.0, 0.0, 0.0, 0.0});
  relaxation.next(field({0.1, 0.1, 0.1, 0.46}), field({0.2, 0.2, 0.2, 0.48}), lower);
  relaxation.next(field({0.2, 0.2, 0.2, 0.48}), field({0.3, 0.3, 0.3, 0.52}), lower);
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
}  // namespace pfdm::this_file
