#include "postproc/exports/exported_law.h"

#include "physics/angle.h"
#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pfdm {
namespace {

constexpr double rise_share = 0.01;      // of the final separation, that the rule for K gives to the rise
constexpr double least_traction = 0.02;  // part of the strength below which a secant is rounding
constexpr double least_drop = 1e-3;      // part of the separation within which a cut law falls to zero

struct Candidate {
  const ColumnRecord* record;
  const CohesiveResult* result;

  bool is_traced() const { return result->figures.is_traced(); }
  // Traced before broken by a jump before not known to its end.
  int rank() const { return is_traced() ? 0 : result->figures.jump ? 1 : 2; }
  // In steps below which it tells no law from another.
  double mixity() const {
    const double mixity = result->figures.mixity_at_strength;
    return std::isnan(mixity) ? std::numeric_limits<double>::infinity() : std::floor(mixity / (5.0 * degree));
  }
  bool has_angle(double angle) const {
    return record->kind == SurfaceKind::plane || (angle >= result->law.from - 1e-9 && angle < result->law.to + 1e-9);
  }
};

std::vector<std::string> names_of(const CohesiveReport& report) {
  std::vector<std::string> names;
  for (const ColumnRecord& record : report.records) names.push_back(record.name);
  return names;
}

Candidate choose(const CohesiveReport& report, const ExportChoice& choice) {
  const std::vector<std::string> names = names_of(report);
  if (choice.surface && std::ranges::count(names, *choice.surface) == 0)
    throw InputError(
        fmt::format("--surface: there is no surface \"{}\" (available: {})", *choice.surface, fmt::join(names, ", ")));
  std::vector<Candidate> candidates;
  for (std::size_t r = 0; r < report.records.size(); ++r)
    for (const CohesiveResult& result : report.results[r]) {
      const Candidate candidate{&report.records[r], &result};
      const bool wanted = (!choice.surface || candidate.record->name == *choice.surface) &&
                          (!choice.angle || candidate.has_angle(*choice.angle));
      if (wanted && result.figures.strength > 0.0) candidates.push_back(candidate);
    }
  if (candidates.empty())
    throw InputError(fmt::format(
        "no law to export{}: nothing there was damaged under tension; cohesive.json lists the laws there are",
        choice.angle ? fmt::format(" at {:g} degrees", *choice.angle / degree) : ""));
  return *std::ranges::min_element(candidates, [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.rank(), a.mixity(), -a.result->law.area) <
           std::tuple(b.rank(), b.mixity(), -b.result->law.area);
  });
}

/// Of the states that are known in a row: all, those before the jump, or those up to the widest opening.
std::size_t end_of_known(const Candidate& c) {
  const std::vector<ColumnSample>& states = c.result->law.states;
  if (c.result->figures.jump) return *c.result->figures.jump;
  if (c.is_traced()) return states.size();
  const auto widest = std::ranges::max_element(states, {}, [](const ColumnSample& s) { return s.separation[0]; });
  return static_cast<std::size_t>(widest - states.begin()) + 1;
}

struct Known {
  std::vector<TractionPoint> states;  // normal
  double work = 0.0;                  // int T ddelta [J/m^2]
  std::size_t peak = 0;
};

Known known_part(const Candidate& c) {
  Known known;
  for (std::size_t i = 0; i < end_of_known(c); ++i) {
    const ColumnSample& s = c.result->law.states[i];
    known.states.push_back({s.separation[0], s.traction[0]});
  }
  known.work = area_under(known.states);
  known.peak = static_cast<std::size_t>(std::ranges::max_element(known.states, {}, &TractionPoint::traction) -
                                        known.states.begin());
  return known;
}

/// Of the straight beginning [m/Pa]; zero for a rigid rise.
double own_compliance(const Known& known, double strength) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i <= known.peak; ++i)
    if (const auto [separation, traction] = known.states[i]; traction >= least_traction * strength)
      least = std::min(least, std::max(0.0, separation) / traction);
  return std::isfinite(least) ? least : 0.0;
}

