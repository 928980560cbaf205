// Posteriors against closed forms, sums over a grid, and the ranks of true values.

#include "solver/calibration/posterior.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "physics/error.h"
#include "solver/calibration/calibration_statistics.h"

namespace pfdm::this_file {
namespace {

using Model = double (*)(double x, std::span<const double> p);
double straight(double x, std::span<const double> p) { return p[0] + p[1] * x; }
double michaelis(double x, std::span<const double> p) { return p[0] * x / (p[1] + x); }
double decaying(double x, std::span<const double> p) { return p[0] * std::exp(-p[1] * x); }

FitProblem problem_of(Model model, const std::vector<double>& x, const std::vector<double>& y,
                      std::vector<FitParameter> parameters, double sigma = 0.0) {
  return {.parameters = std::move(parameters),
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i)
              r.push_back((model(x[i], p) - y[i]) / (sigma > 0.0 ? sigma : 1.0));
            return r;
          },
          .noise_is_known = sigma > 0.0};
}

FitParameter parameter(std::string name, double first, double lower, double upper, bool log_scale = false) {
  return {.name = std::move(name), .unit = "1", .first = first, .lower = lower, .upper = upper, .log_scale = log_scale};
}

double mean_of(const Posterior& p, std::size_t k) {
  double sum = 0.0;
  for (const auto& sample : p.samples) sum += sample[k];
  return sum / static_cast<double>(p.samples.size());
}

const std::vector<double> line_x{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0},
    line_y{1.12, 2.83, 5.21, 6.89, 9.30, 10.87, 13.05, 14.91};

// Of a line the posterior is normal, or Student's where the noise is not known: the linear interval.
TEST(Posterior, OfALineIsTheLinearInterval) {
  for (const double sigma : {0.2, 0.0}) {
    const FitProblem problem = problem_of(
        straight, line_x, line_y, {parameter("a", 1.0, -100.0, 100.0), parameter("b", 2.0, -100.0, 100.0)}, sigma);
    const FitResult result = fit(problem);
    const Posterior found = posterior(problem, result);
    EXPECT_LT(found.emulator_error, 1e-3);
    EXPECT_LE(found.evaluations, 13);
    EXPECT_GT(found.effective, 1000.0);
    EXPECT_FALSE(found.is_cut);
    for (std::size_t k = 0; k < 2; ++k) {
      const FitEstimate& e = result.estimates[k];
      EXPECT_NEAR(found.quantile(k, 0.5), e.value, 0.1 * e.standard_error) << sigma;
      EXPECT_NEAR(found.quantile(k, 0.025), e.lower_95, 0.25 * e.standard_error) << sigma;
      EXPECT_NEAR(found.quantile(k, 0.975), e.upper_95, 0.25 * e.standard_error) << sigma;
    }
  }
}

// Residuals that are correlated widen it.
TEST(Posterior, IsWidened) {
  const FitProblem problem = problem_of(straight, line_x, line_y,
                                        {parameter("a", 1.0, -100.0, 100.0), parameter("b", 2.0, -100.0, 100.0)}, 0.2);
  const FitResult result = fit(problem);
  const Posterior found = posterior(problem, result, {.widening = 2.0});
  EXPECT_NEAR((found.quantile(1, 0.84) - found.quantile(1, 0.16)) / 2.0, 2.0 * result.estimates[1].standard_error,
              0.15 * result.estimates[1].standard_error);
}

TEST(Posterior, TakesPriorsAndEndsAtBounds) {
  FitProblem problem =
      problem_of(straight, line_x, line_y, {parameter("a", 1.0, -100.0, 100.0), parameter("b", 1.9, 0.0, 1.95)}, 0.2);
  problem.parameters[0].prior = GaussianPrior{.mean = 2.0, .standard_deviation = 0.02};
  FitProblem open = problem;
  open.parameters[1].upper = 100.0;
  const Posterior found = posterior(open, fit(open));
  EXPECT_NEAR(mean_of(found, 0), 1.98, 0.02);  // the data alone say 1.1 within 0.13
  problem.parameters[0].prior.reset();
  FitResult inside = fit(open);
  inside.estimates[1].value = 1.94;
  const Posterior bounded = posterior(problem, inside);
  for (const auto& sample : bounded.samples) EXPECT_LE(sample[1], 1.95);
}

