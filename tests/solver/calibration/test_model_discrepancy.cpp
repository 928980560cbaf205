// Posteriors of models that may have a smooth error, against dense algebra, drawn truths and models that are wrong.

#include "solver/calibration/calibration_statistics.h"
#include "solver/calibration/posterior.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace pfdm::this_file {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Model = double (*)(double x, std::span<const double> p);
double straight(double x, std::span<const double> p) { return p[0] + p[1] * x; }
double decaying(double x, std::span<const double> p) { return p[0] * std::exp(-p[1] * x); }

FitParameter parameter(std::string name, double first, double lower, double upper, bool log_scale = false) {
  return {.name = std::move(name), .unit = "1", .first = first, .lower = lower, .upper = upper, .log_scale = log_scale};
}

struct Data {
  std::vector<double> x, y, deviation;
};

FitProblem problem_of(Model model, const Data& data, std::vector<FitParameter> parameters, bool noise_is_known) {
  return {.parameters = std::move(parameters),
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < data.x.size(); ++i)
              r.push_back((model(data.x[i], p) - data.y[i]) / data.deviation[i]);
            return r;
          },
          .noise_is_known = noise_is_known};
}

double mean_deviation(const Data& data) {
  double mean = 0.0;
  for (const double deviation : data.deviation) mean += deviation / static_cast<double>(data.deviation.size());
  return mean;
}

// The largest amplitude: twice what the best fit leaves, whose deviations are in data.
ResidualPlaces places_of(const Data& data, const FitResult& result) {
  return {data.x, data.deviation, 2.0 * mean_deviation(data) * result.rms};
}

std::vector<double> places(int n, double to) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(to * i / (n - 1));
  return x;
}

// Of the residuals over their deviations, with a discrepancy of this length, `ratio` times as large as the noise.
MatrixXd covariance_of(const Data& data, double length, double ratio) {
  const auto n = std::ssize(data.x);
  const double scale = mean_deviation(data);
  MatrixXd C = MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      C(i, j) += ratio * ratio * scale * scale / (data.deviation[i] * data.deviation[j]) *
                 std::exp(-0.5 * std::pow((data.x[i] - data.x[j]) / length, 2));
  return C;
}

// A normal distribution of a line's parameters.
struct Node {
  VectorXd mean;
  MatrixXd root;  // of the covariance
};

std::vector<VectorXd> draws_of(const std::vector<Node>& nodes, std::vector<double> logarithms) {
  const double best = std::ranges::max(logarithms);
  for (double& l : logarithms) l = std::exp(l - best);
  std::discrete_distribution<std::size_t> which(logarithms.begin(), logarithms.end());
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  std::vector<VectorXd> draws;
  for (int i = 0; i < 20000; ++i) {
    const Node& node = nodes[which(engine)];
    draws.emplace_back(node.mean + node.root * Eigen::Vector2d(normal(engine), normal(engine)));
  }
  return draws;
}

// A line's parameters by generalised least squares with every length, amplitude and noise of a grid finer than the
// program's: draws from the posterior, with the prior that residual_likelihood.h states.
std::vector<VectorXd> by_dense_algebra(const Data& data, const ResidualPlaces& where, bool noise_is_known) {
  const auto n = std::ssize(data.x);
  const double range = data.x.back() - data.x.front();
  const double scale = mean_deviation(data);
  MatrixXd X(n, 2);
  VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    X.row(i) << 1.0 / data.deviation[i], data.x[i] / data.deviation[i];
    y[i] = data.y[i] / data.deviation[i];
  }
  std::vector<Node> nodes;
  std::vector<double> logarithms;
  constexpr int fine = 30;
  for (int a = 0; a <= fine; ++a)
    for (int b = 0; b <= 2 * fine; ++b) {
      const double length = 0.05 * range * std::pow(20.0, static_cast<double>(a) / fine);
      const double ratio = 0.1 * std::pow(1e4, static_cast<double>(b) / (2 * fine));
      const Eigen::PartialPivLU<MatrixXd> lu(covariance_of(data, length, ratio));
      const MatrixXd normal = X.transpose() * lu.solve(X);
      const VectorXd mean = normal.inverse() * (X.transpose() * lu.solve(y));
      const double sum = (y - X * mean).dot(lu.solve(y - X * mean));
      double constant = -0.5 * std::log(normal.determinant());
      for (Eigen::Index i = 0; i < n; ++i) constant -= 0.5 * std::log(std::abs(lu.matrixLU()(i, i)));
      for (double noise = noise_is_known ? 1.0 : 0.1; noise < 10.0; noise *= 1.05) {
        const double amplitude = ratio * noise * scale;
        nodes.push_back({mean, noise * Eigen::LLT<MatrixXd>(normal.inverse()).matrixL().toDenseMatrix()});
        logarithms.push_back(constant - (static_cast<double>(n) - 2.0) * std::log(noise) - 0.5 * sum / (noise * noise) -
                             0.5 * std::pow(amplitude / where.largest, 2));
        if (noise_is_known) break;
      }
    }
  return draws_of(nodes, std::move(logarithms));
}

