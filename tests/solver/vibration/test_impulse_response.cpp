#include "physics/error.h"
#include "solver/vibration/signals/impulse_response.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

using Eigen::VectorXd;

constexpr double rate = 6000.0;
const std::vector<HereditaryTerm> truth{
    {{30.0, 0.0}, {1.0, 0.0}}, {{60.0, 900.0}, {0.4, -0.3}}, {{250.0, 0.0}, {0.6, 0.0}}};

VectorXd response(const std::vector<HereditaryTerm>& terms, Eigen::Index n = 1200) {
  VectorXd g = VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (const HereditaryTerm& term : terms) {
      const std::complex<double> value = term.beta * std::exp(-term.alpha * (static_cast<double>(k) / rate));
      g[k] += term.is_pair() ? 2.0 * value.real() : value.real();
    }
  return g;
}

VectorXd with_noise(const VectorXd& g, double decibel, std::uint64_t seed) {
  const double deviation = g.norm() / std::sqrt(static_cast<double>(g.size())) * std::pow(10.0, -decibel / 20.0);
  return g + deviation * normal_numbers(g.size(), seed);
}

TEST(ImpulseResponse, WithoutNoiseIsFoundExactly) {
  const ImpulseFit fit = matrix_pencil(response(truth), rate);
  EXPECT_EQ(fit.order, 4);
  ASSERT_EQ(fit.terms.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(std::abs(fit.terms[i].alpha - truth[i].alpha), 1e-7 * std::abs(truth[i].alpha));
    EXPECT_LT(std::abs(fit.terms[i].beta - truth[i].beta), 1e-7);
  }
}

TEST(ImpulseResponse, LeastSquaresIsNoWorseThanThePencil) {
  const VectorXd clean = response(truth);
  const auto error = [&](const ImpulseFit& fit) { return (response(fit.terms) - clean).norm() / clean.norm(); };
  for (const double decibel : {60.0, 40.0}) {
    double pencil = 0.0, ours = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const VectorXd g = with_noise(clean, decibel, seed);
      const ImpulseFit fit = fit_impulse_response(g, rate);
      EXPECT_EQ(fit.order, 4);
      pencil += error(matrix_pencil(g, rate));
      ours += error(fit);
    }
    EXPECT_LE(ours, pencil);
    EXPECT_LT(ours / 3.0, 0.1 * std::pow(10.0, -decibel / 20.0));
  }
}

TEST(ImpulseResponse, OfNothingOrTooLittleIsRefused) {
  EXPECT_THROW(matrix_pencil(VectorXd::Zero(100), rate), InputError);
  EXPECT_THROW(matrix_pencil(VectorXd::Ones(11), rate), InputError);
  EXPECT_THROW(matrix_pencil(VectorXd::Ones(20), rate, 7), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
