#include "postproc/point/history_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace pfdm {
namespace {

std::vector<double> column(const HistoryResult& history, const std::function<double(const HistoryPoint&)>& value) {
  std::vector<double> values;
  for (const HistoryPoint& point : history.points) values.push_back(value(point));
  return values;
}

void add_components(CsvTable& table, const HistoryResult& history, std::string_view name, std::string_view unit,
                    const std::function<const Mandel&(const HistoryPoint&)>& tensor) {
  for (int k = 0; k < n_components; ++k)
    table.add(fmt::format("{}_{}{}", name, component_names[k], unit),
              column(history, [&](const HistoryPoint& p) { return tensor(p)[k] / mandel_factor(k); }));
}

/// By the trapezoidal rule [J/m^3].
std::vector<double> external_work(const HistoryResult& history) {
  std::vector<double> work{0.0};
  for (std::size_t i = 1; i < history.points.size(); ++i) {
    const HistoryPoint &a = history.points[i - 1], &b = history.points[i];
    work.push_back(work.back() + 0.5 * (a.stress + b.stress).dot(b.state.strain - a.state.strain));
  }
  return work;
}

double von_mises(const Mandel& stress) { return std::sqrt(1.5) * deviator(stress).norm(); }

}  // namespace

CsvTable history_table(const EndochronicLaw& law, const HistoryResult& history) {
  CsvTable table;
  table.add("time_s", column(history, [](const HistoryPoint& p) { return p.time; }));
  add_components(table, history, "stress", "_Pa", [](const HistoryPoint& p) -> const Mandel& { return p.stress; });
  add_components(table, history, "strain", "", [](const HistoryPoint& p) -> const Mandel& { return p.state.strain; });
  add_components(table, history, "plastic_strain", "",
                 [](const HistoryPoint& p) -> const Mandel& { return p.state.plastic_strain; });
  table.add("z", column(history, [](const HistoryPoint& p) { return p.state.z; }));
  table.add("zeta", column(history, [](const HistoryPoint& p) { return p.state.zeta; }));
  table.add("dissipation_J_per_m3", column(history, [](const HistoryPoint& p) { return p.state.dissipation; }));
  table.add("free_energy_J_per_m3", column(history, [&](const HistoryPoint& p) { return free_energy(law, p.state); }));
  table.add("external_work_J_per_m3", external_work(history));
  table.add("iterations", column(history, [](const HistoryPoint& p) { return p.iterations; }));
  table.add("substeps", column(history, [](const HistoryPoint& p) { return p.substeps; }));
  return table;
}

std::int64_t newton_iterations(const HistoryResult& history) {
  std::int64_t sum = 0;
  for (const HistoryPoint& p : history.points) sum += p.iterations;
  return sum;
}

std::map<std::string, double> history_figures(const EndochronicLaw& law, const HistoryResult& history) {
  std::map<std::string, double> figures;
  double largest = 0.0, invariant = 0.0;
  for (const HistoryPoint& p : history.points) {
    largest = std::max(largest, von_mises(p.stress));
    invariant = std::max(invariant, invariant_error(law, p.state));
  }
  const HistoryPoint& last = history.points.back();
  const double work = external_work(history).back();
  figures["largest_von_mises_stress_Pa"] = largest;
  figures["largest_invariant_error_Pa"] = invariant;
  figures["final_time_s"] = last.time;
  figures["final_zeta"] = last.state.zeta;
  figures["final_z"] = last.state.z;
  figures["dissipation_J_per_m3"] = last.state.dissipation;
  figures["external_work_J_per_m3"] = work;
  if (work > 0.0)
    figures["energy_balance_error"] = std::abs(work - free_energy(law, last.state) - last.state.dissipation) / work;
  for (int k = 0; k < n_components; ++k) {
    const auto range =
        std::ranges::minmax(column(history, [k](const HistoryPoint& p) { return p.stress[k] / mandel_factor(k); }));
    if (std::max(-range.min, range.max) < 1e-6 * largest) continue;
    const auto name = component_names[k];
    figures[fmt::format("largest_stress_{}_Pa", name)] = range.max;
    figures[fmt::format("least_stress_{}_Pa", name)] = range.min;
  }
  return figures;
}

}  // namespace pfdm
