#include "postproc/exports/law/exported_law.h"

#include "physics/angle.h"
#include "physics/error.h"
#include "postproc/exports/law/law_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pfdm {
namespace {

constexpr double loops =
    0.01;  // part of the work that unloading and reloading may leave between the record and its envelope

/// The part of a law that was seen in a row: its states of growing separation, up to where they end or leave a gap.
struct Known {
  std::vector<TractionPoint> states{};  // normal
  double work = 0.0;                    // int T ddelta of them [J/m^2]
  std::optional<double> gap{};  // separation at which the law is seen again with less than half its strength [m]
};

/// A gap is a fall by more than half the strength between two states, whether the columns broke at once or were
/// unloaded first and broke when they opened again.
Known known_part(const CohesiveResult& result) {
  Known known;
  for (const ColumnSample& s : result.law.states) {
    const TractionPoint state{s.separation[0], s.traction[0]};
    if (!known.states.empty()) {
      const TractionPoint& last = known.states.back();
      const bool rises = state.traction > last.traction;  // rigidly, with rounding for a separation
      if (state.separation <= last.separation && !rises) continue;
      if (last.traction - state.traction > 0.5 * result.figures.strength) {
        known.gap = state.separation;
        break;
      }
    }
    known.states.push_back(state);
  }
  known.work = area_under(known.states);
  return known;
}

double whole_work(const CohesiveLaw& law) {
  std::vector<TractionPoint> states;
  for (const ColumnSample& s : law.states) states.push_back({s.separation[0], s.traction[0]});
  return area_under(states);
}

enum class Extent {
  complete,  // its own area is its energy
  broken,    // seen up to a gap; what its columns dissipated is known
  open       // not to be completed from the record
};

struct Candidate {
  const ColumnRecord* record;
  const CohesiveResult* result;
  Known known;
  Extent extent;

  // In steps below which it tells no law from another.
  double mixity() const {
    const double mixity = result->figures.mixity_at_strength;
    return std::isnan(mixity) ? std::numeric_limits<double>::infinity() : std::floor(mixity / (5.0 * degree));
  }
  // So rounded that equal places of a symmetric case are equal; then the first counts.
  long share() const { return std::lround(1e6 * result->law.area / record->area()); }
  bool has_angle(double angle) const {
    return record->kind == SurfaceKind::plane || (angle >= result->law.from - 1e-9 && angle < result->law.to + 1e-9);
  }
};

Extent extent_of(const CohesiveResult& result, const Known& known) {
  const bool all_places_stable = std::isfinite(result.figures.normal_energy);
  const bool without_loops = std::abs(known.work - whole_work(result.law)) < loops * known.work;
  if (!known.gap && result.figures.is_traced() && all_places_stable && without_loops) return Extent::complete;
  return known.gap && result.law.states.back().largest_damage > debonded_damage ? Extent::broken : Extent::open;
}

/// Laws of mode I before others, in these the complete before the broken; the larger area.
bool goes_before(const Candidate& a, const Candidate& b) {
  const auto key = [](const Candidate& c) {
    return std::tuple(c.extent == Extent::open, c.mixity() >= 3.0, c.extent, c.mixity(), -c.share());
  };
  return key(a) < key(b);
}

std::vector<std::string> names_of(const CohesiveReport& report) {
  std::vector<std::string> names;
  for (const ColumnRecord& record : report.records)
    if (!record.is_cohesive) names.push_back(record.name);
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
      if (!(result.figures.strength > 0.0) || report.records[r].is_cohesive) continue;
      Candidate candidate{&report.records[r], &result, known_part(result), Extent::open};
      candidate.extent = extent_of(result, candidate.known);
      if ((!choice.surface || candidate.record->name == *choice.surface) &&
          (!choice.angle || candidate.has_angle(*choice.angle)))
        candidates.push_back(std::move(candidate));
    }
  if (candidates.empty())
    throw InputError(fmt::format(
        "no law to export{}: nothing there was damaged under tension; cohesive.json lists the laws there are",
        choice.angle ? fmt::format(" at {:g} degrees", *choice.angle / degree) : ""));
  return *std::ranges::min_element(candidates, goes_before);
}

std::string why_open(const Candidate& c) {
  const CohesiveFigures& f = c.result->figures;
  if (f.unloaded) return fmt::format("it was unloaded to {:.4g} Pa", f.final_traction);
  if (f.final_traction >= 0.1 * f.strength) return fmt::format("it carries {:.4g} Pa there", f.final_traction);
  return "some of its places broke at once, or were unloaded in between";
}

Figure energy_of(const Candidate& c, const ExportChoice& choice) {
  if (c.extent == Extent::complete) {
    if (choice.energy)
      throw InputError("--energy is for laws that are not known to their end; this one is, and its area is its energy");
    return {whole_work(c.result->law), "normal int T ddelta of the record"};
  }
  if (!choice.energy && c.extent == Extent::open)
    throw InputError(
        fmt::format("the law of \"{}\" is not known to its end ({}): give the interface's energy, as in --energy \"10 "
                    "J/m^2\", or run the case further",
                    c.record->name, why_open(c)));
  Figure whole = choice.energy ? Figure{*choice.energy, "given (--energy)"}
                               : Figure{c.result->figures.surface_energy,
                                        "surface energy that the columns dissipated, as the law is not seen to its end "
                                        "(else --energy)"};
  if (whole.value > c.known.work * (1.0 + least_drop)) return whole;
  return {c.known.work, fmt::format("work up to where the law is no longer seen, as {} ({:.4g} J/m^2) is not more",
                                    whole.basis, whole.value)};
}

