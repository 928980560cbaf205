// The report's iteration, its Prony series and energies; kernel terms in the order of their rates. All records are
// synthetic.

#include "solver/vibration/identification/identification_ten_steps.h"
#include "solver/vibration/signals/impulse_response.h"
#include "tests/solver/mass_material_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

namespace pfdm::this_file {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;

MassMaterial linear_truth() {
  MassMaterial t = truth("4b");
  t.stiffness.resize(1);
  return t;
}

TenSteps iterated(int prony_order, int order) {
  const MassMaterial t = linear_truth();
  const VibrationRecord record = random_record(t, 20.0, 1);
  IdentificationSettings settings;
  settings.mass = t.mass;
  return ten_steps(std::span(&record, 1), model_structure("linear_4b"), order, settings, prony_order, 5);
}

// Energies (A15, A16) by numerical integration; the most energy comes first, and no more than M states are kept.
TEST(TenSteps, TermsAreOrderedByTheEnergyOfTheirImpulseResponse) {
  constexpr double rate = 2e6;
  constexpr int order = 4;
  const TenSteps steps = iterated(10, order);
  ASSERT_GE(steps.series.size(), 2U);
  int states = 0;
  for (const PronyTerm& term : steps.series) {
    const auto n = static_cast<Index>(ten_step_duration * rate) + 1;
    const VectorXd g = impulse_response(std::span(&term.term, 1), n, rate);
    const double integral = (g.squaredNorm() - 0.5 * (g[0] * g[0] + g[n - 1] * g[n - 1])) / rate;
    EXPECT_NEAR(term.energy, integral, 1e-4 * integral);
    if (term.kept) states += term.term.is_pair() ? 2 : 1;
  }
  EXPECT_TRUE(std::ranges::is_sorted(steps.series, std::ranges::greater(), &PronyTerm::energy));
  EXPECT_LE(states, order);
  EXPECT_GT(states, 0);
}

TEST(TenSteps, TheLastIterationIsTheResult) {
  const TenSteps steps = iterated(10, 4);
  ASSERT_FALSE(steps.iterations.empty());
  EXPECT_LE(steps.iterations.size(), 5U);
  EXPECT_EQ(steps.iterations.back().damping, steps.regression.model.damping);
  EXPECT_EQ(steps.iterations.back().stiffness, steps.regression.model.stiffness);
  EXPECT_EQ(steps.iterations.back().misfit, steps.regression.misfit);
  std::vector<Complex> kept, kernel;
  for (const PronyTerm& term : steps.series)
    if (term.kept) kept.push_back(term.term.alpha);
  for (const HereditaryTerm& term : steps.regression.model.kernel) kernel.push_back(term.alpha);
  EXPECT_EQ(kept, kernel);
  EXPECT_EQ(steps.frequency.size(), steps.response.size());
}

// G(f) = integral of g(t) exp(-j 2 pi f t): by sums over a decaying pair and a real term.
TEST(TenSteps, FrequencyAndImpulseResponseBelongTogether) {
  const std::vector<HereditaryTerm> terms{{{300.0, 1200.0}, {2.0, -0.7}}, {900.0, 1.5}};
  constexpr double rate = 1e6;
  const VectorXd g = impulse_response(terms, 60000, rate);
  VectorXd frequency(3);
  frequency << 20.0, 190.0, 700.0;
  const Eigen::VectorXcd G = frequency_response(terms, frequency);
  for (Index k = 0; k < frequency.size(); ++k) {
    Complex sum = -0.5 * g[0];
    for (Index i = 0; i < g.size(); ++i)
      sum += g[i] * std::polar(1.0, -2.0 * std::numbers::pi * frequency[k] * static_cast<double>(i) / rate);
    EXPECT_LT(std::abs(sum / rate - G[k]), 1e-5 * std::abs(G[k]));
  }
}

// The matrix pencil reduces a sum of exponentials to fewer that are nearly the same; truncation by energy keeps one of
// two that cancel.
TEST(TenSteps, ThePencilKeepsWhatCancels) {
  const std::vector<HereditaryTerm> terms{{400.0, 0.1}, {3000.0, 0.25}, {800.0, 10.0}, {800.001, -10.0}};
  const VectorXd g = impulse_response(terms, 120, 6000.0);
  const ImpulseFit pencil = matrix_pencil(g, 6000.0, 2);
  EXPECT_LT((impulse_response(pencil.terms, 120, 6000.0) - g).norm(), 1e-4 * g.norm());
  const std::vector<HereditaryTerm> of_most_energy{terms[2], terms[3]};
  EXPECT_GT((impulse_response(of_most_energy, 120, 6000.0) - g).norm(), 0.9 * g.norm());
}

// The rates of two terms pass each other during the search: the estimates are named by their order at its end.
TEST(OutputError, TermsAreInTheOrderOfTheirRatesAtTheEnd) {
  const MassMaterial t = linear_truth();
  const VibrationRecord record = random_record(t, 6.0, 1);
  MassMaterial start = t;
  start.kernel = {{2900.0, t.kernel[1].beta}, {3000.0, t.kernel[0].beta}};
  IdentificationSettings settings;
  settings.mass = t.mass;
  settings.replicates = 100;
  const OutputErrorFit found = refine_output(std::span(&record, 1), start, settings);
  ASSERT_TRUE(found.converged);
  EXPECT_LT(largest_error(found.model, t), 1e-6);
  EXPECT_GT(found.path.front().parameters[2], found.path.front().parameters[4]);  // they did pass
  for (const Estimate& e : found.estimates) {
    EXPECT_LE(e.lower, e.value * (1.0 + 1e-6)) << e.name;
    EXPECT_GE(e.upper, e.value * (1.0 - 1e-6)) << e.name;
  }
}

}  // namespace
}  // namespace pfdm::this_file
