#pragma once
// Symmetric problems of 3x3 blocks, random and of elastic bodies, and their solution by multigrid.

#include "solver/linear/fgmres.h"
#include "solver/linear/multigrid.h"
#include "solver/momentum/momentum.h"
#include "tests/solver/solver_checks.h"

#include <cmath>
#include <numeric>
#include <set>
#include <vector>

namespace pfdm {

inline Tensor random_positive(RandomNumbers& random) {
  const Tensor a = random.tensor();
  return a * a.transpose() + 0.1 * Tensor::Identity();
}

/// Rows that are coupled by random blocks to a few others, and held a little: the matrix of a random truss.
inline BlockTriplets random_problem(Index n) {
  RandomNumbers random;
  BlockTriplets a;
  a.diagonal.resize(n);
  for (Tensor& block : a.diagonal) block = 0.01 * random_positive(random);
  for (Index i = 1; i < n; ++i)
    for (const Index j : std::set<Index>{i - 1, i / 2, i / 3}) {
      const Tensor c = random_positive(random);
      a.diagonal[i] += c;
      a.diagonal[j] += c;
      a.off_diagonal.push_back({i, j, -c});
    }
  return a;
}

/// The compact matrix of a clamped block of rubber with cells of random stiffness.
inline BlockTriplets elastic_problem(Index cells_along_an_edge) {
  const Mesh mesh = box(cells_along_an_edge, cells_along_an_edge, cells_along_an_edge);
  FractureModel model;
  model.regions.push_back({.elasticity = from_young_poisson(75e6, 0.44)});
  model.boundary = {clamped("zmin")};
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumOperator balance(mesh, unknowns);
  RandomNumbers random;
  CellField<double> g(mesh.n_cells());
  CellField<IsotropicElasticity> moduli(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    g[c] = std::pow(10.0, random.between(-3.0, 0.0));
    const IsotropicElasticity& whole = model.regions.front().elasticity;
    moduli[c] = {.lambda = g[c] * whole.lambda, .mu = g[c] * whole.mu};
  }
  balance.set_moduli(moduli, g);
  return balance.compact_matrix();
}

inline void multiply(const BlockTriplets& a, const std::vector<Vector>& x, std::vector<Vector>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = a.diagonal[i] * x[i];
  for (const auto& [row, column, value] : a.off_diagonal) {
    y[row] += value * x[column];
    y[column] += value.transpose() * x[row];
  }
}

inline std::vector<Index> in_order(std::size_t n) {
  std::vector<Index> position(n);
  std::iota(position.begin(), position.end(), 0);
  return position;
}

inline KrylovProblem problem_of(const BlockTriplets& a, Multigrid& multigrid) {
  const auto to_lanes = [](const std::vector<Vector>& v) {
    std::vector<Lane> lanes(v.size(), Lane::Zero());
    for (std::size_t i = 0; i < v.size(); ++i) lanes[i].head<3>() = v[i].cast<float>();
    return lanes;
  };
  std::vector<double> scale;
  for (const Tensor& block : a.diagonal) scale.push_back(1.0 / std::sqrt(block.trace() / 3.0));
  return {.apply = [&a](const auto& x, auto& y) { multiply(a, x, y); },
          .precondition =
              [&multigrid, to_lanes](const auto& r, auto& z) {
                std::vector<Lane> x(r.size(), Lane::Zero());
                multigrid.apply(to_lanes(r), x);
                for (std::size_t i = 0; i < z.size(); ++i) z[i] = x[i].template head<3>().template cast<double>();
              },
          .scale = scale};
}

inline double residual(const BlockTriplets& a, const std::vector<Vector>& x, const std::vector<Vector>& b,
                       const std::vector<double>& scale) {
  std::vector<Vector> r(x.size());
  multiply(a, x, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  return scaled_norm(r, scale);
}

inline std::vector<Vector> random_vectors(std::size_t n) {
  RandomNumbers random;
  std::vector<Vector> b(n);
  for (Vector& v : b) v = random.vector();
  return b;
}

/// Solves from zero and returns the iterations it took.
inline Index expect_solved(const BlockTriplets& a, double tolerance) {
  Multigrid multigrid(compress(a, in_order(a.diagonal.size())));
  const KrylovProblem problem = problem_of(a, multigrid);
  const std::vector<Vector> b = random_vectors(a.diagonal.size());
  std::vector<Vector> x(b.size(), Vector::Zero());
  const KrylovResult result = solve_fgmres(
      problem, b, x, [&](double initial) { return tolerance * initial; }, 200);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.initial_residual, scaled_norm(b, problem.scale), 1e-12 * result.initial_residual);
  const double truth = residual(a, x, b, problem.scale);
  EXPECT_LE(truth, tolerance * result.initial_residual);
  EXPECT_NEAR(result.residual, truth, 0.02 * truth) << "what is reported is not true";
  return result.iterations;
}

}  // namespace pfdm
