#include "cases/program/viscoelastic/viscoelastic_fit_case.h"

#include "cases/program/input/config/heat_units.h"
#include "cases/program/studies/fit/material_tests.h"
#include "cases/program/viscoelastic/viscoelastic_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace pfdm {
namespace {

ViscoelasticChoice read_estimated(const ConfigTable& fit, bool has_shift) {
  ViscoelasticChoice choice;
  choice.times = fit.choice("times", "free") == "free";
  choice.shift = has_shift;
  const auto list = fit.find("estimate");
  if (!list) return choice;
  choice.shift = false;
  choice.young_modulus = choice.moduli = false;
  for (const ConfigValue& entry : list->list()) {
    const std::string name = entry.choice();
    choice.young_modulus |= name == "young_modulus";
    choice.moduli |= name == "shear_branches";
    choice.poisson_ratio |= name == "poisson_ratio";
    choice.shift |= name == "temperature_shift";
    if (name == "temperature_shift" && !has_shift)
      throw entry.error("[material] has no temperature_shift to begin with");
  }
  choice.times = choice.times && choice.moduli;
  return choice;
}

void read_numbers_of_branches(const ConfigTable& fit, const PronyLaw& law, ViscoelasticSettings& settings) {
  if (!fit.has("branches")) {
    if (settings.choice.moduli && law.shear.empty())
      throw fit.error("[material] has no shear_branches to begin with: branches = [1, 6] tries one to six");
    return;
  }
  const ConfigValue range = fit.at("branches");
  if (!settings.choice.moduli) throw range.error("shear_branches are not estimated");
  const auto ends = range.list(2);
  settings.least_branches = static_cast<int>(ends[0].integer());
  settings.most_branches = static_cast<int>(ends[1].integer());
  if (settings.least_branches > settings.most_branches)
    throw range.error("the first number of branches is larger than the second");
}

/// Branches are numbered by rising times.
void require_rising_times(const ConfigTable& fit, const ViscoelasticSettings& settings) {
  const auto number = [](const FitParameter& p) { return std::stoi(p.name.substr(p.name.find('_') + 1)); };
  for (const FitParameter& a : settings.limits)
    for (const FitParameter& b : settings.limits)
      if (a.name.starts_with("time_") && b.name.starts_with("time_") && number(a) < number(b) && b.upper <= a.lower)
        throw fit.table("bounds").at(b.name).error(fmt::format(
            "branches are numbered by rising times: {} must reach beyond the lower bound of {}", b.name, a.name));
}

/// [fit.bounds] modulus_1 = ["0.1 MPa", "10 MPa"], time_1 = ["1 ms", "1 s"] ...
void read_limits(const ConfigTable& fit, const PronyLaw& law, ViscoelasticSettings& settings) {
  if (!fit.has("bounds")) return;
  PronyLaw longest = law;
  while (std::ssize(longest.shear) < settings.most_branches) longest.shear.push_back({1.0, 1.0});
  settings.limits = read_fit_bounds(
      fit, fit_parameters(longest, settings.choice, {}), [](const FitParameter& p, const ConfigValue& end) {
        if (p.unit == "1") return end.number(p.name == "poisson_ratio" ? range::poisson_ratio : range::positive);
        const Dimension& due = p.unit == "Pa"  ? dimension::stress
                               : p.unit == "s" ? dimension::time
                               : p.unit == "K" ? dimension::temperature_difference
                                               : dimension::molar_energy;
        return end.quantity(due, range::positive);
      });
  require_rising_times(fit, settings);
}

void require_noise_of_all_or_none(const ConfigTable& fit, const ViscoelasticExperiments& experiments) {
  std::size_t with = 0, all = 0;
  for (const ViscoelasticExperiment& experiment : experiments)
    for (const ViscoelasticExperiment::Channel& channel : experiment.channels)
      ++all, with += channel.noise > 0.0 || channel.relative_noise > 0.0 ? 1 : 0;
  require_noise_of_all_or_none(fit, with, all, "columns");
}

/// A shift and temperatures go together; its constants need enough of these.
void require_temperatures(const ConfigTable& fit, const ViscoelasticFitCase& read) {
  const bool has_shift = read.first.shift.has_value();
  const std::vector<ConfigTable> tests = fit.tables("experiments");
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const bool is_known = !read.experiments[i].temperatures.empty();
    if (is_known && !has_shift)
      throw tests[i]
          .at("temperature")
          .error(
              "tests at a temperature need temperature_shift in [material], as in temperature_shift = { law = \"wlf\", "
              "reference = \"25 degC\", C1 = 8.9, C2 = \"101.6 K\" }");
    if (!is_known && has_shift)
      throw tests[i].error(
          "the material has a temperature_shift: the test needs its temperature, as in temperature = "
          "\"40 degC\"");
  }
  if (!read.settings.choice.shift) return;
  const std::size_t n = n_temperatures(read.experiments);
  const bool is_wlf = read.first.shift->law == TemperatureShift::Law::wlf;
  if (n < (is_wlf ? 3U : 2U))
    throw fit.error(fmt::format(
        "tests at {} temperature{} do not determine {}; estimate = [\"young_modulus\", \"shear_branches\"] keeps {}", n,
        n == 1 ? "" : "s", is_wlf ? "C1 and C2 of WLF, which need three" : "an activation energy, which needs two",
        is_wlf ? "them" : "it"));
}

}  // namespace

ViscoelasticFitCase read_viscoelastic_fit(const ConfigTable& fit, const PronyLaw& law,
                                          const std::filesystem::path& case_directory) {
  ViscoelasticFitCase result;
  result.first = law;
  result.settings.choice = read_estimated(fit, law.shift.has_value());
  read_numbers_of_branches(fit, law, result.settings);
  read_limits(fit, law, result.settings);
  for (const ConfigTable& test : fit.tables("experiments")) {
    for (const ViscoelasticExperiment& other : result.experiments) require_own_file(test, other.name);
    result.experiments.push_back(read_viscoelastic_test(test, case_directory));
    result.data_files.push_back(case_directory / test.string("csv"));
  }
  if (result.experiments.empty()) throw fit.at("experiments").error("at least one of [[fit.experiments]] is required");
  require_temperatures(fit, result);
  require_noise_of_all_or_none(fit, result.experiments);
  return result;
}

}  // namespace pfdm
