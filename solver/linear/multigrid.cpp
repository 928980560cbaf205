#include "solver/linear/multigrid.h"

#include "mesh/fields.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr Index coarsest_size = 120;  // rows solved directly
constexpr Index most_direct_rows = 1500;
constexpr int pairwise_passes = 3;  // aggregates of up to 8
constexpr int sweeps = 2;           // before, and after, the coarse correction
constexpr Index group_size = 1024;  // rows of one smoothing task

// Groups of consecutive rows, coloured so that groups of one colour are not coupled.
std::vector<std::vector<Index>> colour_groups(const BlockMatrix& matrix) {
  const Index n_groups = (matrix.n_rows() + group_size - 1) / group_size;
  std::vector<Index> colour(n_groups, -1);
  std::vector<std::vector<Index>> by_colour;
  std::vector<Index> taken;
  for (Index group = 0; group < n_groups; ++group) {
    taken.clear();
    for (Index i = group * group_size; i < std::min(matrix.n_rows(), (group + 1) * group_size); ++i)
      for (Index k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
        const Index other = matrix.columns[k] / group_size;
        if (other != group && colour[other] >= 0) taken.push_back(colour[other]);
      }
    Index c = 0;
    while (std::find(taken.begin(), taken.end(), c) != taken.end()) ++c;
    colour[group] = c;
    if (as_size(c) == by_colour.size()) by_colour.emplace_back();
    by_colour[c].push_back(group);
  }
  return by_colour;
}

Lane off_diagonal_product(const BlockMatrix& a, Index i, const std::vector<Lane>& x) {
  Lane sum = Lane::Zero();
  for (Index k = a.offsets[i]; k < a.offsets[i + 1]; ++k) sum += a.blocks[k] * x[a.columns[k]];
  return sum;
}

void smooth_row(const BlockMatrix& a, Index i, const std::vector<Lane>& b, std::vector<Lane>& x) {
  x[i] = a.inverse_diagonal[i] * Lane(b[i] - off_diagonal_product(a, i, x));
}

void for_groups(const std::vector<Index>& groups, const auto& body) {
  detail::run_tasks(count_of(groups), [&](Index k) { body(groups[k]); });
}

void sweep_forward(const BlockMatrix& a, const std::vector<std::vector<Index>>& groups_by_colour,
                   const std::vector<Lane>& b, std::vector<Lane>& x) {
  for (const auto& groups : groups_by_colour)
    for_groups(groups, [&](Index group) {
      for (Index i = group * group_size; i < std::min(a.n_rows(), (group + 1) * group_size); ++i)
        smooth_row(a, i, b, x);
    });
}

void sweep_backward(const BlockMatrix& a, const std::vector<std::vector<Index>>& groups_by_colour,
                    const std::vector<Lane>& b, std::vector<Lane>& x) {
  for (std::size_t colour = groups_by_colour.size(); colour-- > 0;)
    for_groups(groups_by_colour[colour], [&](Index group) {
      for (Index i = std::min(a.n_rows(), (group + 1) * group_size) - 1; i >= group * group_size; --i)
        smooth_row(a, i, b, x);
    });
}

// By differences, so that what moves as a whole is not lost in rounding.
void multiply(const BlockMatrix& a, const std::vector<Lane>& x, std::vector<Lane>& y) {
  parallel_for(a.n_rows(), [&](Index i) {
    const Lane own = x[i];
    Lane sum = a.row_sum[i] * own;
    for (Index k = a.offsets[i]; k < a.offsets[i + 1]; ++k) sum += a.blocks[k] * Lane(x[a.columns[k]] - own);
    y[i] = sum;
  });
}

double dot(const std::vector<Lane>& a, const std::vector<Lane>& b) {
  return parallel_sum(count_of(a), [&](Index i) { return double((a[i] * b[i]).sum()); });
}

// y += factor x.
void add(double factor, const std::vector<Lane>& x, std::vector<Lane>& y) {
  const auto f = static_cast<float>(factor);
  parallel_for(count_of(x), [&](Index i) { y[i] += f * x[i]; });
}

}  // namespace

Multigrid::Multigrid(BlockMatrix matrix) {
  levels_.push_back({.matrix = std::move(matrix),
                     .aggregates = {},
                     .groups_by_colour = {},
                     .residual = {},
                     .coarse_b = {},
                     .coarse_x = {},
                     .direction = {},
                     .image = {},
                     .k_residual = {}});
  while (levels_.back().matrix.n_rows() > coarsest_size) {
    Level& fine = levels_.back();
    fine.aggregates = aggregate(fine.matrix, pairwise_passes);
    const bool stalled = fine.aggregates.count > fine.matrix.n_rows() * 4 / 5;
    if (fine.aggregates.count == 0 || (stalled && fine.matrix.n_rows() <= most_direct_rows)) break;
    BlockMatrix coarse = coarsen(fine.matrix, fine.aggregates);
    levels_.push_back({.matrix = std::move(coarse),
                       .aggregates = {},
                       .groups_by_colour = {},
                       .residual = {},
                       .coarse_b = {},
                       .coarse_x = {},
                       .direction = {},
                       .image = {},
                       .k_residual = {}});
  }
  set_up_work_space();
}

