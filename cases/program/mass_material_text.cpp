// with_model() of mass_material_case.h.

#include "cases/program/mass_material_case.h"

#include <fmt/format.h>

#include <sstream>

namespace pfdm {
namespace {

std::string quantity(double value, std::string_view unit) { return fmt::format("\"{:.17g} {}\"", value, unit); }

std::string_view beta_unit(KernelForcing forcing) {
  if (forcing == KernelForcing::displacement) return "N/m/s";
  return forcing == KernelForcing::stiffness ? "s^-1" : "N/m";
}

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

bool opens_table(const std::string& line) { return line.starts_with("["); }
bool opens_model(const std::string& line) {
  return line.starts_with("[model]") || line.starts_with("[model.") || line.starts_with("[[model.");
}

}  // namespace

std::string with_model(const std::string& case_text, std::string_view structure, const MassMaterial& model) {
  std::istringstream lines(case_text);
  std::string result;
  bool within = false;
  bool written = false;
  for (std::string line; std::getline(lines, line);) {
    if (opens_table(line)) within = opens_model(line);
    if (within && !written) {
      result += model_text(structure, model);
      written = true;
    }
    if (!within) result += line + "\n";
  }
  return result;
}

}  // namespace pfdm
