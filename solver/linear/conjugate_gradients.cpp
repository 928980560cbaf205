#include "solver/linear/conjugate_gradients.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pfdm {
namespace {

constexpr Index factor_block = 8192;  // rows that one incomplete factorisation couples

}  // namespace

SymmetricCoupling::SymmetricCoupling(Index n, std::span<const Pair> pairs) : rows_(n), total_(n, 0.0) {
  std::vector<std::vector<std::pair<Index, double>>> across(n);
  for (const Pair& pair : pairs) {
    across[pair.i].emplace_back(pair.j, pair.coefficient);
    across[pair.j].emplace_back(pair.i, pair.coefficient);
  }
  columns_.reserve(2 * pairs.size());
  coefficients_.reserve(2 * pairs.size());
  for (Index i = 0; i < n; ++i) {
    auto& entries = across[i];
    std::sort(entries.begin(), entries.end());
    const Index block_begin = i / factor_block * factor_block, block_end = block_begin + factor_block;
    Row& row = rows_[i];
    const auto reached = [this] { return static_cast<std::int32_t>(columns_.size()); };
    row.begin = row.below = row.diagonal = row.above = reached();
    for (const auto& [column, coefficient] : entries) {
      columns_.push_back(static_cast<std::int32_t>(column));
      coefficients_.push_back(coefficient);
      total_[i] += coefficient;
      if (column < block_begin) row.below = reached();
      if (column < i) row.diagonal = reached();
      if (column < block_end) row.above = reached();
    }
    row.end = reached();
  }
}

void ConjugateGradients::factor(const std::vector<double>& diagonal, const Held& held) {
  const auto& coefficients = coupling_.coefficients_;
  const auto& columns = coupling_.columns_;
  pivots_ = diagonal;
  parallel_chunks(
      coupling_.n(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          if (held[i] != 0) continue;
          const auto& row = coupling_.rows_[i];
          for (auto k = row.below; k < row.diagonal; ++k)
            if (const std::size_t j = columns[k]; held[j] == 0)
              pivots_[i] -= coefficients[k] * coefficients[k] / pivots_[j];
        }
        for (Index i = begin; i < end; ++i) pivots_[i] = held[i] != 0 ? 0.0 : 1.0 / pivots_[i];
      },
      factor_block);
}

// Returns r.z.
double ConjugateGradients::precondition(const std::vector<double>& r, std::vector<double>& z) const {
  const auto& coefficients = coupling_.coefficients_;
  const auto& columns = coupling_.columns_;
  std::vector<double> products(coupling_.n() / factor_block + 1, 0.0);
  parallel_chunks(
      coupling_.n(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          const auto& row = coupling_.rows_[i];
          double sum = r[i];
          for (auto k = row.below; k < row.diagonal; ++k) sum += coefficients[k] * z[columns[k]];
          z[i] = sum * pivots_[i];
        }
        double product = 0.0;
        for (Index i = end - 1; i >= begin; --i) {
          const auto& row = coupling_.rows_[i];
          double sum = 0.0;
          for (auto k = row.diagonal; k < row.above; ++k) sum += coefficients[k] * z[columns[k]];
          z[i] += sum * pivots_[i];
          product += r[i] * z[i];
        }
        products[begin / factor_block] = product;
      },
      factor_block);
  return std::accumulate(products.begin(), products.end(), 0.0);
}

Index ConjugateGradients::solve(const std::vector<double>& diagonal, const Held& held, const Tolerance& tolerance,
                                std::vector<double>& r, std::vector<double>& x) {
  const Index n = coupling_.n();
  double largest = parallel_max(n, [&](Index i) { return std::abs(r[i]) / diagonal[i]; });
  const double target = std::max(tolerance.least, tolerance.reduction * largest);
  if (largest <= tolerance.least) return 0;
  factor(diagonal, held);
  std::vector<double> z(n), p(n, 0.0), q(n, 0.0);
  double rho_before = 0.0;
  Index iterations = 0;
  for (; iterations < tolerance.most_iterations && largest > target; ++iterations) {
    const double rho = precondition(r, z);
    const double beta = iterations == 0 ? 0.0 : rho / rho_before;
    rho_before = rho;
    parallel_for(n, [&](Index i) { p[i] = z[i] + beta * p[i]; });
    const double curvature = parallel_sum(n, [&](Index i) {
      if (held[i] != 0) return 0.0;
      q[i] = diagonal[i] * p[i] - coupling_.times(i, p.data());
      return p[i] * q[i];
    });
    const double alpha = rho / curvature;
    largest = parallel_max(n, [&](Index i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
      return std::abs(r[i]) / diagonal[i];
    });
  }
  return iterations;
}

}  // namespace pfdm