// Velocity of an enzyme's reaction (Bates, Watts 1988, appendix 1).
FitProblem enzyme() {
  return problem_of(michaelis, {0.02, 0.02, 0.06, 0.06, 0.11, 0.11, 0.22, 0.22, 0.56, 0.56, 1.1, 1.1},
                    {76, 47, 97, 107, 123, 139, 159, 152, 191, 201, 207, 200},
                    {parameter("v", 200.0, 10.0, 1e3), parameter("k", 0.05, 1e-4, 10.0)});
}

// Its posterior by sums over a grid of both parameters between these values.
class OnGrid {
 public:
  OnGrid(const FitProblem& problem, double least_squares, const std::array<double, 2>& low,
         const std::array<double, 2>& high)
      : low_(low), high_(high) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        double squares = 0.0;
        const auto residuals = problem.residuals(std::array<double, 2>{value(0, i), value(1, j)});
        for (const double r : *residuals) squares += r * r;
        const double density = std::pow(squares / least_squares, -0.5 * 12.0);
        marginal_[0][i] += density;
        marginal_[1][j] += density;
      }
  }

  double quantile(std::size_t k, double share) const {
    double all = 0.0, sum = 0.0;
    for (const double m : marginal_[k]) all += m;
    std::size_t i = 0;
    while (sum < share * all) sum += marginal_[k][i++];
    return value(k, i);
  }

 private:
  static constexpr std::size_t n = 400;
  double value(std::size_t k, std::size_t i) const {
    return low_[k] + (high_[k] - low_[k]) * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
  }

  std::array<double, 2> low_, high_;
  std::array<std::array<double, n>, 2> marginal_{};
};

TEST(Posterior, OfANonlinearModelIsThatOfAGrid) {
  FitProblem problem = enzyme();
  const FitResult result = fit(problem);
  // Without a bound, and with one near the estimate, which the points about it have to heed.
  for (const double bound : {275.0, result.estimates[0].value + 0.4 * result.estimates[0].standard_error}) {
    problem.parameters[0].upper = bound;
    const Posterior found = posterior(problem, result);
    EXPECT_LT(found.emulator_error, 0.05);
    EXPECT_FALSE(found.is_cut);
    EXPECT_LE(found.evaluations, 48);
    const OnGrid due(problem, result.sum_of_squares, {160.0, 0.02}, {bound, 0.16});
    for (std::size_t k = 0; k < 2; ++k)
      for (const double share : {0.025, 0.5, 0.975})
        EXPECT_NEAR(found.quantile(k, share), due.quantile(k, share), 0.3 * result.estimates[k].standard_error)
            << k << ' ' << share << ' ' << bound;
  }
}

// Two parameters that are all but one, correlated by -0.998, and a bound near the estimate of the second one: it has
// what is left of its normal distribution, and the points stay where the others are likely.
TEST(Posterior, EndsAtABoundWhereParametersAreCorrelated) {
  std::vector<double> x, y;
  for (int i = 0; i < 8; ++i)
    x.push_back(10.0 + 0.1 * i), y.push_back(1.0 + 2.0 * x.back() + 0.05 * ((i * 5) % 8 - 3.5));
  FitProblem problem =
      problem_of(straight, x, y, {parameter("a", 1.0, -1e3, 1e3), parameter("b", 2.0, -1e3, 1e3)}, 0.1);
  const FitResult result = fit(problem);
  const FitEstimate& b = result.estimates[1];
  problem.parameters[1].upper = b.value + 0.4 * b.standard_error;
  double farthest = 0.0;
  const auto residuals = problem.residuals;
  problem.residuals = [&](std::span<const double> p) {
    EXPECT_LT(p[1], problem.parameters[1].upper);
    double squares = 0.0;
    auto r = residuals(p);
    for (const double value : *r) squares += value * value;
    farthest = std::max(farthest, std::sqrt(squares - result.sum_of_squares));  // in standard errors
    return r;
  };
  const Posterior found = posterior(problem, result);
  EXPECT_LT(farthest, 6.0);
  EXPECT_LE(found.evaluations, 13);
  EXPECT_LT(found.emulator_error, 1e-3);
  // Quantiles of the standard normal distribution below 0.4, whose share is 0.6554.
  for (const auto& [share, due] : {std::pair(0.025, -2.1359), {0.5, -0.4466}, {0.975, 0.3574}})
    EXPECT_NEAR((found.quantile(1, share) - b.value) / b.standard_error, due, 0.15) << share;
}