Figure energy_of(const Candidate& c, const Known& known, const ExportChoice& choice) {
  if (c.is_traced()) {
    if (choice.energy)
      throw InputError("--energy is for laws that are not known to their end; this one is, and its area is its energy");
    return {known.work, "normal int T ddelta of the record"};
  }
  if (!choice.energy && !c.result->figures.jump)
    throw InputError(fmt::format(
        "the law of \"{}\" is not known to its end (it {} {:.4g} Pa there): give the interface's energy, as "
        "in --energy \"10 J/m^2\", or run the case further",
        c.record->name, c.result->figures.unloaded ? "was unloaded to" : "carries", c.result->figures.final_traction));
  const Figure whole = choice.energy
                           ? Figure{*choice.energy, "given (--energy)"}
                           : Figure{c.result->figures.surface_energy,
                                    "surface energy that the columns dissipated, as the law is not seen to its end "
                                    "(else --energy)"};
  if (whole.value > known.work * (1.0 + least_drop)) return whole;
  return {known.work, fmt::format("work up to where the law is no longer seen, as {} ({:.4g} J/m^2) is not more",
                                  whole.basis, whole.value)};
}

Figure stiffness_of(const ExportedLaw& law, double compliance, const ExportChoice& choice) {
  const double strength = law.strength.value, energy = law.energy.value;
  const double least = 0.5 * strength * strength / energy;  // its rise takes the whole energy
  if (choice.stiffness) {
    if (*choice.stiffness > least) return {*choice.stiffness, "given (--stiffness)"};
    throw InputError(fmt::format("--stiffness {:.4g} Pa/m: the law needs more than strength^2 / (2 GI) = {:.4g} Pa/m",
                                 *choice.stiffness, least));
  }
  const double rule = least / rise_share;
  const double value = 1.0 / (1.0 / rule + compliance);
  return {std::max(value, 1.02 * least),
          compliance * rule < 1e-3 ? "rule: 50 strength^2/GI (else --stiffness)"
                                   : "rule: 50 strength^2/GI in series with the law's own rise (else --stiffness)"};
}

/// With the penalty stiffness in series, and to zero traction at its end: at once where the law is known to its end,
/// else along a line of the energy that is missing.
std::vector<TractionPoint> whole_curve(const Candidate& c, const Known& known, const ExportedLaw& law,
                                       double compliance) {
  const double K = law.stiffness.value, shift = 1.0 / K - compliance;
  std::vector<TractionPoint> curve{{0.0, 0.0}};
  for (std::size_t i = 0; i < known.states.size(); ++i) {
    const double T = known.states[i].traction;
    if (T <= 0.0 && i < known.peak) continue;
    if (T <= 1e-6 * law.strength.value) break;
    const double separation = std::max(std::max(0.0, known.states[i].separation) + shift * T, T / K);
    if (separation > curve.back().separation) curve.push_back({separation, T});
  }
  const TractionPoint last = curve.back();
  double fall = least_drop * last.separation;
  if (!c.is_traced()) fall = std::max(fall, 2.0 * (law.energy.value - area_under(curve)) / last.traction);
  curve.push_back({last.separation + fall, 0.0});
  return curve;
}

void add_tables(ExportedLaw& law, const std::vector<TractionPoint>& whole) {
  const double K = law.stiffness.value, strength = law.strength.value;
  law.curve = simplified(whole, table_tolerance * strength);
  law.damage = damage_table(law.curve, K, table_tolerance * strength);
  law.initiation = K * law.damage.front().separation;
  for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
    const auto [separation, traction] = whole[i];
    law.curve_error = std::max(law.curve_error, std::abs(traction_at(law.curve, separation) - traction) / strength);
    law.damage_error =
        std::max(law.damage_error, std::abs(traction_at(law.damage, K, separation) - traction) / strength);
  }
}

