#pragma once
// Heat of a cell while damage degrades it: integrals over a step of which only both ends are known. Within a jump g
// falls by orders and what the undamaged material would store and dissipate rises by orders, as the crack opens: the
// trapezoidal rule gave half of that as heat. Where changes are small both are the same to second order.

#include "physics/materials/material.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

/// Logarithmic mean of two positive numbers: (b - a)/ln(b/a).
inline double logarithmic_mean(double a, double b) {
  const double x = std::log(b / a);
  return std::abs(x) < 1e-4 ? std::sqrt(a * b) : (b - a) / x;
}

/// - int W dg: what damage frees of an energy W that does not drive it, g and W being exponentials of the same
/// parameter from one state to the other. An end without energy counts as one with a millionth of the other's.
inline double freed_energy(double g_from, double W_from, double g_to, double W_to) {
  constexpr double least = 1e-6;
  const double floor = least * std::max(W_from, W_to);
  if (g_from == g_to || !(floor > 0.0)) return 0.0;
  W_from = std::max(W_from, floor), W_to = std::max(W_to, floor);
  if (!(g_to > 0.0)) return g_from * W_from;
  return std::log(g_from / g_to) * logarithmic_mean(g_from * W_from, g_to * W_to);
}

/// int g dw of what the undamaged material dissipates, by the geometric mean of g.
inline double degraded_dissipation(double g_from, double g_to, double dissipated) {
  return std::sqrt(g_from * g_to) * dissipated;
}

/// Heat of a cell per volume [J/m^3] while its stiffness factor goes from g_from to g_to: what flows, and what damage
/// frees of the energy that does not drive it.
inline double degraded_heat(double g_from, const MaterialEnergy& before, double g_to, const MaterialEnergy& after) {
  return degraded_dissipation(g_from, g_to, after.dissipated - before.dissipated) +
         freed_energy(g_from, before.idle, g_to, after.idle);
}

}  // namespace pfdm
