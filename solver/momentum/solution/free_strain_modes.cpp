#include "solver/momentum/solution/free_strain_modes.h"

#include "solver/linear/dense_algebra.h"
#include "solver/momentum/solution/momentum_solver.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double precision = 1e-2;      // of the motions
constexpr double bonded = 10.0;         // stiffness of split faces over that of the cells beside them
constexpr double least_modulus = 1e-3;  // of the box, over the estimate

// Free strain number k is prescribed at the load parameter k.
Unknowns with_prescribed_strains(const Unknowns& unknowns) {
  Unknowns prescribed = unknowns;
  prescribed.motion.free_strains.clear();
  prescribed.motion.displacement = [&motion = unknowns.motion](const Vector& x, double t) -> Vector {
    return motion.free_strains[static_cast<std::size_t>(std::lround(t))].direction * (x - motion.centre);
  };
  return prescribed;
}

void make_sound(const Mesh& mesh, const Unknowns& unknowns, MomentumSolver& solver) {
  solver.set_moduli(unknowns.sound_moduli(), CellField<double>(mesh.n_cells(), 1.0));
  if (unknowns.split_faces.empty()) return;
  std::vector<FaceSpring> springs;
  std::vector<double> bond;
  const std::vector<Vector> zero(unknowns.n_unknowns(), Vector::Zero());
  for (const MomentumOperator::SplitSides& sides : solver.balance().split_sides(zero)) {
    const Tensor stiffness = bonded * (sides.give + sides.give_beyond).inverse();
    springs.push_back({.stiffness = stiffness, .offset = Vector::Zero(), .secant = stiffness});
    bond.push_back(stiffness.trace() / 3.0);
  }
  solver.set_springs(std::move(springs), bond);
}

}  // namespace

void FreeStrainModes::find_modes() {
  const Unknowns prescribed = with_prescribed_strains(unknowns_);
  MomentumSolver solver(mesh_, prescribed, linear_);
  make_sound(mesh_, prescribed, solver);
  const std::size_t n_modes = unknowns_.motion.free_strains.size();
  for (std::size_t k = 0; k < n_modes; ++k) {
    const auto load = static_cast<double>(k);
    std::vector<Vector> u = prescribed.moved_with_box(mesh_, load);
    solver.solve(load, {.ceiling = precision, .floor = precision, .most_iterations = 200}, u);
    std::vector<Single>& mode = modes_.emplace_back(unknowns_.n_unknowns(), Single::Zero());
    std::ranges::transform(u, mode.begin(), [](const Vector& v) { return v.cast<float>(); });
    mode[unknowns_.first_strain() + k] = Single::UnitX();
  }
}

void FreeStrainModes::build(const MomentumOperator& balance) {
  if (modes_.empty()) find_modes();
  const auto n = static_cast<Eigen::Index>(modes_.size());
  Eigen::MatrixXd coarse(n, n);
  double softest = std::numeric_limits<double>::infinity();
  std::vector<Vector> u(unknowns_.n_unknowns()), image(u.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    std::ranges::transform(modes_[k], u.begin(), [](const Single& v) { return v.cast<double>(); });
    balance.apply(u, image);
    coarse.col(k) = projected(image);
    softest = std::min(softest, unknowns_.motion.free_strains[k].modulus);
  }
  // Faces that soften may leave no stiffness.
  const auto [values, vectors] = symmetric_modes(0.5 * (coarse + coarse.transpose()));
  const Eigen::VectorXd bounded = values.cwiseMax(least_modulus * softest * unknowns_.motion.size.prod());
  give_ = vectors * bounded.cwiseInverse().asDiagonal() * vectors.transpose();
}

Eigen::VectorXd FreeStrainModes::projected(const std::vector<Vector>& r) const {
  Eigen::VectorXd on(static_cast<Eigen::Index>(modes_.size()));
  for (std::size_t k = 0; k < modes_.size(); ++k)
    on[k] = parallel_sum(count_of(r), [&](Index i) { return r[i].dot(modes_[k][i].cast<double>()); });
  return on;
}

void FreeStrainModes::correct(const std::vector<Vector>& r, std::vector<Vector>& z) const {
  const Eigen::VectorXd share = give_ * projected(r);
  parallel_for(count_of(z), [&](Index i) {
    for (std::size_t k = 0; k < modes_.size(); ++k) z[i] += share[k] * modes_[k][i].cast<double>();
  });
}

}  // namespace pfdm