// Values drawn from the prior, data from these: their ranks among the samples are uniform (Cook, Gelman, Rubin, J.
// Comput. Graph. Stat. 15 (2006) 675).
TEST(Posterior, RanksOfTrueValuesAreUniform) {
  constexpr int sets = 200, bins = 10;
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::vector<double> x;
  for (int i = 0; i < 30; ++i) x.push_back(0.1 * i);
  std::array<std::array<int, bins>, 2> counts{};
  for (int set = 0; set < sets; ++set) {
    const std::array<double, 2> truth{std::exp(0.2 * normal(engine)), std::exp(0.3 * normal(engine))};
    std::vector<double> y;
    for (const double at : x) y.push_back(decaying(at, truth) + 0.1 * normal(engine));
    std::vector<FitParameter> parameters{parameter("a", 1.0, 1e-3, 1e3, true), parameter("b", 1.0, 1e-3, 1e3, true)};
    parameters[0].prior = GaussianPrior{.mean = 1.0, .standard_deviation = 0.2};
    parameters[1].prior = GaussianPrior{.mean = 1.0, .standard_deviation = 0.3};
    const FitProblem problem = problem_of(decaying, x, y, parameters, 0.1);
    const Posterior found = posterior(problem, fit(problem), {.samples = 400, .seed = static_cast<std::uint64_t>(set)});
    for (std::size_t k = 0; k < 2; ++k) {
      const auto below = std::ranges::count_if(found.samples, [&](const auto& s) { return s[k] < truth[k]; });
      const auto bin = static_cast<std::size_t>(bins * below / (std::ssize(found.samples) + 1));
      ++counts[k][bin];
    }
  }
  for (const auto& of : counts) {
    double chi_square = 0.0;
    for (const int count : of) chi_square += std::pow(count - sets / double(bins), 2) / (sets / double(bins));
    EXPECT_LT(chi_square, 21.7) << "exceeded by one in a hundred, 9 degrees of freedom";
  }
}

// A curve that falls at one place tells nothing between two data: no polynomial has that, and its error is said.
TEST(Posterior, SaysWhatTheEmulatorMisses) {
  std::vector<double> x, y;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal(0.0, 0.1);
  const auto falls = [](double at, std::span<const double> p) { return at < p[0] ? at : 0.3; };
  for (int i = 0; i < 60; ++i) {
    x.push_back(0.05 * i);
    const std::array<double, 1> truth{2.02};
    y.push_back(falls(x.back(), truth) + normal(engine));
  }
  const FitProblem problem = problem_of(falls, x, y, {parameter("p", 2.03, 1.0, 3.0)}, 0.1);
  FitResult result = fit(problem);
  result.covariance = Eigen::MatrixXd::Constant(1, 1, 0.04 * 0.04);
  const Posterior found = posterior(problem, result);
  EXPECT_GT(found.emulator_error, 0.1);
  EXPECT_LT(found.quantile(0, 0.025), 2.0);
  EXPECT_GT(found.quantile(0, 0.975), 2.05);
}

TEST(Posterior, RefusesWhatTheDataDoNotDetermine) {
  const FitProblem problem =
      problem_of([](double x, std::span<const double> p) { return (p[0] + p[1]) * x; }, line_x, line_y,
                 {parameter("a", 1.0, -100.0, 100.0), parameter("b", 1.0, -100.0, 100.0)}, 0.2);
  EXPECT_THROW(posterior(problem, fit(problem)), ComputationError);
}

}  // namespace
}  // namespace pfdm::this_file
