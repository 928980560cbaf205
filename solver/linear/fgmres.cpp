#include "solver/linear/fgmres.h"

#include "mesh/fields.h"
#include "solver/linear/ordered_sums.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace pfdm {
namespace {

// The Arnoldi process of one cycle, its vectors stored as numbers of type Real.
template <class Real>
struct Basis {
  using Stored = Eigen::Matrix<Real, 3, 1>;
  using Stretch = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  explicit Basis(std::size_t n) : work(n), image(n), size(static_cast<Index>(n)) {}

  std::vector<std::vector<Stored>> v, z;
  std::vector<Vector> work, image;
  Index size;

  static void push(std::vector<std::vector<Stored>>& to, Index k, std::size_t n) {
    if (to.size() <= as_size(k)) to.emplace_back(n);
  }

  // Projections of `image` on v_0 ... v_{k-1}, in one pass.
  Eigen::VectorXd project(Index k) const {
    return parallel_sum<Eigen::VectorXd>((size + block - 1) / block,
                                         [&](Index b) {
                                           Eigen::VectorXd sum = Eigen::VectorXd::Zero(k);
                                           const Index from = b * block, length = std::min(block, size - from);
                                           const Eigen::Map<const Eigen::VectorXd> w(image[from].data(), 3 * length);
                                           const Stretch rounded = w.cast<Real>();
                                           for (Index j = 0; j < k; ++j)
                                             sum[j] = ordered_dot(v[j][from].data(), rounded.data(), 3 * length);
                                           return sum;
                                         },
                                         Eigen::VectorXd::Zero(k), blocks_per_task);
  }

  // image -= sum_j h_j v_j; returns its squared norm.
  double subtract(const Eigen::VectorXd& h) {
    const auto subtract_block = [&](Index b) {
      const Index from = b * block, length = std::min(block, size - from);
      Eigen::Map<Eigen::VectorXd> w(image[from].data(), 3 * length);
      for (Index j = 0; j < h.size(); ++j)
        w -= h[j] * Eigen::Map<const Stretch>(v[j][from].data(), 3 * length).template cast<double>();
      return ordered_dot(w.data(), w.data(), 3 * length);
    };
    return parallel_sum((size + block - 1) / block, subtract_block, 0.0, blocks_per_task);
  }

  static constexpr Index block = 512;  // a few kilobytes of each vector at a time
  static constexpr Index blocks_per_task = 8;
};

// Least squares of the Hessenberg matrix by Givens rotations.
struct Hessenberg {
  explicit Hessenberg(Index restart_length)
      : R(Eigen::MatrixXd::Zero(restart_length + 1, restart_length)), rhs(Eigen::VectorXd::Zero(restart_length + 1)) {}

  Eigen::MatrixXd R;
  Eigen::VectorXd rhs;
  std::vector<Eigen::JacobiRotation<double>> rotations;

