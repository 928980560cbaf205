#pragma once
// Surfaces on which polar angles mean nothing.

#include "postproc/cohesive/columns.h"

namespace pfdm {

/// Whether a surface has no poles: a cut, or one whose areas, as vectors, nearly come to their sum. `places`: its
/// columns, or what was recorded of them, with `area` [m^2] and `normal` each.
template <class Places>
bool is_flat(SurfaceKind kind, const Places& places) {
  constexpr double flat_share = 0.999;
  double whole = 0.0;
  Vector sum = Vector::Zero();
  for (const auto& place : places) {
    whole += place.area;
    sum += place.area * place.normal;
  }
  return kind == SurfaceKind::plane || sum.norm() > flat_share * whole;
}

}  // namespace pfdm