// A line through data that are bent, with two stated deviations; the noise known, and not.
TEST(ModelDiscrepancy, OfALineIsThatOfDenseAlgebra) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  Data data{.x = places(40, 8.0), .y = {}, .deviation = {}};
  for (std::size_t i = 0; i < data.x.size(); ++i) {
    data.deviation.push_back(i % 2 == 0 ? 0.1 : 0.3);
    data.y.push_back(1.0 + 2.0 * data.x[i] + 0.8 * std::sin(0.9 * data.x[i]) + data.deviation[i] * normal(engine));
  }
  for (const bool noise_is_known : {true, false}) {
    const FitProblem problem = problem_of(
        straight, data, {parameter("a", 1.0, -100.0, 100.0), parameter("b", 2.0, -100.0, 100.0)}, noise_is_known);
    const FitResult result = fit(problem);
    const ResidualPlaces where = places_of(data, result);
    const Posterior found = posterior(problem, result, {.samples = 8000, .places = where});
    const std::vector<VectorXd> due = by_dense_algebra(data, where, noise_is_known);
    EXPECT_LT(found.emulator_error, 1e-3);
    EXPECT_LE(found.evaluations, 26);
    EXPECT_FALSE(found.is_cut);
    for (std::size_t k = 0; k < 2; ++k) {
      std::vector<double> drawn;
      for (const VectorXd& draw : due) drawn.push_back(draw[static_cast<Eigen::Index>(k)]);
      const double width = quantile(drawn, 0.975) - quantile(drawn, 0.025);
      for (const double share : {0.025, 0.16, 0.5, 0.84, 0.975})
        EXPECT_NEAR(found.quantile(k, share), quantile(drawn, share), 0.05 * width) << k << share << noise_is_known;
    }
  }
}

// What a sine of amplitude 0.8 leaves of the best line lies within the band, and its size and length are met.
TEST(ModelDiscrepancy, IsFound) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  Data data{.x = places(60, 8.0), .y = {}, .deviation = std::vector<double>(60, 0.1)};
  for (const double x : data.x) data.y.push_back(2.0 * x + 0.8 * std::sin(1.5 * x) + 0.1 * normal(engine));
  FitProblem problem =
      problem_of(straight, data, {parameter("a", 0.1, -100.0, 100.0), parameter("b", 2.0, -100.0, 100.0)}, true);
  problem.parameters[0].prior = GaussianPrior{.mean = 0.0, .standard_deviation = 0.001};
  problem.parameters[1].prior = GaussianPrior{.mean = 2.0, .standard_deviation = 0.001};
  const FitResult result = fit(problem);
  const Posterior found = posterior(problem, result, {.places = places_of(data, result)});
  ASSERT_TRUE(found.discrepancy);
  const ModelDiscrepancy& error = *found.discrepancy;
  EXPECT_LT(error.amplitude.lower, 0.8);
  EXPECT_GT(error.amplitude.upper, 0.8 / std::sqrt(2.0));
  EXPECT_NEAR(error.length.median, 1.0, 0.6);  // a sine of wave number k is as stiff as a length of 1 / k and more
  int within = 0;
  for (std::size_t i = 0; i < error.at.size(); ++i) {
    const double due = 0.8 * std::sin(1.5 * error.at[i]);
    within += error.lower[i] < due && due < error.upper[i] ? 1 : 0;
    EXPECT_NEAR(error.median[i], due, 0.15) << error.at[i];
    EXPECT_LT(error.upper[i] - error.lower[i], 0.5);
  }
  EXPECT_GT(within, std::ssize(error.at) * 8 / 10);
}

// A model that is right: the discrepancy is found small against the noise, and intervals are about twice as wide.
TEST(ModelDiscrepancy, IsSmallWhereTheModelIsRight) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  double wider = 0.0;
  constexpr int sets = 10;
  for (int set = 0; set < sets; ++set) {
    Data data{.x = places(60, 3.0), .y = {}, .deviation = std::vector<double>(60, 0.05)};
    for (const double x : data.x) data.y.push_back(decaying(x, std::array{1.0, 1.0}) + 0.05 * normal(engine));
    const FitProblem problem =
        problem_of(decaying, data, {parameter("a", 1.0, 1e-3, 1e3, true), parameter("b", 1.0, 1e-3, 1e3, true)}, true);
    const FitResult result = fit(problem);
    const auto width = [](const Posterior& p) { return p.quantile(1, 0.975) - p.quantile(1, 0.025); };
    const Posterior with = posterior(problem, result, {.places = places_of(data, result)});
    wider += width(with) / width(posterior(problem, result)) / sets;
    EXPECT_LT(with.discrepancy->amplitude.lower, 0.02);
  }
  EXPECT_GT(wider, 1.0);
  EXPECT_LT(wider, 2.5);
}

