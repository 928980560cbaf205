#include "solver/linear/sparse_lu.h"

#include "physics/error.h"

#include <umfpack.h>

#include <vector>

// Of OpenBLAS; another BLAS does not have it.
extern "C" void openblas_set_num_threads(int n) __attribute__((weak));

namespace pfdm {
namespace {

const double* numbers(const double* x) { return x; }
const double* numbers(const std::complex<double>* x) { return reinterpret_cast<const double*>(x); }
double* numbers(double* x) { return x; }
double* numbers(std::complex<double>* x) { return reinterpret_cast<double*>(x); }

// With 32 bits the factors of 40,000 cells are too large to be counted.
using Long = SuiteSparse_long;

// UMFPACK's names for the two kinds of number; without an array of imaginary parts complex numbers are packed.
struct Real {
  static Long order(Long n, const Long* p, const Long* i, const double* x, void** symbolic, double* control,
                    double* info) {
    return umfpack_dl_symbolic(n, n, p, i, x, symbolic, control, info);
  }
  static Long factor(const Long* p, const Long* i, const double* x, void* symbolic, void** numeric, double* control,
                     double* info) {
    return umfpack_dl_numeric(p, i, x, symbolic, numeric, control, info);
  }
  static Long solve(const Long* p, const Long* i, const double* a, double* x, const double* b, void* numeric,
                    const double* control, double* info) {
    return umfpack_dl_solve(UMFPACK_A, p, i, a, x, b, numeric, control, info);
  }
  static void defaults(double* control) { umfpack_dl_defaults(control); }
  static void free(void** symbolic, void** numeric) {
    umfpack_dl_free_symbolic(symbolic);
    umfpack_dl_free_numeric(numeric);
  }
};

struct Complex {
  static Long order(Long n, const Long* p, const Long* i, const double* x, void** symbolic, double* control,
                    double* info) {
    return umfpack_zl_symbolic(n, n, p, i, x, nullptr, symbolic, control, info);
  }
  static Long factor(const Long* p, const Long* i, const double* x, void* symbolic, void** numeric, double* control,
                     double* info) {
    return umfpack_zl_numeric(p, i, x, nullptr, symbolic, numeric, control, info);
  }
  static Long solve(const Long* p, const Long* i, const double* a, double* x, const double* b, void* numeric,
                    const double* control, double* info) {
    return umfpack_zl_solve(UMFPACK_A, p, i, a, nullptr, x, nullptr, b, nullptr, numeric, control, info);
  }
  static void defaults(double* control) { umfpack_zl_defaults(control); }
  static void free(void** symbolic, void** numeric) {
    umfpack_zl_free_symbolic(symbolic);
    umfpack_zl_free_numeric(numeric);
  }
};

template <class Scalar>
using Calls = std::conditional_t<std::is_same_v<Scalar, double>, Real, Complex>;

void require_done(Long status) {
  if (status == UMFPACK_OK) return;
  if (status == UMFPACK_WARNING_singular_matrix) throw ComputationError("a sparse matrix to be factored is singular");
  if (status == UMFPACK_ERROR_out_of_memory)
    throw ComputationError("there is not enough memory for the factors of a sparse matrix; take a coarser mesh");
  throw ComputationError("a sparse matrix could not be factored (UMFPACK status " + std::to_string(status) + ")");
}

constexpr double small_error = 1e-15;  // backward, of an answer
constexpr int most_refinements = 3;

}  // namespace

template <class Scalar>
struct SparseLu<Scalar>::Data {
  Matrix matrix;
  double size = 0.0;  // the largest sum of absolute entries of a row
  std::vector<Long> offsets, rows;
  double control[UMFPACK_CONTROL] = {};
  double info[UMFPACK_INFO] = {};
  void* symbolic = nullptr;
  void* numeric = nullptr;

  ~Data() { Calls<Scalar>::free(&symbolic, &numeric); }

  /// By the factors alone.
  Column answer(const Column& b) const {
    Column x(b.size());
    double unused[UMFPACK_INFO];
    require_done(Calls<Scalar>::solve(offsets.data(), rows.data(), numbers(matrix.valuePtr()), numbers(x.data()),
                                      numbers(b.data()), numeric, control, unused));
    return x;
  }
};

template <class Scalar>
SparseLu<Scalar>::SparseLu(Matrix matrix) : data_(std::make_unique<Data>()) {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  Data& d = *data_;
  d.matrix = std::move(matrix);
  d.matrix.makeCompressed();
  Calls<Scalar>::defaults(d.control);
  d.control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;  // the pattern is
  d.control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  d.control[UMFPACK_IRSTEP] = 0;  // UMFPACK would solve once or twice more for each answer, see solve()
  d.size = (d.matrix.cwiseAbs() * Eigen::VectorXd::Ones(d.matrix.cols())).maxCoeff();
  d.offsets.assign(d.matrix.outerIndexPtr(), d.matrix.outerIndexPtr() + d.matrix.cols() + 1);
  d.rows.assign(d.matrix.innerIndexPtr(), d.matrix.innerIndexPtr() + d.matrix.nonZeros());
  const Long n = d.matrix.rows();
  const Long *p = d.offsets.data(), *i = d.rows.data();
  const double* x = numbers(d.matrix.valuePtr());
  require_done(Calls<Scalar>::order(n, p, i, x, &d.symbolic, d.control, d.info));
  require_done(Calls<Scalar>::factor(p, i, x, d.symbolic, &d.numeric, d.control, d.info));
}

template <class Scalar>
SparseLu<Scalar>::~SparseLu() = default;
template <class Scalar>
SparseLu<Scalar>::SparseLu(SparseLu&&) noexcept = default;
template <class Scalar>
SparseLu<Scalar>& SparseLu<Scalar>::operator=(SparseLu&&) noexcept = default;

template <class Scalar>
auto SparseLu<Scalar>::solve(const Column& b) const -> Column {
  const Data& d = *data_;
  const double of_b = b.template lpNorm<Eigen::Infinity>();
  Column x = d.answer(b);
  for (int refinement = 0; refinement < most_refinements; ++refinement) {
    const Column left = b - d.matrix * x;
    const double most = small_error * (d.size * x.template lpNorm<Eigen::Infinity>() + of_b);
    if (left.template lpNorm<Eigen::Infinity>() <= most) break;
    x += d.answer(left);
  }
  return x;
}

template <class Scalar>
double SparseLu<Scalar>::n_entries() const {
  return data_->info[UMFPACK_LNZ] + data_->info[UMFPACK_UNZ];
}

template class SparseLu<double>;
template class SparseLu<std::complex<double>>;

}  // namespace pfdm
