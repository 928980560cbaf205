#include "physics/interfaces/interface_toughness.h"

#include <cmath>
#include <functional>

namespace pfdm {
namespace {

constexpr int points = 2000, bisections = 60;

// int_from^1 f(d) dd; d = from + (1 - from) y^3 crowds the points at the lower end, where the integrands are steep.
double integral(double from, const std::function<double(double)>& f) {
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double y = (i + 0.5) / points;
    sum += f(from + (1.0 - from) * y * y * y) * 3.0 * y * y;
  }
  return sum * (1.0 - from) / points;
}

// Place at which a falling function crosses zero.
double root_of_falling(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The dissipation of one half over the band's Gc; `ratio` is the neighbour's Gc over it, `half` the half width over
// ell.
double half_dissipation(const CrackGeometry& crack, double ratio, double half) {
  const bool pinned = std::isinf(ratio);
  if (half >= crack.support) return 0.5;
  // The damage at the edge, or where the edge is pinned the constant C itself, sets the width that the profile needs.
  const auto constant = [&](double unknown) {
    return pinned ? unknown / (1.0 - unknown) : (ratio * ratio - 1.0) * crack.alpha(unknown);
  };
  const auto edge = [&](double unknown) { return pinned ? 0.0 : unknown; };
  const double unknown = root_of_falling(0.0, 1.0 - 1e-12, [&](double x) {
    const double C = constant(x);
    return integral(edge(x), [&](double d) { return 1.0 / std::sqrt(crack.alpha(d) + C); }) - half;
  });
  const double C = constant(unknown), d_edge = edge(unknown);
  const double within = integral(d_edge, [&](double d) {
    const double alpha = crack.alpha(d);
    return (2.0 * alpha + C) / std::sqrt(alpha + C);
  });
  // Beyond the edge: 2 int_0^d_edge sqrt(alpha) dd, as what is left of the integral to 1.
  const double whole = integral(0.0, [&](double d) { return std::sqrt(crack.alpha(d)); });
  const double rest = integral(d_edge, [&](double d) { return std::sqrt(crack.alpha(d)); });
  const double beyond = pinned ? 0.0 : 2.0 * ratio * (whole - rest);
  return (within + beyond) / crack.c0;
}

}  // namespace

double apparent_toughness(const CrackGeometry& crack, double Gc, double width, double ell, BandNeighbour one,
                          BandNeighbour other) {
  const double half = 0.5 * width / ell;
  return Gc * (half_dissipation(crack, one.Gc / Gc, half) + half_dissipation(crack, other.Gc / Gc, half));
}

double band_toughness(const CrackGeometry& crack, double wanted, double width, double ell, BandNeighbour one,
                      BandNeighbour other) {
  // Below a softer neighbour's the band's would have to be raised: never beyond ten times what is wanted.
  return root_of_falling(1e-3 * wanted, 10.0 * wanted,
                         [&](double Gc) { return wanted - apparent_toughness(crack, Gc, width, ell, one, other); });
}

}  // namespace pfdm
