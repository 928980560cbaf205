// [model] and [sample], read and written: what of mass_material_case.h is about the sample alone.

#include "cases/program/vibration/mass_material_case.h"

#include "cases/program/input/config/units.h"
#include "cases/program/vibration/mass_material_keys.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

Dimension beta_dimension(KernelForcing forcing) {
  if (forcing == KernelForcing::displacement) return beta_on_displacement();
  return forcing == KernelForcing::stiffness ? beta_on_stiffness() : stiffness_dimensions()[0];
}

std::vector<HereditaryTerm> read_kernel(const ConfigTable& model, const ModelStructure& structure) {
  std::vector<HereditaryTerm> kernel;
  for (const ConfigTable& term : model.tables("kernel")) {
    if (structure.forcing == KernelForcing::none)
      throw term.error(fmt::format("model \"{}\" has no kernel", structure.name));
    const Dimension beta = beta_dimension(structure.forcing);
    const std::complex<double> alpha(term.quantity("alpha"), term.quantity("alpha_imaginary", 0.0));
    kernel.push_back({alpha, {term.quantity("beta", beta), term.quantity("beta_imaginary", beta, range::any, 0.0)}});
    if (!kernel.back().is_pair() && kernel.back().beta.imag() != 0.0)
      throw term.error("a real alpha requires a real beta");
  }
  if (structure.kernel_order && static_cast<int>(kernel.size()) != *structure.kernel_order && !kernel.empty())
    throw model.error(fmt::format("model \"{}\" has {} kernel terms; {} are given", structure.name,
                                  *structure.kernel_order, kernel.size()));
  return kernel;
}

void read_sample(const ConfigTable& root, MassMaterialCase& c) {
  if (!root.has("sample")) return;
  const ConfigTable table = root.table("sample");
  if (!table.has("length") && !table.has("area")) return;
  c.sample = SampleSize{.length = table.quantity("length"), .area = table.quantity("area")};
}

/// A sample that is a bar in tension: k_1 = E A/L, and with a loss factor the damping c = eta (k_1 m)^(1/2), which
/// dissipates as much at the resonance of mass and k_1.
void read_modulus(const ConfigTable& table, MassMaterialCase& c) {
  const auto modulus = table.find("young_modulus"), loss = table.find("loss_factor");
  if (loss && !modulus) throw loss->error("the loss factor belongs to a \"young_modulus\", which is missing");
  if (!modulus) return;
  if (c.has_parameters) throw modulus->error("\"stiffness\" and \"young_modulus\" both give k_1: leave one out");
  if (!c.sample) throw modulus->error("Young's modulus needs the sample's length and area: [sample]");
  if (loss && table.has("damping")) throw loss->error("\"damping\" and \"loss_factor\" both give c: leave one out");
  c.model.stiffness = {modulus->quantity() * c.sample->area / c.sample->length};
  c.has_parameters = true;
  if (loss) c.model.damping = loss->number() * std::sqrt(c.model.stiffness.front() * c.model.mass);
}

void read_model(const ConfigTable& root, MassMaterialCase& c) {
  const ConfigTable table = root.table("model");
  const ModelStructure& structure = choose(table.at("structure"), model_structures(), "mass-material model");
  c.structure = structure.name;
  c.model.mass = table.quantity("mass");
  c.model.forcing = structure.forcing;
  c.model.reference_velocity = table.quantity("reference_velocity", 1.0);
  if (const auto lambda = table.find("damping_exponent")) {
    if (!structure.nonlinear_damping) throw lambda->error(fmt::format("model \"{}\" has none", structure.name));
    c.model.damping_exponent = lambda->number();
  }
  c.has_parameters = table.has("stiffness");
  if (const auto stiffness = table.find("stiffness")) {
    const auto list = stiffness->list();
    if (list.empty() || static_cast<int>(list.size()) > structure.stiffness_order)
      throw stiffness->error(fmt::format("model \"{}\" has from 1 to {} stiffness coefficients; {} are given",
                                         structure.name, structure.stiffness_order, list.size()));
    for (std::size_t i = 0; i < list.size(); ++i)
      c.model.stiffness.push_back(list[i].quantity(stiffness_dimensions()[i]));
    if (!(c.model.stiffness.front() > 0.0)) throw list.front().error("k_1 must be positive");
  }
  c.model.damping = table.quantity("damping", 0.0);
  read_modulus(table, c);
  c.model.kernel = read_kernel(table, structure);
}

std::string quantity(double value, std::string_view unit) { return fmt::format("\"{:.17g} {}\"", value, unit); }

std::string_view beta_unit(KernelForcing forcing) {
  if (forcing == KernelForcing::displacement) return "N/m/s";
  return forcing == KernelForcing::stiffness ? "s^-1" : "N/m";
}

}  // namespace

MassMaterialCase read_sample_model(const ConfigTable& root) {
  root.with_keys(mass_material_keys());
  MassMaterialCase c;
  read_sample(root, c);
  read_model(root, c);
  return c;
}

void require_parameters(const MassMaterialCase& c) {
  if (!c.has_parameters)
    throw InputError("[model] has no \"stiffness\": a run simulates a model with parameters; fit finds them");
  if (!(static_stiffness(c.model) > 0.0))
    throw InputError(fmt::format("[model] the static stiffness, kernel included, is {:.4g} N/m; it must be positive",
                                 static_stiffness(c.model)));
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

}  // namespace pfdm