// Parameters, amplitude and length drawn from the prior, the error and noise from these: the ranks of the parameters
// among the samples are uniform (Cook, Gelman, Rubin, J. Comput. Graph. Stat. 15 (2006) 675).
TEST(ModelDiscrepancy, RanksOfTrueValuesAreUniform) {
  constexpr int sets = 200, bins = 10;
  std::mt19937_64 engine(6);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const std::vector<double> x = places(30, 3.0);
  std::array<std::array<int, bins>, 2> counts{};
  for (int set = 0; set < sets; ++set) {
    const std::array<double, 2> truth{std::exp(0.2 * normal(engine)), std::exp(0.3 * normal(engine))};
    constexpr double deviation = 0.05;
    constexpr double largest = 3.0 * deviation;
    double amplitude = 0.0;
    do amplitude = 0.1 * deviation * std::pow(4.0 * largest / (0.1 * deviation), uniform(engine));
    while (uniform(engine) > std::exp(-0.5 * std::pow(amplitude / largest, 2)));
    const double length = 0.05 * 3.0 * std::pow(20.0, uniform(engine));
    MatrixXd C(30, 30);
    for (Eigen::Index i = 0; i < 30; ++i)
      for (Eigen::Index j = 0; j < 30; ++j)
        C(i, j) = std::exp(-0.5 * std::pow((x[i] - x[j]) / length, 2)) + (i == j ? 1e-9 : 0.0);
    VectorXd z(30);
    for (double& value : z) value = normal(engine);
    const VectorXd error = Eigen::LLT<MatrixXd>(C).matrixL() * (amplitude * z);
    Data data{.x = x, .y = {}, .deviation = std::vector<double>(30, deviation)};
    for (std::size_t i = 0; i < x.size(); ++i)
      data.y.push_back(decaying(x[i], truth) + error[std::ssize(data.y)] + deviation * normal(engine));
    std::vector<FitParameter> parameters{parameter("a", 1.0, 1e-3, 1e3, true), parameter("b", 1.0, 1e-3, 1e3, true)};
    parameters[0].prior = GaussianPrior{.mean = 1.0, .standard_deviation = 0.2};
    parameters[1].prior = GaussianPrior{.mean = 1.0, .standard_deviation = 0.3};
    const FitProblem problem = problem_of(decaying, data, parameters, true);
    const Posterior found = posterior(problem, fit(problem),
                                      {.samples = 400,
                                       .seed = static_cast<std::uint64_t>(set),
                                       .places = ResidualPlaces{x, data.deviation, largest}});
    for (std::size_t k = 0; k < 2; ++k) {
      const auto below = std::ranges::count_if(found.samples, [&](const auto& s) { return s[k] < truth[k]; });
      ++counts[k][static_cast<std::size_t>(bins * below / (std::ssize(found.samples) + 1))];
    }
  }
  for (const auto& of : counts) {
    double chi_square = 0.0;
    for (const int count : of) chi_square += std::pow(count - sets / double(bins), 2) / (sets / double(bins));
    EXPECT_LT(chi_square, 21.7) << "exceeded by one in a hundred, 9 degrees of freedom";
  }
}

// An exponential through data that a second one has a part in: without an error the intervals miss what decays first.
TEST(ModelDiscrepancy, HoldsTheTruthOfAModelThatLacksATerm) {
  std::mt19937_64 engine(9);
  std::normal_distribution<double> normal;
  constexpr int sets = 20;
  int without = 0, with = 0;
  for (int set = 0; set < sets; ++set) {
    Data data{.x = places(50, 3.0), .y = {}, .deviation = std::vector<double>(50, 0.01)};
    for (const double x : data.x)
      data.y.push_back(decaying(x, std::array{1.0, 1.0}) + 0.05 * std::sin(2.0 * x + set) + 0.01 * normal(engine));
    const FitProblem problem =
        problem_of(decaying, data, {parameter("a", 1.0, 1e-3, 1e3, true), parameter("b", 1.0, 1e-3, 1e3, true)}, true);
    const FitResult result = fit(problem);
    const auto holds = [](const Posterior& p) { return p.quantile(1, 0.025) < 1.0 && 1.0 < p.quantile(1, 0.975); };
    without += holds(posterior(problem, result)) ? 1 : 0;
    with += holds(posterior(problem, result, {.places = places_of(data, result)})) ? 1 : 0;
  }
  EXPECT_LT(without, sets / 2);
  EXPECT_GE(with, 18);
}

}  // namespace
}  // namespace pfdm::this_file
