// Trials of another law end where a run breaks off, and go on where it does not converge.

#include "cases/program/studies/fit/law_trial.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "physics/error.h"

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;

FitProblem line() {
  return {.parameters = {{.name = "slope", .unit = "", .first = 1.0, .lower = 0.1, .upper = 10.0}},
          .residuals =
              [](std::span<const double> p) {
                return std::optional(std::vector{p[0] - 2.0, 2.0 * p[0] - 4.1, 3.0 * p[0] - 5.9});
              },
          .noise_is_known = true};
}

/// At the estimates of the line, whose residuals beyond are these.
std::optional<TriedLaw> tried_with(const std::function<std::optional<std::vector<double>>()>& beyond) {
  std::ostringstream out;
  Log log(out, out, false, false);
  const FitResult result = fit(line());
  const TemporaryCase directory(bar_case());
  const std::vector<CaseVariant> laws{{.file = open_case(directory.path()), .shown = "another"}};
  const auto problem_with = [&](const CaseFile&) {
    FitProblem problem = line();
    problem.residuals = [&, n = 0](std::span<const double> p) mutable {
      return n++ == 0 ? line().residuals(p) : beyond();  // the first run ranks the laws
    };
    return problem;
  };
  return best_other_law(laws, result, problem_with, {}, log);
}

TEST(LawTrial, HasNoAnswerWhereNoRunConverges) {
  EXPECT_FALSE(tried_with([] { return std::nullopt; }));
}

TEST(LawTrial, EndsTheFitWhereARunBreaksOff) {
  try {
    tried_with([]() -> std::optional<std::vector<double>> { throw ComputationError("cannot write run.log"); });
    FAIL() << "goes on";
  } catch (const ComputationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write run.log"));
  }
}

}  // namespace
}  // namespace pfdm::this_file