  void append(Index k, const Eigen::VectorXd& column, double below) {
    R.col(k).head(k + 1) = column;
    R(k + 1, k) = below;
    for (Index j = 0; j < k; ++j) R.col(k).applyOnTheLeft(j, j + 1, rotations[j].adjoint());
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(R(k, k), R(k + 1, k));
    R.col(k).applyOnTheLeft(k, k + 1, rotation.adjoint());
    rhs.applyOnTheLeft(k, k + 1, rotation.adjoint());
    rotations.push_back(rotation);
  }
};

template <class Real>
double start(const KrylovProblem& problem, const std::vector<Vector>& b, const std::vector<Vector>& x,
             Basis<Real>& basis) {
  problem.apply(x, basis.image);
  parallel_for(basis.size, [&](Index i) { basis.image[i] = problem.scale[i] * (b[i] - basis.image[i]); });
  return std::sqrt(parallel_sum(basis.size, [&](Index i) { return basis.image[i].squaredNorm(); }));
}

// One Arnoldi step; returns h_{k+1,k}.
template <class Real>
double extend(const KrylovProblem& problem, Basis<Real>& basis, Index k, Eigen::VectorXd& h) {
  const std::size_t n = basis.size;
  parallel_for(basis.size, [&](Index i) { basis.image[i] = basis.v[k][i].template cast<double>() / problem.scale[i]; });
  problem.precondition(basis.image, basis.work);
  Basis<Real>::push(basis.z, k, n);
  parallel_for(basis.size, [&](Index i) {
    auto& z = basis.z[k][i];
    z = basis.work[i].template cast<Real>();
    basis.work[i] = z.template cast<double>();
  });
  problem.apply(basis.work, basis.image);
  const double before = parallel_sum(basis.size, [&](Index i) {
    basis.image[i] *= problem.scale[i];
    return basis.image[i].squaredNorm();
  });
  h = basis.project(k + 1);
  double after = basis.subtract(h);
  constexpr double cancellation = 0.01;  // then classical Gram-Schmidt is done again
  if (after < cancellation * before) {
    const Eigen::VectorXd again = basis.project(k + 1);
    after = basis.subtract(again);
    h += again;
  }
  return std::sqrt(after);
}

template <class Real>
void normalise(Basis<Real>& basis, Index k, double norm) {
  Basis<Real>::push(basis.v, k, as_size(basis.size));
  parallel_for(basis.size, [&](Index i) { basis.v[k][i] = (basis.image[i] / norm).template cast<Real>(); });
}

template <class Real>
void add_combination(const Basis<Real>& basis, const Hessenberg& hessenberg, Index k, std::vector<Vector>& x) {
  const Eigen::VectorXd y =
      hessenberg.R.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(hessenberg.rhs.head(k));
  parallel_for(basis.size, [&](Index i) {
    for (Index j = 0; j < k; ++j) x[i] += y[j] * basis.z[j][i].template cast<double>();
  });
}

template <class Real>
KrylovResult solve_with(const KrylovProblem& problem, const std::vector<Vector>& b, std::vector<Vector>& x,
                        const std::function<double(double initial)>& target_of, Index most_iterations) {
  constexpr double modest_drop = 1e-4;
  // Of one cycle: a basis in single precision follows no further.
  constexpr double greatest_drop = std::is_same_v<Real, float> ? 1e-5 : 1e-10;
  constexpr double stagnation = 0.5;
  Basis<Real> basis(x.size());
  KrylovResult result;
  double beta = start(problem, b, x, basis);
  result.initial_residual = result.residual = beta;
  const double target = target_of(beta);
  bool stagnates = false;
  while (true) {
    result.converged = result.residual <= target;
    if (result.converged || stagnates || result.iterations >= most_iterations || !std::isfinite(beta)) return result;
    normalise(basis, 0, beta);
    Hessenberg hessenberg(problem.restart_length);
    hessenberg.rhs[0] = beta;
    Index k = 0;
    while (k < problem.restart_length && result.iterations < most_iterations) {
      Eigen::VectorXd h;
      const double below = extend(problem, basis, k, h);
      hessenberg.append(k, h, below);
      ++result.iterations;
      ++k;
      if (below == 0.0 || std::abs(hessenberg.rhs[k]) <= std::max(0.9 * target, greatest_drop * beta)) break;
      if (k < problem.restart_length) normalise(basis, k, below);
    }
    add_combination(basis, hessenberg, k, x);
    if (problem.constrain) problem.constrain(x);
    const double estimate = std::abs(hessenberg.rhs[k]);
    if (estimate <= target && estimate >= modest_drop * beta) {
      result.residual = estimate;
      continue;
    }
    result.residual = start(problem, b, x, basis);
    stagnates = result.residual <= problem.good_enough && result.residual > stagnation * beta;
    beta = result.residual;
  }
}

}  // namespace

double scaled_norm(const std::vector<Vector>& v, const std::vector<double>& scale) {
  return std::sqrt(parallel_sum(count_of(v), [&](Index i) { return (scale[i] * v[i]).squaredNorm(); }));
}

KrylovResult solve_fgmres(const KrylovProblem& problem, const std::vector<Vector>& b, std::vector<Vector>& x,
                          const std::function<double(double initial)>& target_of, Index most_iterations) {
  return problem.stores_doubles ? solve_with<double>(problem, b, x, target_of, most_iterations)
                                : solve_with<float>(problem, b, x, target_of, most_iterations);
}

}  // namespace pfdm
