#include "physics/interfaces/traction_separation.h"

#include "physics/damage/softening_law.h"
#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Shape = std::span<const double>;
using Law = TractionSeparationLaw;

/// The straight rise, which takes a share of the energy, and what lies beyond it.
struct Rise {
  double end;     // separation at the strength [m]
  double slope;   // [Pa/m]
  double energy;  // that is left beyond it [J/m^2]

  Rise(double strength, double whole, double share)
      : end(2.0 * share * whole / strength), slope(strength / end), energy((1.0 - share) * whole) {}
  double work() const { return 0.5 * slope * end * end; }  // [J/m^2]
  bool holds(double separation) const { return separation < end; }
  LawPoint at(double separation) const { return {slope * separation, slope, 0.5 * slope * separation * separation}; }
};

LawPoint with_softening(const Law& law, double separation, double strength, double energy, Shape shape) {
  const Rise rise(strength, energy, shape[0]);
  separation = std::max(separation, 0.0);
  if (rise.holds(separation)) return rise.at(separation);
  const SofteningLaw& softening = softening_law(law.name);
  const double w = (separation - rise.end) * strength / rise.energy;
  return {strength * softening.traction(w), strength * strength / rise.energy * softening.slope(w),
          rise.work() + rise.energy * softening.work(w)};
}

LawPoint bilinear(const Law&, double separation, double strength, double energy, Shape shape) {
  const Rise rise(strength, energy, shape[0]);
  separation = std::max(separation, 0.0);
  if (rise.holds(separation)) return rise.at(separation);
  const double kink = shape[1] * strength, opening = separation - rise.end;
  const double to_kink = 2.0 * shape[2] * rise.energy / (strength + kink);
  if (opening < to_kink) {
    const double slope = (kink - strength) / to_kink;
    return {strength + slope * opening, slope, rise.work() + (strength + 0.5 * slope * opening) * opening};
  }
  const double to_end = 2.0 * (1.0 - shape[2]) * rise.energy / kink, x = (opening - to_kink) / to_end;
  if (x >= 1.0) return {0.0, 0.0, energy};
  return {kink * (1.0 - x), -kink / to_end, energy - 0.5 * kink * to_end * (1.0 - x) * (1.0 - x)};
}

LawPoint xu_needleman(const Law&, double separation, double strength, double energy, Shape) {
  const double per_length = strength * std::numbers::e / energy, x = per_length * std::max(separation, 0.0);
  const double decay = std::exp(-x);
  return {strength * std::numbers::e * x * decay, strength * std::numbers::e * per_length * (1.0 - x) * decay,
          energy * (-std::expm1(-x) - x * decay)};
}

// The work is Gc (1 - (1-x)^a (1 + a x/m)^m).
LawPoint ppr(const Law&, double separation, double strength, double energy, Shape shape) {
  const double a = shape[0], L = shape[1] / std::sqrt(a), m = a * (a - 1.0) * L * L / (1.0 - a * L * L);
  const auto form = [&](double x) {
    return (m + a) * x * std::pow(1.0 - x, a - 1.0) * std::pow(m / a + x, m - 1.0) * std::pow(a / m, m);
  };
  const double final_separation = energy * form(L) / strength, x = std::max(separation, 0.0) / final_separation;
  if (x >= 1.0) return {0.0, 0.0, energy};
  const double per_length = energy / final_separation;
  // d form/dx without the division by x
  const double relative = 1.0 - (a - 1.0) * x / (1.0 - x) + (m - 1.0) * x / (m / a + x);
  const double secant = (m + a) * std::pow(1.0 - x, a - 1.0) * std::pow(m / a + x, m - 1.0) * std::pow(a / m, m);
  return {per_length * form(x), per_length * secant * relative / final_separation,
          energy * (1.0 - std::pow(1.0 - x, a) * std::pow(1.0 + a * x / m, m))};
}

LawPoint between_points(const Law&, double separation, double strength, double energy, Shape shape) {
  const double x = std::max(separation, 0.0) * strength / energy;
  double work = 0.0;
  for (std::size_t i = 0; i + 3 < shape.size(); i += 2) {
    const double width = shape[i + 2] - shape[i], rise = shape[i + 3] - shape[i + 1];
    if (x < shape[i + 2]) {
      const double part = x - shape[i], y = shape[i + 1] + rise / width * part;
      return {strength * y, strength * strength / energy * rise / width,
              energy * (work + 0.5 * (shape[i + 1] + y) * part)};
    }
    work += 0.5 * (shape[i + 1] + shape[i + 3]) * width;
  }
  return {0.0, 0.0, energy * work};
}

double traction_of(const Law& law, double separation, double strength, double energy, Shape shape) {
  return separation > 0.0 ? law.at(law, separation, strength, energy, shape).traction : 0.0;
}

constexpr ShapeParameter rise{Law::rise_share, 0.02, 1e-6, 0.95};

std::vector<Law> make_table() {
  std::vector<Law> table;
  for (const SofteningLaw& law : softening_laws())
    table.push_back({law.name, law.description, {rise}, traction_of, with_softening});
  table.push_back({"bilinear",
                   "two straight lines, a kink between them",
                   {rise, {"kink_over_strength", 0.3, 0.02, 0.98}, {"share_before_kink", 0.5, 0.02, 0.98}},
                   traction_of,
                   bilinear});
  table.push_back({"xu_needleman",
                   "sigma_c (delta/delta_0) exp(1 - delta/delta_0), Gc = e sigma_c delta_0",
                   {},
                   traction_of,
                   xu_needleman});
  table.push_back({"ppr",
                   "Park, Paulino, Roesler's potential in mode I",
                   {{"alpha", 3.0, 1.05, 50.0}, {"peak_over_limit", 0.3, 0.005, 0.99}},
                   traction_of,
                   ppr});
  return table;
}

}  // namespace

std::span<const TractionSeparationLaw> traction_separation_laws() {
  static const std::vector<Law> table = make_table();
  return table;
}

const TractionSeparationLaw& tabulated_law() {
  static const Law law{"table", "straight lines between points", {}, traction_of, between_points};
  return law;
}

TabulatedPoints tabulate(std::span<const double> separation, std::span<const double> traction) {
  std::vector<double> x(separation.begin(), separation.end()), y(traction.begin(), traction.end());
  if (x.size() != y.size() || x.size() < 2) throw InputError("a tabulated law needs two points at least");
  if (x.front() > 0.0) x.insert(x.begin(), 0.0), y.insert(y.begin(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0 ? !(x[i] > x[i - 1]) : x[i] != 0.0)
      throw InputError(fmt::format("point {} of a tabulated law: the separations have to rise from zero, found {}",
                                   i + 1, quantity_text(x[i], "m", 6)));
    if (!(y[i] >= 0.0))
      throw InputError(
          fmt::format("point {} of a tabulated law: traction {} is negative", i + 1, quantity_text(y[i], "Pa", 6)));
  }
  if (y[0] != 0.0 || !(y[1] > 0.0))
    throw InputError(
        fmt::format("a tabulated law begins with the traction 0 at the separation 0 and rises; found {}, then {}",
                    quantity_text(y[0], "Pa", 6), quantity_text(y[1], "Pa", 6)));
  TabulatedPoints points{.strength = *std::ranges::max_element(y), .energy = 0.0, .shape = {}};
  for (std::size_t i = 1; i < x.size(); ++i) points.energy += 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.shape.push_back(x[i] * points.strength / points.energy);
    points.shape.push_back(y[i] / points.strength);
  }
  return points;
}

}  // namespace pfdm
