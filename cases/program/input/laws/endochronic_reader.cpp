#include "cases/program/input/laws/endochronic_reader.h"

#include "cases/program/input/laws/law_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfdm {
namespace {

Kernel read_kernel(const ConfigTable& material) {
  Kernel kernel;
  for (const ConfigTable& term : material.tables("kernel")) {
    kernel.push_back({term.quantity("C"), term.number("alpha")});
  }
  if (kernel.empty())
    throw material.error("\"kernel\" needs at least one term, as in kernel = [{ C = \"60 GPa\", alpha = 3000 }]");
  return kernel;
}

std::vector<double> read_points(const ConfigTable& table) {
  std::vector<double> zeta, f;
  for (const ConfigValue& point : table.at("points").list()) {
    const auto pair = point.list(2);
    zeta.push_back(pair[0].number());
    f.push_back(pair[1].number());
  }
  zeta.insert(zeta.end(), f.begin(), f.end());
  return zeta;
}

/// A row of f for each rate.
std::vector<double> read_rate_table(const ConfigTable& table) {
  std::vector<double> zeta, rate, f;
  for (const ConfigValue& value : table.at("zeta").list()) zeta.push_back(value.number());
  for (const ConfigValue& value : table.at("rate").list()) rate.push_back(value.quantity());
  const auto rows = table.at("f").list(rate.size());
  for (const ConfigValue& row : rows)
    for (const ConfigValue& value : row.list(zeta.size())) f.push_back(value.number());
  return rate_table_parameters(std::move(zeta), rate, f);
}

Factor read_factor(const ConfigTable& material, std::string_view key, std::span<const FactorLaw> laws,
                   const FactorLaw& otherwise, std::string_view what) {
  if (!material.has(key)) return make_factor(otherwise, {});
  const ConfigTable table = material.table(key);
  const FactorLaw& law = choose(table.at("law"), laws, what);
  std::vector<double> p;
  if (law.tabulated) p = law.of_path_and_rate != nullptr ? read_rate_table(table) : read_points(table);
  for (const LawParameter& due : law.parameters) p.push_back(read_law_parameter(table, due));
  return table.in_context([&] { return make_factor(law, p); });
}

std::string rate_table_toml(std::span<const double> p) {
  const RateTable table = rate_table(p);
  std::vector<std::string> rates, rows;
  for (std::size_t i = 0; i < table.rate.size(); ++i) {
    rates.push_back(fmt::format("\"{} 1/s\"", table.rate[i]));
    rows.push_back(fmt::format("[{}]", fmt::join(table.f.subspan(table.at(i, 0), table.zeta.size()), ", ")));
  }
  return fmt::format("zeta = [{}]\nrate = [{}]\nf = [\n  {},\n]\n", fmt::join(table.zeta, ", "), fmt::join(rates, ", "),
                     fmt::join(rows, ",\n  "));
}

std::string factor_toml(std::string_view key, const Factor& factor) {
  std::string text = fmt::format("\n[material.{}]\nlaw = \"{}\"\n", key, factor.law->name);
  if (factor.law->of_path_and_rate != nullptr) return text + rate_table_toml(factor.p);
  if (factor.law->tabulated) {
    const std::size_t n = factor.p.size() / 2;
    std::vector<std::string> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(fmt::format("[{}, {}]", factor.p[i], factor.p[n + i]));
    return text + fmt::format("points = [{}]\n", fmt::join(points, ", "));
  }
  for (std::size_t i = 0; i < factor.p.size(); ++i) {
    const LawParameter& due = factor.law->parameters[i];
    text += due.unit == "1" ? fmt::format("{} = {}\n", due.name, factor.p[i])
                            : fmt::format("{} = \"{} {}\"\n", due.name, factor.p[i], due.unit);
  }
  return text;
}

}  // namespace

EndochronicLaw read_endochronic_law(const ConfigTable& material) {
  EndochronicLaw law;
  const double E = material.quantity("young_modulus");
  law.elasticity = from_young_poisson(E, material.number("poisson_ratio"));
  law.kernel = read_kernel(material);
  law.hardening.with_path =
      read_factor(material, "hardening", hardening_laws(), hardening_law("constant"), "hardening law");
  law.hardening.with_rate = read_factor(material, "rate", rate_factors(), rate_factor("none"), "rate factor");
  law.beta = material.number("beta", law.beta);
  material.in_context([&] {
    check(law);
    return 0;
  });
  return law;
}

std::string to_toml(const EndochronicLaw& law) {
  std::vector<std::string> terms;
  for (const auto& [C, alpha] : law.kernel) terms.push_back(fmt::format("{{ C = \"{} Pa\", alpha = {} }}", C, alpha));
  return fmt::format("[material]\nyoung_modulus = \"{} Pa\"\npoisson_ratio = {}\nbeta = {}\nkernel = [\n  {},\n]\n",
                     law.elasticity.young_modulus(), law.elasticity.poisson_ratio(), law.beta,
                     fmt::join(terms, ",\n  ")) +
         factor_toml("hardening", law.hardening.with_path) + factor_toml("rate", law.hardening.with_rate);
}

}  // namespace pfdm
