#include "solver/dynamics/modes.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <numeric>
#include <random>

namespace pfdm {
namespace {

Eigen::VectorXd random_start(const VibratingBody& body) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd v(body.size());
  for (double& value : v) value = uniform(engine);
  return body.inertial_answer(v);
}

struct RitzPairs {
  std::vector<double> value;        // 1/omega^2, descending
  std::vector<Eigen::VectorXd> of;  // weights of the space's vectors
  double residual = 0.0;            // largest, relative to its value
  bool real = true;
};

RitzPairs ritz_pairs(const KrylovSpace& space, int count) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(space.projection());
  const Eigen::VectorXcd& values = solver.eigenvalues();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](Eigen::Index a, Eigen::Index b) { return values[a].real() > values[b].real(); });
  RitzPairs pairs;
  for (int k = 0; k < count; ++k) {
    const Eigen::Index i = order[static_cast<std::size_t>(k)];
    Eigen::VectorXcd vector = solver.eigenvectors().col(i);
    Eigen::Index largest = 0;
    vector.cwiseAbs().maxCoeff(&largest);
    vector /= vector[largest];
    const double value = values[i].real();
    pairs.real = pairs.real && value > 0.0 && std::abs(values[i].imag()) <= 1e-6 * value;
    pairs.residual =
        std::max(pairs.residual, space.remainder() * std::abs(vector[vector.size() - 1]) / (value * vector.norm()));
    pairs.value.push_back(value);
    pairs.of.emplace_back(vector.real());
  }
  return pairs;
}

}  // namespace

std::vector<Mode> lowest_modes(const VibratingBody& body, int count, double tolerance) {
  const Eigen::Index most = std::min<Eigen::Index>(60 + 8 * count, 3 * Eigen::Index{body.unknowns().n_cells});
  if (count > most) throw InputError(fmt::format("the mesh has no {} modes", count));
  KrylovSpace space(body, random_start(body));
  for (bool goes_on = true; goes_on;) {
    goes_on = space.extend() && space.n_projected() < most;
    if (space.n_projected() < count || (goes_on && space.n_projected() % 5 != 0)) continue;
    const RitzPairs pairs = ritz_pairs(space, count);
    if (goes_on && pairs.residual > tolerance) continue;
    if (pairs.residual > tolerance || !pairs.real) break;
    std::vector<Mode> modes;
    for (int k = 0; k < count; ++k) {
      Mode mode{.omega = 1.0 / std::sqrt(pairs.value[static_cast<std::size_t>(k)]),
                .shape = space.combined(pairs.of[static_cast<std::size_t>(k)])};
      mode.shape /= std::sqrt(body.inner(mode.shape, mode.shape));
      for (Index axis = 0; axis < 3; ++axis)
        mode.participation[axis] = body.inner(mode.shape, body.rigid(Vector::Unit(axis)));
      modes.push_back(std::move(mode));
    }
    return modes;
  }
  throw ComputationError(
      fmt::format("the lowest {} modes were not found: is the body held, and its mesh sound?", count));
}

}  // namespace pfdm