/// A band whose energy drives its damage, confined by its neighbours, breaks where T_n^2/M + |T_t|^2/mu reaches a
/// value, and its separations are T_n/M and T_t/mu times one function of the damage.
Figure shear_strength_of(const CohesiveReport& report, const Candidate& c, const ExportChoice& choice) {
  const double strength = c.result->figures.strength;
  if (choice.shear_strength) return {*choice.shear_strength, "given (--shear-strength)"};
  const auto r = static_cast<std::size_t>(c.record - report.records.data());
  if (r < report.shear_ratios.size() && report.shear_ratios[r])
    return {*report.shear_ratios[r] * strength,
            fmt::format("(mu/M)^(1/2) = {:.4g} of the normal one, M the modulus of uniaxial strain: the energy of the "
                        "confined band drives its damage (else --shear-strength)",
                        *report.shear_ratios[r])};
  return {strength, "assumed, the normal one: not measured (else --shear-strength)"};
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

std::string seen(const Candidate& c, double energy) {
  const auto [last, traction] = c.known.states.back();
  const std::string range = fmt::format("seen from 0 to {:.4g} m ({:.4g} Pa)", last, traction);
  const double missing = energy - c.known.work;
  if (c.extent == Extent::complete)
    return fmt::format("{}, where {:.2g} % of the strength are left; cut there", range,
                       100.0 * std::max(0.0, traction) / c.result->figures.strength);
  if (!c.known.gap)
    return fmt::format("{}; beyond, a straight line of the energy that is missing, {:.3g} of {:.4g} J/m^2", range,
                       missing, energy);
  return fmt::format(
      "{}. From there to {:.4g} m, where the law is seen again with half the strength or less, it "
      "broke at once: not seen, completed by a straight line of the energy that is missing, {:.3g} of "
      "{:.4g} J/m^2",
      range, *c.known.gap, missing, energy);
}

std::vector<std::string> remarks_of(const CohesiveReport& report, const Candidate& c, double energy) {
  const CohesiveFigures& f = c.result->figures;
  const bool plane = c.record->kind == SurfaceKind::plane;
  return {
      fmt::format("pfdm {}, case {} ({}), cohesive_law.csv", report.version, report.case_name, report.case_hash),
      place_of(c),
      fmt::format("Frame: normal {}; opening and tension are positive; the two tangential directions are equal",
                  plane ? "of the plane" : "from the particle outwards"),
      "Range: " + seen(c, energy),
      fmt::format("Energies of the record: normal int T ddelta {:.6g} J/m^2 {}, surface energy of the columns {:.6g} "
                  "J/m^2",
                  c.known.work, c.extent == Extent::complete ? "in all" : "as far as it is seen", f.surface_energy),
      fmt::format(
          "Mode: |T_t|/T_n is tan({:.3g} degrees) at the strength, |T_t| at most {:.4g} Pa. Shear strength, GII "
          "and the exponent cannot be had from such a record",
          f.mixity_at_strength / degree, f.largest_tangential),
  };
}

}  // namespace

std::string_view name_of(ModeMix mix) {
  switch (mix) {
    case ModeMix::benzeggagh_kenane: return "Benzeggagh and Kenane's rule";
    case ModeMix::power_law: return "the power law";
    case ModeMix::one_energy: break;
  }
  return "Camacho and Ortiz' rule";
}

bool ExportedLaw::has_one_stiffness() const {
  constexpr double rounding = 1e-9;
  return std::abs(shear_stiffness.value - stiffness.value) <= rounding * stiffness.value;
}

ExportedLaw law_to_export(const CohesiveReport& report, const ExportChoice& choice) {
  const Candidate chosen = choose(report, choice);
  ExportedLaw law;
  law.surface = chosen.record->name;
  law.strength = {chosen.result->figures.strength, "largest normal traction of the record"};
  law.energy = energy_of(chosen, choice);
  const double compliance = own_compliance(chosen.known.states, law.strength.value);
  law.stiffness = stiffness_of(law, compliance, choice);
  law.shear_strength = shear_strength_of(report, chosen, choice);
  law.shear_energy = choice.shear_energy ? Figure{*choice.shear_energy, "given (--shear-energy)"}
                                         : Figure{law.energy.value,
                                                  "assumed, GI: the phase field has one toughness for all modes (else "
                                                  "--shear-energy)"};
  law.exponent = choice.exponent ? Figure{*choice.exponent, "given (--exponent)"}
                                 : Figure{2.0, "assumed; of no effect while GII = GI (else --exponent)"};
  law.mix = law.shear_energy.value == law.energy.value ? ModeMix::one_energy : ModeMix::benzeggagh_kenane;
  law.shear_stiffness = shear_stiffness_of(law);
  law.remarks = remarks_of(report, chosen, law.energy.value);
  add_tables(law, whole_curve(chosen.known.states, chosen.extent == Extent::complete, law, compliance));
  return law;
}

}  // namespace pfdm
