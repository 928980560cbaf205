#include "solver/calibration/quasi_random.h"

namespace pfdm {
namespace {

bool is_prime(int n) {
  for (int d = 2; d * d <= n; ++d)
    if (n % d == 0) return false;
  return true;
}

}  // namespace

double radical_inverse(int n, int base) {
  double result = 0.0;
  for (double digit = 1.0 / base; n > 0; n /= base, digit /= base) result += digit * (n % base);
  return result;
}

std::vector<int> primes(std::size_t n) {
  std::vector<int> result;
  for (int candidate = 2; result.size() < n; ++candidate)
    if (is_prime(candidate)) result.push_back(candidate);
  return result;
}

}  // namespace pfdm
