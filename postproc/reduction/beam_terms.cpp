#include "postproc/reduction/beam_terms.h"

#include <cmath>
#include <numeric>

namespace pfdm {

double root_rotation(double young_modulus, double transverse_modulus, double shear_modulus) {
  const double gamma = 1.18 * std::sqrt(young_modulus * transverse_modulus) / shear_modulus;
  const double part = gamma / (1.0 + gamma);
  return std::sqrt(young_modulus / (11.0 * shear_modulus) * (3.0 - 2.0 * part * part));
}

FittedLine fitted_line(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return {};
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0.0)) return {};
  return {.slope = xy / xx, .intercept = mean_y - xy / xx * mean_x};
}

double large_displacement_factor(double displacement, double crack_length, double block_offset) {
  const double d = displacement / crack_length;
  const double offset = std::isnan(block_offset) ? 0.0 : block_offset;
  return 1.0 - 0.3 * d * d - 1.5 * d * offset / crack_length;
}

double block_factor(double displacement, double crack_length, double block_offset, double block_length) {
  if (std::isnan(block_offset) || std::isnan(block_length)) return 1.0;
  const double d = displacement / crack_length, l = block_length / crack_length;
  return 1.0 - l * l * l - 1.125 * (1.0 - l * l) * d * block_offset / crack_length - 9.0 / 35.0 * d * d;
}

}  // namespace pfdm
