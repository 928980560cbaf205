#include "solver/linear/sparse_cholesky.h"

#include "mesh/fields.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace pfdm {
namespace {

// Pivots of the matrix with ones on its diagonal below which it is singular to working precision.
constexpr double least_pivot = 1e-14;

// The upper triangle by columns, rows ascending, scaled to ones on the diagonal; without entries that are zero.
struct UpperTriangle {
  std::vector<int> offsets{0}, rows;
  std::vector<double> values;
  std::vector<double> scale;    // of rows and columns
  std::optional<Index> faulty;  // row of blocks without a positive diagonal
};

std::vector<double> scale_of(const BlockTriplets& matrix) {
  std::vector<double> scale;
  scale.reserve(3 * matrix.diagonal.size());
  for (const Tensor& block : matrix.diagonal)
    for (Index k = 0; k < 3; ++k) scale.push_back(1.0 / std::sqrt(block(k, k)));
  return scale;
}

struct BlockEntry {
  Index row;
  Tensor value;
};

// Blocks above the diagonal, by their column, rows ascending.
std::vector<std::vector<BlockEntry>> columns_of(const BlockTriplets& matrix) {
  std::vector<std::vector<BlockEntry>> columns(matrix.diagonal.size());
  for (const auto& [row, column, value] : matrix.off_diagonal) {
    if (row < column)
      columns[column].push_back({row, value});
    else
      columns[row].push_back({column, value.transpose()});
  }
  for (auto& column : columns)
    std::sort(column.begin(), column.end(), [](const BlockEntry& a, const BlockEntry& b) { return a.row < b.row; });
  return columns;
}

UpperTriangle upper_triangle(const BlockTriplets& matrix) {
  UpperTriangle upper;
  upper.scale = scale_of(matrix);
  const auto n = count_of(matrix.diagonal);
  for (Index i = 0; i < 3 * n && !upper.faulty; ++i)
    if (!(upper.scale[i] > 0.0) || !std::isfinite(upper.scale[i])) upper.faulty = i / 3;
  if (upper.faulty) return upper;
  const auto columns = columns_of(matrix);
  const auto put = [&](Index row, Index column, double value) {
    if (value == 0.0) return;
    upper.rows.push_back(static_cast<int>(row));
    upper.values.push_back(value * upper.scale[row] * upper.scale[column]);
  };
  for (Index j = 0; j < n; ++j)
    for (Index b = 0; b < 3; ++b) {
      for (const auto& [row, value] : columns[j])
        for (Index a = 0; a < 3; ++a) put(3 * row + a, 3 * j + b, value(a, b));
      for (Index a = 0; a <= b; ++a) put(3 * j + a, 3 * j + b, matrix.diagonal[j](a, b));
      upper.offsets.push_back(static_cast<int>(upper.rows.size()));
    }
  return upper;
}

// The matrix as CHOLMOD wants to see it; it does not write to it.
cholmod_sparse view_of(UpperTriangle& upper) {
  cholmod_sparse a{};
  a.nrow = a.ncol = upper.offsets.size() - 1;
  a.nzmax = upper.rows.size();
  a.p = upper.offsets.data();
  a.i = upper.rows.data();
  a.x = upper.values.data();
  a.stype = 1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

// The first column of a factor L L^T whose pivot is too small.
std::optional<std::size_t> small_pivot(const cholmod_factor& factor) {
  if (factor.minor < factor.n) return factor.minor;
  const auto* const start = static_cast<const int*>(factor.p);
  const auto* const value = static_cast<const double*>(factor.x);
  for (std::size_t j = 0; j < factor.n; ++j)
    if (const double l = value[start[j]]; !(l * l >= least_pivot)) return j;
  return std::nullopt;
}

}  // namespace

struct SparseCholesky::Data {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // answer and work space
  UpperTriangle matrix;
  std::vector<double> b;
  Index n_orderings = 0;

  Data() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.print = 0;
#if CHOLMOD_MAIN_VERSION >= 4
    common.nthreads_max = 1;
#endif
  }
  ~Data() {
    cholmod_free_factor(&factor, &common);
    for (cholmod_dense** work : {&x, &y, &e}) cholmod_free_dense(work, &common);
    cholmod_finish(&common);
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;

  void order(cholmod_sparse& a) {
    cholmod_free_factor(&factor, &common);
    factor = cholmod_analyze(&a, &common);
    ++n_orderings;
  }

  // Returns the first row of blocks whose pivot is too small.
  std::optional<Index> factor_shifted(cholmod_sparse& a, double shift) {
    double beta[2] = {shift, 0.0};
    cholmod_factorize_p(&a, beta, nullptr, 0, factor, &common);
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
    const std::optional<std::size_t> column = small_pivot(*factor);
    if (!column) return std::nullopt;
    return static_cast<const int*>(factor->Perm)[*column] / 3;
  }
};

SparseCholesky::SparseCholesky() : data_(std::make_unique<Data>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

std::optional<Index> SparseCholesky::factor(const BlockTriplets& matrix) {
  UpperTriangle upper = upper_triangle(matrix);
  if (upper.faulty) return upper.faulty;
  Data& d = *data_;
  const bool same_pattern = d.factor != nullptr && upper.offsets == d.matrix.offsets && upper.rows == d.matrix.rows;
  d.matrix = std::move(upper);
  cholmod_sparse a = view_of(d.matrix);
  if (!same_pattern) d.order(a);
  std::optional<Index> faulty = d.factor_shifted(a, 0.0);
  for (double shift = 1e-12; faulty && shift <= 1.5 * largest_shift; shift *= 100.0)
    faulty = d.factor_shifted(a, shift);
  return faulty;
}

void SparseCholesky::solve(const std::vector<Vector>& b, std::vector<Vector>& x) {
  Data& d = *data_;
  const std::vector<double>& scale = d.matrix.scale;
  d.b.resize(scale.size());
  for (std::size_t i = 0; i < scale.size(); ++i) d.b[i] = scale[i] * b[i / 3][i % 3];
  cholmod_dense right{};
  right.nrow = right.d = right.nzmax = scale.size();
  right.ncol = 1;
  right.x = d.b.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, d.factor, &right, nullptr, &d.x, nullptr, &d.y, &d.e, &d.common);
  const auto* const answer = static_cast<const double*>(d.x->x);
  for (std::size_t i = 0; i < scale.size(); ++i) x[i / 3][i % 3] = scale[i] * answer[i];
}

Index SparseCholesky::n_orderings() const { return data_->n_orderings; }

}  // namespace pfdm
