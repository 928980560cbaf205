// model_text() of mass_material_case.h.

#include "cases/program/vibration/mass_material_case.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

std::string quantity(double value, std::string_view unit) { return fmt::format("\"{:.17g} {}\"", value, unit); }

std::string_view beta_unit(KernelForcing forcing) {
  if (forcing == KernelForcing::displacement) return "N/m/s";
  return forcing == KernelForcing::stiffness ? "s^-1" : "N/m";
}

}  // namespace

std::string model_text(std::string_view structure, const MassMaterial& m) {
  std::string text = "[model]                            # found by pfdm fit\n";
  text += fmt::format("structure = \"{}\"\nmass = {}\n", structure, quantity(m.mass, "kg"));
  text += "stiffness = [";
  for (std::size_t i = 0; i < m.stiffness.size(); ++i)
    text +=
        fmt::format("{}{}", i > 0 ? ", " : "", quantity(m.stiffness[i], i == 0 ? "N/m" : fmt::format("N/m^{}", i + 1)));
  text += fmt::format("]\ndamping = {}\n", quantity(m.damping, "N s/m"));
  if (m.damping_exponent != 0.0)
    text += fmt::format("damping_exponent = {:.17g}\nreference_velocity = {}\n", m.damping_exponent,
                        quantity(m.reference_velocity, "m/s"));
  for (const HereditaryTerm& term : m.kernel) {
    text += "\n[[model.kernel]]\n";
    text += fmt::format("alpha = {}\nbeta = {}\n", quantity(term.alpha.real(), "s^-1"),
                        quantity(term.beta.real(), beta_unit(m.forcing)));
    if (term.is_pair())
      text += fmt::format("alpha_imaginary = {}\nbeta_imaginary = {}\n", quantity(term.alpha.imag(), "s^-1"),
                          quantity(term.beta.imag(), beta_unit(m.forcing)));
  }
  return text + "\n";
}

}  // namespace pfdm
