// The endochronic law in process: parameters as case.toml has them, and what a material point goes through.

#include "physics/point/endochronic.h"

#include "cases/program/input/case_files/case_override.h"
#include "cases/program/input/laws/endochronic_reader.h"
#include "cases/program/point/endochronic_case.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "cases/python/extension/arrays.h"
#include "cases/python/extension/module.h"
#include "postproc/point/history_csv.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

/// material = { ... }
EndochronicLaw law_of_text(const std::string& toml) {
  const Config config(toml, "Endochronic", BareNumbers::in_si);
  return read_endochronic_law(config.root().with_keys(endochronic_case_keys()).table("material"));
}

EndochronicLaw law_of_case(const std::filesystem::path& where, const std::vector<std::string>& values) {
  const CaseFile file = with_overrides(open_case(where), values);
  const ConfigValue kind = file.config.root().at("kind");
  if (kind.string() != "endochronic") throw kind.error(fmt::format("\"{}\" is not \"endochronic\"", kind.string()));
  return read_endochronic_case(file.config.root(), file.directory).law;
}

void require_times(const std::vector<double>& times) {
  if (times.size() < 2 || times.front() != 0.0) throw InputError("time: at least two times are expected, from 0 on");
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]) || !std::isfinite(times[i]))
      throw InputError(fmt::format("time[{}]: {} s does not come after {} s", i, times[i], times[i - 1]));
}

using Prescribed = std::vector<std::pair<std::string, ArrayOf<double>>>;

/// Pairs of stress and strain that nothing is said about are free of stress.
LoadSegment segment_of(const EndochronicLaw& law, const Prescribed& prescribed, std::vector<double> times) {
  require_times(times);
  LoadSegment segment;
  std::array<bool, 6> named{};
  std::vector<LoadSegment::Condition> conditions;
  for (const auto& [name, array] : prescribed) {
    const ControlledComponent component = controlled_component(name);
    std::vector<double> values = numbers_of(array, name);
    if (values.size() != times.size())
      throw InputError(fmt::format("{}: {} values are given for {} times", name, values.size(), times.size()));
    for (const double value : values)
      if (!std::isfinite(value)) throw InputError(fmt::format("{}: its values must be finite", name));
    conditions.push_back({component.condition, Pace::follow, std::move(values)});
    named[static_cast<std::size_t>(component.pair)] = true;
  }
  for (std::size_t k = 0; k < 6; ++k)
    if (!named[k])
      conditions.push_back(
          {controlled_component(fmt::format("stress_{}", component_names[k])).condition, Pace::ramp, {0.0}});
  if (conditions.size() != 6)
    throw InputError("stress and strain of one pair of indices are both given: each pair takes one of them");
  std::array<ControlCondition, 6> alone;
  for (std::size_t k = 0; k < 6; ++k) alone[k] = conditions[k].condition;
  if (const auto why = dependent_conditions(law, alone)) throw InputError(*why);
  std::ranges::move(conditions, segment.conditions.begin());
  segment.times = std::move(times);
  return segment;
}

/// The columns of history.csv by their names.
py::dict history_columns(const EndochronicLaw& law, const std::vector<LoadSegment>& segments,
                         const ControlSettings& settings) {
  CsvTable table;
  {
    const py::gil_scoped_release others_run;
    const HistoryResult history = run_history(law, segments, settings, [](const HistoryPoint&) { look_for_signals(); });
    if (!history.converged) throw NoConvergence(history.failure);
    table = history_table(law, history);
  }
  py::dict columns;
  for (std::size_t i = 0; i < table.names.size(); ++i) columns[py::str(table.names[i])] = copy_of(table.columns[i]);
  return columns;
}

py::dict history(const EndochronicLaw& law, const Prescribed& prescribed, const ArrayOf<double>& time,
                 std::optional<double> largest_increment) {
  ControlSettings settings;
  if (largest_increment) settings.largest_increment = *largest_increment;
  if (!(settings.largest_increment > 0.0))
    throw InputError(fmt::format("largest_strain_increment: {} must be positive", settings.largest_increment));
  return history_columns(law, {segment_of(law, prescribed, numbers_of(time, "time"))}, settings);
}

}  // namespace

void define_endochronic(py::module_& module) {
  py::class_<EndochronicLaw>(module, "Endochronic")
      .def_static("from_text", &law_of_text, py::arg("toml"))
      .def_static("from_case", &law_of_case, py::arg("where"), py::arg("values"))
      .def("text", [](const EndochronicLaw& law) { return to_toml(law); })
      .def_property_readonly("young_modulus", [](const EndochronicLaw& law) { return law.elasticity.young_modulus(); })
      .def_property_readonly("poisson_ratio", [](const EndochronicLaw& law) { return law.elasticity.poisson_ratio(); })
      .def("respond", &history, py::arg("prescribed"), py::arg("time"), py::arg("largest_strain_increment"));
}

}  // namespace pfdm
