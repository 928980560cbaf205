#include "solver/momentum/bending/turned_stiffness.h"

#include "physics/elasticity/anisotropy.h"
#include "physics/elasticity/plane_stress.h"

namespace pfdm {
namespace {

using Rows = TurnedStiffness::Rows;

// A^-1 n.D
Rows slope_of(const MandelMatrix& C, const MandelMatrix& D, const Vector& n) {
  const Eigen::Matrix<double, 6, 3> strains = strains_across(n);
  const Tensor acoustic = strains.transpose() * C * strains;
  return acoustic.inverse() * (strains.transpose() * D);
}

}  // namespace

MandelMatrix TurnedStiffness::stiffness(Index cell) const {
  const MandelMatrix& C = *unknowns_.stiffness_of(mesh_, cell);
  if (!unknowns_.plane_stress) return C;
  return plane_stress({.C = C, .initial = Mandel::Zero()}, unknowns_.plane_normal).C;
}

bool TurnedStiffness::turns(Index cell, Index other) const {
  constexpr double alike = 1e-9;
  if (unknowns_.loads.eigenstrain || unknowns_.zone[cell] != unknowns_.zone[other]) return false;
  const MandelMatrix *here = unknowns_.stiffness_of(mesh_, cell), *there = unknowns_.stiffness_of(mesh_, other);
  return here != nullptr && there != nullptr && (*there - *here).norm() > alike * here->norm();
}

Rows TurnedStiffness::slope_along(Index cell, Index other, const Vector& n) const {
  const MandelMatrix here = stiffness(cell), there = stiffness(other);
  return slope_of(there, there, n) - slope_of(here, here, n);
}

Rows TurnedStiffness::slope_cutting(Index cell, Index other, const Vector& n) const {
  const MandelMatrix here = stiffness(cell);
  return slope_of(here, stiffness(other) - here, n);
}

}  // namespace pfdm
