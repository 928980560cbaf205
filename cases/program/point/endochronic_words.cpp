#include "cases/program/point/endochronic_words.h"

#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

std::string in_unit_that_fits(double value, std::string_view si_unit, std::string_view rest) {
  const DisplayUnit unit = display_unit(value, si_unit);
  return fmt::format("{:.4g} {}{}", unit.factor * value, unit.name, rest);
}

/// Without a yield surface even the first strain is partly plastic.
void say_initial_slope(const EndochronicLaw& law, Log& log) {
  double C = 0.0;
  for (const KernelTerm& term : law.kernel) C += term.C;
  const double E = law.elasticity.young_modulus();
  const double slope = E * 3.0 * C / (E + 3.0 * C);
  log.say(fmt::format("tension begins with a slope of {}, {:.1f} % of Young's modulus (sum of C: {})",
                      stress_shown(slope), 100.0 * slope / E, stress_shown(C)));
}

}  // namespace

std::string stress_shown(double stress) { return in_unit_that_fits(stress, "Pa", ""); }

std::string energy_density_shown(double density) { return in_unit_that_fits(density, "J", "/m^3"); }

void say_law(const EndochronicLaw& law, Log& log) {
  for (const KernelTerm& term : law.kernel)
    log.say(fmt::format("  C {}, alpha {:.6g}", stress_shown(term.C), term.alpha));
  log.say(fmt::format("hardening {}, rate factor {}", law.hardening.with_path.law->name,
                      law.hardening.with_rate.law->name));
  const double radius = saturation_radius(law, 0.0, 0.0);
  if (std::isfinite(radius))
    log.say(fmt::format("before hardening tension saturates at {}", stress_shown(std::sqrt(1.5) * radius)));
  say_initial_slope(law, log);
}

namespace {

/// "stress xx from -212.6 MPa to 178.1 MPa", of each component.
std::vector<std::string> ranges_of_stress(const std::map<std::string, double>& figures) {
  constexpr std::string_view largest = "largest_stress_";
  std::vector<std::string> ranges;
  for (const auto& [name, value] : figures) {
    if (!name.starts_with(largest)) continue;
    const std::string component = name.substr(largest.size(), 2);
    ranges.push_back(fmt::format("stress {} from {} to {}", component,
                                 stress_shown(figures.at(fmt::format("least_stress_{}_Pa", component))),
                                 stress_shown(value)));
  }
  return ranges;
}

}  // namespace

std::vector<std::string> history_sentences(const std::map<std::string, double>& figures) {
  std::vector<std::string> parts = ranges_of_stress(figures);
  parts.push_back(fmt::format("von Mises stress at most {}", stress_shown(figures.at("largest_von_mises_stress_Pa"))));
  std::string stresses = fmt::format("{}.", fmt::join(parts, ", "));
  stresses.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(stresses.front())));
  return {std::move(stresses),
          fmt::format("Of {} of work {} are dissipated.", energy_density_shown(figures.at("external_work_J_per_m3")),
                      energy_density_shown(figures.at("dissipation_J_per_m3")))};
}

void say_history(const std::map<std::string, double>& figures, Log& log) {
  for (const std::string& range : ranges_of_stress(figures)) log.say("  " + range);
  log.say(fmt::format("  von Mises stress at most {}", stress_shown(figures.at("largest_von_mises_stress_Pa"))));
  const auto balance = figures.find("energy_balance_error");
  log.say(fmt::format("  work {}, dissipated {}{}", energy_density_shown(figures.at("external_work_J_per_m3")),
                      energy_density_shown(figures.at("dissipation_J_per_m3")),
                      balance == figures.end()
                          ? ""
                          : fmt::format("; the energy account is closed to {:.2g} %", 100.0 * balance->second)));
}

}  // namespace pfdm
