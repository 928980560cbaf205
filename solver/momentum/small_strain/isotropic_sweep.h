#pragma once
// The sweep of IsotropicTractions over the faces, with any function of the stress by the gradient, which may see the
// gradients of all cells first.

#include "solver/momentum/small_strain/isotropic_tractions.h"
#include "solver/parallel.h"

namespace pfdm {

template <class StressOf>
void IsotropicTractions::sweep_faces(const std::vector<Vector>& u, IsotropicSweep& s, const StressOf& stress_of) const {
  using momentum_faces::Link, momentum_faces::Side;
  reconstruct(u, s);
  if constexpr (requires { stress_of.see(s.gradients); }) stress_of.see(s.gradients);
  const Vector& across = plane_normal();
  parallel_for(s.sector_stress.size(), [&](Index c) {
    s.sector_stress[c] = across.dot(stress_of(c, s.gradients[c], across)) + s.pressure.mean(c);
  });
  const auto n_links = count_of(skeleton_.links);
  const bool has_fluxes = cells_.pressure().any();
  parallel_for(n_links, [&](Index i) {
    const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
    const Link& link = skeleton_.links[i];
    const Vector stress_P = traction(link.P, link.n, link.d_P, P, s, stress_of);
    const Vector stress_N = traction(link.N, link.n, link.d_N, N, s, stress_of);
    const Vector u_P = u[link.P] + rise(link.P, link.d_P, P, s);
    const Vector jump = u[link.N] + rise(link.N, link.d_N, N, s) - u_P;
    if (has_fluxes) s.flux[i] = link_flux(i, u_P, jump, stress_N - stress_P, s);
    s.force[i] = link.area * (stress_N + weigh(i, stress_P - stress_N) + pull_jump(i, jump));
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Side& side = skeleton_.sides[i];
    const SideValues& by = side_values_[i];
    const std::size_t turn = skeleton_.turn_of_side(i);
    const Vector gap = u[side.node] - u[side.cell] - rise(side.cell, side.d, turn, s);
    const Vector stress = traction(side.cell, side.n, side.d, turn, s, stress_of);
    s.force[n_links + i] = side.area * (stress + momentum_faces::scale(by.a_n, by.a_t, side.n, gap));
    if (has_fluxes) s.flux[n_links + i] = side_flux(i, u[side.node], s);
  });
}

}  // namespace pfdm
