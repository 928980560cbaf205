#include "physics/damage/crack_geometry.h"

#include "physics/registry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

// Bourdin, Francfort, Marigo, J. Mech. Phys. Solids 48 (2000) 797: damage from the first load on.
constexpr CrackGeometry at2{
    .name = "AT2",
    .description = "alpha = d^2, c0 = 2; damage grows from the first load on",
    .c0 = 2.0,
    .alpha = [](double d) { return d * d; },
    .alpha_prime = [](double d) { return 2.0 * d; },
    .alpha_second = [](double) { return 2.0; },
    .support = std::numeric_limits<double>::infinity(),
};

// Pham, Amor, Marigo, Maurini, Int. J. Damage Mech. 20 (2011) 618: elastic up to sqrt(3 E Gc / (8 ell)).
constexpr CrackGeometry at1{
    .name = "AT1",
    .description = "alpha = d, c0 = 8/3; elastic below a threshold, compact support",
    .c0 = 8.0 / 3.0,
    .alpha = [](double d) { return d; },
    .alpha_prime = [](double) { return 1.0; },
    .alpha_second = [](double) { return 0.0; },
    .support = 2.0,
};

// Wu, J. Mech. Phys. Solids 103 (2017) 72, eq. 2.27: with the rational degradation the strength does not depend on ell.
constexpr CrackGeometry wu{
    .name = "Wu",
    .description = "alpha = 2d - d^2, c0 = pi; cohesive cracks (PF-CZM), with the rational degradation",
    .c0 = std::numbers::pi,
    .alpha = [](double d) { return d * (2.0 - d); },
    .alpha_prime = [](double d) { return 2.0 - 2.0 * d; },
    .alpha_second = [](double) { return -2.0; },
    .support = 0.5 * std::numbers::pi,
};

constexpr CrackGeometry all_geometries[] = {at2, at1, wu};

}  // namespace

std::span<const CrackGeometry> crack_geometries() { return all_geometries; }

const CrackGeometry& crack_geometry(std::string_view name) {
  return find_by_name(crack_geometries(), name, "crack geometric function");
}

// ds/dd = -ell/sqrt(alpha), and the density of the surface energy is proportional to alpha.
double energy_beyond(const CrackGeometry& crack, double distance) {
  constexpr int n = 20000;
  double s = 0.0, within = 0.0;
  for (int i = 0; i < n && s < distance; ++i) {
    const double root = std::sqrt(crack.alpha(1.0 - (i + 0.5) / n));
    s += 1.0 / (n * root);
    within += root / n;
  }
  return s < distance ? 0.0 : std::max(0.0, 1.0 - within * 4.0 / crack.c0);
}

}  // namespace pfdm
