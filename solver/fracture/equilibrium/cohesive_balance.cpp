// Balance of the faces: member functions of cohesive_faces.h.

#include "solver/fracture/equilibrium/balanced_separation.h"
#include "solver/fracture/equilibrium/cohesive_faces.h"
#include "solver/fracture/equilibrium/resisted_separation.h"
#include "solver/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

constexpr double steepest_resistance = 1e3;  // over the stiffness of the cells beside the face

/// Without what softens: the symmetric part's negative eigenvalues are zero.
Tensor convex_part(const Tensor& tangent) {
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(0.5 * (tangent + tangent.transpose()));
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
}

/// Limits how steeply the rate of opening resists in a linear solve, in which a face at rest is to stay: its balance is
/// found without it. The preconditioner's secant gets that part.
void limit_resistance(double most, InterfaceResponse& response) {
  const Tensor whole = response.by_overstress * response.overstress_slope.transpose();
  const double size = whole.norm();
  if (!(size > 0.0)) return;
  const Tensor limited = std::min(1.0, most / size) * whole;
  response.tangent += limited - whole;
  response.secant += convex_part(limited);
}

}  // namespace

void CohesiveFaces::linearise(const std::vector<Vector>& u, const std::vector<InterfaceHistory>& before,
                              const std::vector<InterfaceHistory>& after, Way way, MomentumSolver& momentum) const {
  std::vector<FaceSpring> springs(faces_.size());
  parallel_for(count_of(faces_), [&](Index k) {
    const Vector separation = momentum.balance().separation(k, u);
    const Vector n = normal(faces_[k], momentum.balance());
    InterfaceResponse response = respond(k, n, separation, before[k], after[k]);
    limit_resistance(steepest_resistance * bond_[k], response);
    const Tensor stiffness = way == Way::tangent ? response.tangent : convex_part(response.tangent);
    springs[k] = {.stiffness = stiffness,
                  .offset = response.traction - stiffness * separation,
                  .secant = way == Way::tangent ? response.secant : stiffness};
    if (way == Way::tangent) normals_->turn(faces_[k].sides, momentum.balance(), separation, response, springs[k]);
  });
  momentum.set_springs(std::move(springs), bond_);
}

// With the sides' tractions t_P, t_N and compliances c_P, c_N: T(delta) = T,
//
//   (c_P + c_N) T + delta = delta_0 + c_P t_P - c_N t_N,
//
// whose solution is unique where the law does not fall more steeply than the cells beside it unload.
void CohesiveFaces::settle(const std::vector<InterfaceHistory>& before, const MomentumOperator& balance,
                           std::vector<Vector>& u, std::vector<InterfaceHistory>& after) const {
  const std::vector<MomentumOperator::SplitSides> sides = balance.split_sides(u);
  parallel_for(count_of(faces_), [&](Index k) {
    const Face& face = faces_[k];
    const MomentumOperator::SplitSides& s = sides[k];
    const Tensor give = s.give + s.give_beyond;
    const Vector now = balance.separation(k, u);
    const Vector due = now + s.give * s.traction - s.give_beyond * s.traction_beyond;
    const Vector n = normal(face, balance);
    std::optional<Vector> separation;
    if (has_rate(face)) {
      const auto resisted = resisted_separation(law(face), face.at, n, before[k], give, due, now, duration_);
      if (resisted) separation = resisted->separation;
      after[k].overstress =
          resisted ? resisted->overstress : law(face).rate.at(law(face).growth(n, now, before[k]) / duration_).value;
    } else {
      separation = balanced_separation(law(face), face.at, n, before[k], give, due, now, duration_);
    }
    if (!separation) return;
    const Vector traction = respond(k, n, *separation, before[k], after[k]).traction;
    balance.part(k, s.give * (traction - s.traction), -(s.give_beyond * (traction + s.traction_beyond)), u);
  });
}

// The overstress of a face whose traction depends on its rate is that of its balance.
InterfaceResponse CohesiveFaces::respond(Index k, const Vector& n, const Vector& separation,
                                         const InterfaceHistory& before, const InterfaceHistory& after) const {
  const Face& face = faces_[k];
  const auto known = has_rate(face) ? std::optional(after.overstress) : std::nullopt;
  return law(face).respond(face.at, n, separation, before, duration_, known);
}

}  // namespace pfdm
