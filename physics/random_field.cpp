#include "physics/random_field.h"

#include <cmath>
#include <numbers>
#include <random>

namespace pfdm {
namespace {

constexpr std::size_t n_waves = 512;

// The distributions of the standard library differ from one implementation to the next; its generators do not.
double uniform(std::mt19937_64& generator) {  // above 0, at most 1
  return (static_cast<double>(generator() >> 11) + 1.0) * 0x1p-53;
}

double normal(std::mt19937_64& generator) {
  const double radius = std::sqrt(-2.0 * std::log(uniform(generator)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(generator));
}

}  // namespace

RandomField::RandomField(std::uint64_t seed, double correlation_length) {
  std::mt19937_64 generator(seed);
  waves_.reserve(n_waves);
  for (std::size_t i = 0; i < n_waves; ++i) {
    Vector k;
    for (Eigen::Index j = 0; j < 3; ++j) k[j] = normal(generator) / correlation_length;
    waves_.push_back({k, 2.0 * std::numbers::pi * uniform(generator)});
  }
}

double RandomField::at(const Vector& x) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.k.dot(x) + wave.phase);
  return std::sqrt(2.0 / static_cast<double>(n_waves)) * sum;
}

}  // namespace pfdm
