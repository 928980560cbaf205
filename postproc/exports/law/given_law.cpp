#include "postproc/exports/law/given_law.h"

#include "physics/error.h"
#include "postproc/exports/law/law_parts.h"

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

/// The rule of the case, or what comes nearest to it. With one stiffness and a shear toughness of b^2 GI the strengths
/// and energies mix as by the power law of exponent 1.
ModeMix mix_of(const MixedMode& rule) {
  if (rule.name == "benzeggagh_kenane" || rule.is_potential) return ModeMix::benzeggagh_kenane;
  return rule.name == "camacho_ortiz" ? ModeMix::one_energy : ModeMix::power_law;
}

Figure exponent_of(const InterfaceLaw& law, const std::string& rule, bool one_energy) {
  if (law.depends_on_mode()) return {law.exponent, rule};
  if (law.mixed_mode->keeps_stiffness) return {1.0, rule};
  return {2.0, one_energy ? std::string("assumed; of no effect while GII = GI (else --exponent)")
                          : fmt::format("assumed: the case mixes modes by {} (else --exponent)", law.mixed_mode->name)};
}

/// The strengths and energies of both modes; before the stiffness.
void add_modes(const GivenLaw& given, const ExportChoice& choice, ExportedLaw& law) {
  const InterfaceLaw& of = given.law;
  const MixedMode& mode = *of.mixed_mode;
  const std::string rule = fmt::format("of the case, {}", mode.name);
  const double b = of.shear_ratio;
  law.rule = mode.name;
  law.mix = mix_of(mode);
  law.shear_strength = chosen_or(choice.shear_strength, "--shear-strength",
                                 {mode.has_shear_strength() ? given.at.shear_strength : b * given.at.strength, rule});
  law.shear_energy = chosen_or(
      choice.shear_energy, "--shear-energy",
      {mode.has_shear_strength() ? given.at.shear_toughness : (mode.keeps_stiffness ? b * b : 1.0) * given.at.toughness,
       rule});
  const bool one_energy = law.shear_energy.value == law.energy.value;
  if (law.mix == ModeMix::one_energy && !one_energy) law.mix = ModeMix::benzeggagh_kenane;
  law.exponent = chosen_or(choice.exponent, "--exponent", exponent_of(of, rule, one_energy));
}

/// In shear; after the stiffness.
void add_shear_stiffness(const GivenLaw& given, ExportedLaw& law) {
  law.shear_stiffness = shear_stiffness_of(law);
  if (!given.law.mixed_mode->is_potential) return;
  const double ratio = given.law.initial_shear_stiffness(given.at) / given.law.initial_stiffness(given.at);
  law.shear_stiffness = {ratio * law.stiffness.value, "that of the potential over its normal one, times the stiffness"};
  law.remarks.emplace_back(
      "Modes: Xu and Needleman's potential has no counterpart; strengths and energies of the two modes are its own, "
      "between them they are mixed otherwise");
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
  add_modes(given, choice, law);
  const double compliance = given.at.stiffness > 0.0 ? 1.0 / given.at.stiffness : own_compliance(states, at.strength);
  law.stiffness = given.at.stiffness > 0.0 && !choice.stiffness ? Figure{given.at.stiffness, "of the case"}
                                                                : stiffness_of(law, compliance, choice);
  law.remarks = given.remarks;
  add_shear_stiffness(given, law);
  law.remarks.push_back(fmt::format("Law: {} ({}), modes by {}", given.law.law->name, given.law.law->description,
                                    given.law.mixed_mode->name));
  if (given.law.friction > 0.0)
    law.remarks.push_back(fmt::format("Friction {:g} of the case is not in this file", given.law.friction));
  if (given.law.rate.any())
    law.remarks.push_back(
        fmt::format("Rate: {} of the case, {}, is not in this file, which has the law of slow opening",
                    given.law.rate.law->name, given.law.rate.law->description));
  if (!given.law.branches.empty())
    law.remarks.push_back(
        fmt::format("Rate: {} Maxwell branches of the case are not in this file, which has the law of slow opening",
                    given.law.branches.size()));
  law.remarks.push_back(fmt::format("Tables: of opening, up to {:.4g} m, where {:.2g} % of the strength are left",
                                    states.back().separation, 100.0 * states.back().traction / at.strength));
  add_tables(law, whole_curve(states, true, law, compliance));
  return law;
}

}  // namespace pfdm
