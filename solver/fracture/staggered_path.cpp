#include "solver/fracture/staggered.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pfdm {

// Path-following: displacements at given damage are proportional to the load, so that the load at which the damage
// equation yields the prescribed surface energy is the root of one rising function (dissipation as the control:
// Gutierrez, Commun. Numer. Meth. Engng 20 (2004) 19; for phase fields Singh et al., Finite Elem. Anal. Des. 113
// (2016) 14). Changes the load of the state, its displacement and driving energy, and d. The load is the greatest
// allowed where that dissipates less.
bool Staggered::follow_path(const FractureState& start, const PathLimit& limit, FractureState& state,
                            CellField<double>& d) {
  constexpr double precision = 1e-3;  // of the dissipation
  constexpr std::uintmax_t most_tries = 60;
  const double solved_load = state.load;
  double load = solved_load;
  bool damage_solved = false, reached = false;
  const auto excess = [&](double tried) {
    load = tried;
    drive(start, state, load / solved_load);
    damage_solved = solve_damage(start, state, d);
    const double energy = damage_.fracture_energy(d) - limit.energy;
    reached = std::abs(energy) <= precision * limit.step;
    return reached ? 0.0 : energy;
  };
  double below = load, above = load;
  double at_below = excess(load), at_above = at_below;
  for (double factor = 1.004; at_above < 0.0 && above < limit.load; factor *= factor) {
    below = above, at_below = at_above;
    above = std::min(factor * above, limit.load);
    at_above = excess(above);
  }
  for (double factor = 1.004; at_below > 0.0; factor *= factor) {
    above = below, at_above = at_below;
    below /= factor;
    at_below = excess(below);
  }
  if (at_below < 0.0 && at_above > 0.0) {
    const auto close_enough = [&](double a, double b) { return reached || b - a <= 1e-12 * b; };
    std::uintmax_t tries = most_tries;
    const auto [a, b] =
        boost::math::tools::toms748_solve(excess, below, above, at_below, at_above, close_enough, tries);
    if (!reached) excess(0.5 * (a + b));
  }
  for (Vector& u : state.displacement) u *= load / solved_load;
  state.load = load;
  return damage_solved;
}

}  // namespace pfdm
