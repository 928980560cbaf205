#include "postproc/exports/given_law.h"

#include "physics/error.h"
#include "postproc/exports/law_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double end_of_law = 1e-3;  // part of the strength
constexpr double furthest = 50.0;    // toughness over strength
constexpr int samples = 4000;
constexpr double rigid = 1e6;  // over strength^2 / (2 toughness)

/// In opening, from 0 to where nearly nothing is left. Closer together where the law begins; with the end of a straight
/// rise and the points of a table.
std::vector<TractionPoint> states_of(const InterfaceLaw& law, const InterfaceStrength& at) {
  const double length = at.toughness / at.strength;
  std::vector<double> separations;
  for (int i = 0; i <= samples; ++i) separations.push_back(furthest * length * std::pow(double(i) / samples, 3.0));
  if (law.law->has_rise()) separations.push_back(at.strength / at.stiffness);
  if (law.law->name == tabulated_law().name)
    for (std::size_t i = 0; i + 1 < law.shape.size(); i += 2) separations.push_back(law.shape[i] * length);
  std::ranges::sort(separations);
  std::vector<TractionPoint> states;
  bool has_peaked = false;
  for (const double separation : separations) {
    const double T = law.respond(at, Vector::UnitX(), separation * Vector::UnitX(), {}).traction.x();
    has_peaked = has_peaked || T > (1.0 - end_of_law) * at.strength;
    if (has_peaked && T < end_of_law * at.strength) break;
    states.push_back({separation, T});
  }
  return states;
}

Figure chosen_or(const std::optional<double>& chosen, const char* option, const Figure& else_this) {
  return chosen ? Figure{*chosen, fmt::format("given ({})", option)} : else_this;
}

void add_modes(const GivenLaw& given, const ExportChoice& choice, ExportedLaw& law) {
  const InterfaceLaw& of = given.law;
  const bool by_mode = of.depends_on_mode();
  const std::string rule = fmt::format("of the case, {}", of.mixed_mode->name);
  law.shear_strength = chosen_or(choice.shear_strength, "--shear-strength",
                                 {by_mode ? given.at.shear_strength : of.shear_ratio * given.at.strength, rule});
  law.shear_energy =
      chosen_or(choice.shear_energy, "--shear-energy", {by_mode ? given.at.shear_toughness : given.at.toughness, rule});
  const bool as_here = of.mixed_mode->name == "benzeggagh_kenane";
  law.exponent =
      chosen_or(choice.exponent, "--exponent",
                as_here ? Figure{of.exponent, rule}
                        : Figure{2.0, law.shear_energy.value == law.energy.value
                                          ? "assumed; of no effect while GII = GI (else --exponent)"
                                          : fmt::format("assumed: the case mixes modes by {}", of.mixed_mode->name)});
}

}  // namespace

ExportedLaw law_to_export(const GivenLaw& given, const ExportChoice& choice) {
  if (choice.angle) throw InputError(fmt::format("--angle: the law of \"{}\" is the same everywhere", given.name));
  if (choice.energy)
    throw InputError(fmt::format("--energy: the toughness of \"{}\" is given by the case", given.name));
  InterfaceStrength at = given.at;
  if (given.law.law->has_rise() && !(at.stiffness > 0.0))
    at.stiffness = rigid * 0.5 * at.strength * at.strength / at.toughness;
  const std::vector<TractionPoint> states = states_of(given.law, at);
  ExportedLaw law;
  law.surface = given.name;
  law.origin = "law of the case";
  law.strength = {at.strength, "of the case"};
  law.energy = {at.toughness, "of the case"};
  const double compliance = given.at.stiffness > 0.0 ? 1.0 / given.at.stiffness : own_compliance(states, at.strength);
  law.stiffness = given.at.stiffness > 0.0 && !choice.stiffness ? Figure{given.at.stiffness, "of the case"}
                                                                : stiffness_of(law, compliance, choice);
  add_modes(given, choice, law);
  law.remarks = given.remarks;
  law.remarks.push_back(fmt::format("Law: {} ({}), modes by {}", given.law.law->name, given.law.law->description,
                                    given.law.mixed_mode->name));
  if (given.law.friction > 0.0)
    law.remarks.push_back(fmt::format("Friction {:g} of the case is not in this file", given.law.friction));
  law.remarks.push_back(fmt::format("Tables: of opening, up to {:.4g} m, where {:.2g} % of the strength are left",
                                    states.back().separation, 100.0 * states.back().traction / at.strength));
  add_tables(law, whole_curve(states, true, law, compliance));
  return law;
}

}  // namespace pfdm
