#include "solver/linear/dense_cholesky.h"

#include "solver/linear/ordered_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr Index panel = 8;  // columns whose products are taken off the others in one pass

// to -= factor * from, over rows [first, end).
void subtract(double factor, const double* from, double* to, Index first, Index end) {
  for (Index i = first; i < end; ++i) to[i] -= factor * from[i];
}

}  // namespace

bool DenseCholesky::compute(Index n, std::vector<double> columns) {
  n_ = n;
  factor_ = std::move(columns);
  for (Index first = 0; first < n; first += panel) {
    const Index end = std::min(n, first + panel);
    if (!factor_panel(first, end)) return false;
    reduce_behind(first, end);
  }
  return true;
}

bool DenseCholesky::factor_panel(Index first, Index end) {
  for (Index k = first; k < end; ++k) {
    double* pivot = column(k);
    if (!(pivot[k] > 0.0)) return false;
    const double root = std::sqrt(pivot[k]);
    for (Index i = k; i < n_; ++i) pivot[i] /= root;
    for (Index j = k + 1; j < end; ++j) subtract(pivot[j], pivot, column(j), j, n_);
  }
  return true;
}

void DenseCholesky::reduce_behind(Index first, Index end) {
  if (end - first < panel) return;  // the last panel, with nothing behind it
  const double *a = column(first), *b = column(first + 1), *c = column(first + 2), *d = column(first + 3),
               *e = column(first + 4), *f = column(first + 5), *g = column(first + 6), *h = column(first + 7);
  for (Index j = end; j < n_; ++j) {
    double* to = column(j);
    const double aj = a[j], bj = b[j], cj = c[j], dj = d[j], ej = e[j], fj = f[j], gj = g[j], hj = h[j];
    for (Index i = j; i < n_; ++i)
      to[i] = to[i] - aj * a[i] - bj * b[i] - cj * c[i] - dj * d[i] - ej * e[i] - fj * f[i] - gj * g[i] - hj * h[i];
  }
}

void DenseCholesky::solve(std::vector<double>& b) const {
  for (Index k = 0; k < n_; ++k) {
    b[k] /= column(k)[k];
    subtract(b[k], column(k), b.data(), k + 1, n_);
  }
  for (Index k = n_ - 1; k >= 0; --k)
    b[k] = (b[k] - ordered_dot(column(k) + k + 1, b.data() + k + 1, n_ - k - 1)) / column(k)[k];
}

}  // namespace pfdm
