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

double omega_of(const VibratingBody& body, double value) {
  return std::sqrt(std::max(0.0, 1.0 / value - body.shift()));
}

struct RitzPairs {
  std::vector<double> value;        // 1/(omega^2 + shift), descending
  std::vector<Eigen::VectorXd> of;  // weights of the space's vectors
  double residual = 0.0;            // largest, relative to its value
  bool real = true;
};

// K is symmetric but for errors of the discretisation, and modes of like frequency may then be a conjugate pair of
// eigenvalues. Their real and imaginary parts span the two modes, which are those of the symmetric part.
void add_conjugate_pair(const Eigen::MatrixXd& H, const Eigen::VectorXcd& vector, RitzPairs& pairs) {
  Eigen::MatrixXd basis(H.rows(), 2);
  basis.col(0) = vector.real().normalized();
  basis.col(1) = vector.imag() - basis.col(0).dot(vector.imag()) * basis.col(0);
  basis.col(1).normalize();
  const Eigen::Matrix2d within = basis.transpose() * H * basis;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> of_both(0.5 * (within + within.transpose()));
  for (const Eigen::Index k : {1, 0}) {
    pairs.value.push_back(of_both.eigenvalues()[k]);
    pairs.of.emplace_back(basis * of_both.eigenvectors().col(k));
  }
}

RitzPairs ritz_pairs(const KrylovSpace& space, int count) {
  constexpr double rounding = 1e-6, bearable = 0.2;  // of a pair's value: frequencies are off by at most half of it
  const Eigen::MatrixXd H = space.projection();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(H);
  const Eigen::VectorXcd& values = solver.eigenvalues();
  std::vector<Eigen::Index> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](Eigen::Index a, Eigen::Index b) { return values[a].real() > values[b].real(); });
  RitzPairs pairs;
  for (std::size_t k = 0; count_of(pairs.value) < count && k < order.size(); ++k) {
    const Eigen::Index i = order[k];
    Eigen::VectorXcd vector = solver.eigenvectors().col(i);
    Eigen::Index largest = 0;
    vector.cwiseAbs().maxCoeff(&largest);
    vector /= vector[largest];
    const double value = values[i].real(), imaginary = std::abs(values[i].imag());
    pairs.real = pairs.real && value > 0.0 && imaginary <= bearable * value;
    pairs.residual =
        std::max(pairs.residual, space.remainder() * std::abs(vector[vector.size() - 1]) / (value * vector.norm()));
    if (imaginary > rounding * value && k + 1 < order.size()) {
      add_conjugate_pair(H, vector, pairs);
      ++k;  // the other of the pair, which follows
      continue;
    }
    pairs.value.push_back(value);
    pairs.of.emplace_back(vector.real());
  }
  pairs.value.resize(count), pairs.of.resize(count);
  return pairs;
}

// What K does not feel, orthonormal in M; of a body with a shift. A maps each to itself over the shift.
std::vector<Eigen::VectorXd> rigid_motions(const VibratingBody& body) {
  constexpr double rounding = 1e-8;
  std::vector<Eigen::VectorXd> motions;
  if (body.shift() == 0.0) return motions;
  const Mesh& mesh = body.mesh();
  for (Index k = 0; k < 6; ++k) {
    const auto motion_at = [&](const Vector& x) -> Vector {
      return k < 3 ? Vector(Vector::Unit(k)) : Vector(Vector::Unit(k - 3).cross(x - mesh.cell_centre[0]));
    };
    Eigen::VectorXd v = Eigen::VectorXd::Zero(body.size());
    for (Index c = 0; c < mesh.n_cells(); ++c) v.segment<3>(3 * Eigen::Index{c}) = motion_at(mesh.cell_centre[c]);
    for (std::size_t i = 0; i < body.unknowns().face_of_node.size(); ++i)
      v.segment<3>(3 * (Eigen::Index{mesh.n_cells()} + static_cast<Eigen::Index>(i))) =
          motion_at(mesh.face_centre[body.unknowns().face_of_node[i]]);
    const Eigen::VectorXd image = body.inertial_answer(v) - v / body.shift();
    if (std::sqrt(body.inner(image, image)) > rounding / body.shift() * std::sqrt(body.inner(v, v))) continue;
    for (int pass = 0; pass < 2; ++pass)
      for (const Eigen::VectorXd& other : motions) v -= body.inner(other, v) * other;
    motions.emplace_back(v / std::sqrt(body.inner(v, v)));
  }
  return motions;
}

Mode mode_of(const VibratingBody& body, double omega, Eigen::VectorXd shape) {
  Mode mode{.omega = omega, .shape = std::move(shape)};
  mode.shape /= std::sqrt(body.inner(mode.shape, mode.shape));
  for (Index axis = 0; axis < 3; ++axis)
    mode.participation[axis] = body.inner(mode.shape, body.rigid(Vector::Unit(axis)));
  return mode;
}

// Of A from one of A without rigid motions, of the eigenvalue: A w = value w + R g, and A R = R/shift.
Eigen::VectorXd with_rigid_part(const VibratingBody& body, const std::vector<Eigen::VectorXd>& rigid, double value,
                                Eigen::VectorXd w) {
  if (rigid.empty()) return w;
  const Eigen::VectorXd image = body.inertial_answer(w);
  for (const Eigen::VectorXd& r : rigid) w += body.inner(r, image) / (value - 1.0 / body.shift()) * r;
  return w;
}

}  // namespace

std::vector<Mode> lowest_modes(const VibratingBody& body, int count, double tolerance) {
  const Eigen::Index most = std::min<Eigen::Index>(60 + 8 * count, 3 * Eigen::Index{body.unknowns().n_cells});
  if (count > most) throw InputError(fmt::format("the mesh has no {} modes", count));
  const std::vector<Eigen::VectorXd> rigid = rigid_motions(body);
  std::vector<Mode> modes;
  modes.reserve(rigid.size());
  for (const Eigen::VectorXd& motion : rigid) modes.push_back(mode_of(body, 0.0, motion));
  const int n_elastic = count - static_cast<int>(rigid.size());
  if (n_elastic <= 0) return {modes.begin(), modes.begin() + count};
  KrylovSpace space(body, random_start(body), rigid);
  for (bool goes_on = true; goes_on;) {
    goes_on = space.extend() && space.n_projected() < most;
    if (space.n_projected() < n_elastic || (goes_on && space.n_projected() % 5 != 0)) continue;
    const RitzPairs pairs = ritz_pairs(space, n_elastic);
    if (goes_on && pairs.residual > tolerance) continue;
    if (pairs.residual > tolerance) break;
    if (!pairs.real)
      throw ComputationError(
          fmt::format("the lowest {} modes cannot be told apart on this mesh; shorter cells help ([mesh])", count));
    for (std::size_t k = 0; k < pairs.value.size(); ++k)
      modes.push_back(mode_of(body, omega_of(body, pairs.value[k]),
                              with_rigid_part(body, rigid, pairs.value[k], space.combined(pairs.of[k]))));
    std::ranges::stable_sort(modes, {}, &Mode::omega);  // a pair spreads about its mean
    return modes;
  }
  throw ComputationError(
      fmt::format("the lowest {} modes were not found: is the body held, and its mesh sound?", count));
}

}  // namespace pfdm