void Multigrid::set_up_work_space() {
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    Level& level = levels_[l];
    level.groups_by_colour = colour_groups(level.matrix);
    const std::size_t n = level.matrix.n_rows(), n_coarse = as_size(levels_[l + 1].matrix.n_rows());
    level.residual.resize(n);
    level.coarse_b.resize(n_coarse);
    level.coarse_x.resize(n_coarse);
    if (l == 0) continue;
    for (auto* work : {&level.direction[0], &level.direction[1], &level.image[0], &level.image[1], &level.k_residual})
      work->resize(n);
  }
  factor_coarsest();
}

// In double precision, with the diagonal as the sum of its parts: of a stiff part that is hardly held, single precision
// would not know how well.
void Multigrid::factor_coarsest() {
  const BlockMatrix& last = levels_.back().matrix;
  const Index n = 3 * last.n_rows();
  std::vector<double> dense(as_size(n) * as_size(n), 0.0);
  const auto add_block = [&](Index row, Index column, const Tensor& block) {
    for (Index j = 0; j < 3; ++j)
      for (Index i = 0; i < 3; ++i) dense[as_size(3 * column + j) * as_size(n) + as_size(3 * row + i)] += block(i, j);
  };
  for (Index i = 0; i < last.n_rows(); ++i) {
    add_block(i, i, to_tensor(last.row_sum[i]));
    for (Index k = last.offsets[i]; k < last.offsets[i + 1]; ++k) {
      const Tensor block = to_tensor(last.blocks[k]);
      add_block(i, last.columns[k], block);
      add_block(i, i, -block);
    }
  }
  // Parts of a broken body may not be held at all.
  for (double shift = 1e-12; !coarsest_.compute(n, dense) && shift < 1.0; shift *= 10.0)
    for (Index i = 0; i < n; ++i) dense[as_size(i) * as_size(n + 1)] *= 1.0 + shift;
}

void Multigrid::apply(const std::vector<Lane>& b, std::vector<Lane>& x) { cycle(0, b, x); }

void Multigrid::solve_coarsest(const std::vector<Lane>& b, std::vector<Lane>& x) const {
  std::vector<double> flat(3 * b.size());
  for (std::size_t i = 0; i < b.size(); ++i) std::copy_n(b[i].data(), 3, flat.data() + 3 * i);
  coarsest_.solve(flat);
  for (std::size_t i = 0; i < b.size(); ++i) {
    std::transform(flat.data() + 3 * i, flat.data() + 3 * i + 3, x[i].data(), [](double v) { return float(v); });
    x[i][3] = 0.0F;
  }
}

void Multigrid::cycle(std::size_t l, const std::vector<Lane>& b, std::vector<Lane>& x) {
  if (l + 1 == levels_.size()) {
    solve_coarsest(b, x);
    return;
  }
  Level& level = levels_[l];
  const BlockMatrix& a = level.matrix;
  std::fill(x.begin(), x.end(), Lane::Zero());
  for (int s = 0; s < sweeps; ++s) sweep_forward(a, level.groups_by_colour, b, x);
  multiply(a, x, level.residual);
  std::fill(level.coarse_b.begin(), level.coarse_b.end(), Lane::Zero());
  for (std::size_t i = 0; i < b.size(); ++i)
    if (const Index to = level.aggregates.of_row[i]; to >= 0) level.coarse_b[to] += b[i] - level.residual[i];
  k_cycle(l + 1, level.coarse_b, level.coarse_x);
  parallel_for(a.n_rows(), [&](Index i) {
    if (const Index from = level.aggregates.of_row[i]; from >= 0) x[i] += level.coarse_x[from];
  });
  for (int s = 0; s < sweeps; ++s) sweep_backward(a, level.groups_by_colour, b, x);
}

// At most two steps of flexible conjugate gradients on the level, preconditioned by its cycle.
void Multigrid::k_cycle(std::size_t l, const std::vector<Lane>& b, std::vector<Lane>& x) {
  if (l + 1 == levels_.size()) {
    solve_coarsest(b, x);
    return;
  }
  Level& level = levels_[l];
  auto& [c, d] = level.direction;
  auto& [v, w] = level.image;
  auto& r = level.k_residual;
  cycle(l, b, c);
  multiply(level.matrix, c, v);
  const double rho = dot(c, v), alpha = dot(c, b);
  if (!(rho > 0.0)) {
    x = c;
    return;
  }
  r = b;
  add(-alpha / rho, v, r);
  std::fill(x.begin(), x.end(), Lane::Zero());
  constexpr double enough = 0.25;
  if (dot(r, r) <= enough * enough * dot(b, b)) {
    add(alpha / rho, c, x);
    return;
  }
  cycle(l, r, d);
  multiply(level.matrix, d, w);
  const double gamma = dot(d, v), beta = dot(d, w), alpha2 = dot(d, r);
  const double rho2 = beta - gamma * gamma / rho;
  if (!(rho2 > 0.0)) {
    add(alpha / rho, c, x);
    return;
  }
  add(alpha / rho - gamma * alpha2 / (rho * rho2), c, x);
  add(alpha2 / rho2, d, x);
}

}  // namespace pfdm