std::string place_of(const Candidate& c) {
  const CohesiveLaw& law = c.result->law;
  const std::string where = c.record->kind == SurfaceKind::plane
                                ? std::string("mean of the plane")
                                : fmt::format("polar angles {:.0f} to {:.0f} degrees from the direction of the load",
                                              law.from / degree, law.to / degree);
  return fmt::format("surface \"{}\", {}: {} of {} places, {:.4g} m^2", c.record->name, where, law.places.size(),
                     c.record->places.size(), law.area);
}

std::string seen(const Candidate& c, const Known& known, double energy) {
  const CohesiveFigures& f = c.result->figures;
  const std::vector<ColumnSample>& states = c.result->law.states;
  const double last = known.states.back().separation, traction = known.states.back().traction;
  if (f.jump)
    return fmt::format(
        "seen from 0 to {:.4g} m ({:.4g} Pa). From there to {:.4g} m the columns broke at once: not seen, "
        "completed by a straight line of the energy that is missing, {:.3g} of {:.3g} J/m^2",
        last, traction, states[*f.jump].separation[0], energy - known.work, energy);
  if (!c.is_traced())
    return fmt::format("seen from 0 to {:.4g} m ({:.4g} Pa); beyond a straight line of the energy that is missing",
                       last, traction);
  return fmt::format("seen from 0 to {:.4g} m, where {:.2g} % of the strength are left; cut there", last,
                     100.0 * std::max(0.0, traction) / f.strength);
}

std::vector<std::string> remarks_of(const CohesiveReport& report, const Candidate& c, const Known& known,
                                    double energy) {
  const CohesiveFigures& f = c.result->figures;
  const bool plane = c.record->kind == SurfaceKind::plane;
  return {
      fmt::format("pfdm {}, case {} ({}), cohesive_law.csv", report.version, report.case_name, report.case_hash),
      place_of(c),
      fmt::format("Frame: normal {}; opening and tension are positive; the two tangential directions are equal",
                  plane ? "of the plane" : "from the particle outwards"),
      "Range: " + seen(c, known, energy),
      fmt::format("Energies of the record: normal int T ddelta {:.6g} J/m^2 {}, surface energy of the columns {:.6g} "
                  "J/m^2",
                  known.work, f.jump ? "before the jump" : "in all", f.surface_energy),
      fmt::format(
          "Mode: |T_t|/T_n is tan({:.3g} degrees) at the strength, |T_t| at most {:.4g} Pa. Shear strength, GII "
          "and the exponent cannot be had from such a record",
          f.mixity_at_strength / degree, f.largest_tangential),
  };
}

}  // namespace

ExportedLaw law_to_export(const CohesiveReport& report, const ExportChoice& choice) {
  const Candidate chosen = choose(report, choice);
  const Known known = known_part(chosen);
  ExportedLaw law;
  law.surface = chosen.record->name;
  law.strength = {chosen.result->figures.strength, "largest normal traction of the record"};
  law.energy = energy_of(chosen, known, choice);
  const double compliance = own_compliance(known, law.strength.value);
  law.stiffness = stiffness_of(law, compliance, choice);
  law.shear_strength = choice.shear_strength ? Figure{*choice.shear_strength, "given (--shear-strength)"}
                                             : Figure{law.strength.value,
                                                      "assumed, the normal one: not measured (else --shear-strength)"};
  law.shear_energy = choice.shear_energy ? Figure{*choice.shear_energy, "given (--shear-energy)"}
                                         : Figure{law.energy.value,
                                                  "assumed, GI: the phase field has one toughness for all modes (else "
                                                  "--shear-energy)"};
  law.exponent = choice.exponent ? Figure{*choice.exponent, "given (--exponent)"}
                                 : Figure{2.0, "assumed; of no effect while GII = GI (else --exponent)"};
  law.remarks = remarks_of(report, chosen, known, law.energy.value);
  add_tables(law, whole_curve(chosen, known, law, compliance));
  return law;
}

}  // namespace pfdm
