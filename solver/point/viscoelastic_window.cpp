// What tests over time can show: their loads, and the window of relaxation times (viscoelastic_fit.h).

#include "physics/quantity_text.h"
#include "solver/point/viscoelastic_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace pfdm {

namespace {

/// From the last row at rest to the end, and the shortest step in which the load changes, or after such a one: what
/// comes before the load, and rows close to each other while it stays, show no relaxation.
TimeWindow window_of(const LoadPath& path) {
  constexpr double same = 1e-3;  // of the largest load
  TimeWindow window{.shortest = std::numeric_limits<double>::infinity(), .longest = 0.0};
  double largest = 0.0;
  for (const double load : path.followed) largest = std::max(largest, std::abs(load));
  std::size_t begin = 0;
  while (begin + 1 < path.times.size() && std::abs(path.followed[begin + 1]) <= 1e-9 * largest) ++begin;
  if (begin + 1 >= path.times.size()) return window;
  window.longest = path.times.back() - path.times[begin];
  const auto changes = [&](std::size_t i) {
    return i <= begin + 1 || std::abs(path.followed[i] - path.followed[i - 1]) > same * largest;
  };
  for (std::size_t i = begin + 1; i < path.times.size(); ++i)
    if (changes(i) || changes(i - 1)) window.shortest = std::min(window.shortest, path.times[i] - path.times[i - 1]);
  return window;
}

}  // namespace

LoadPath whole_path(const ViscoelasticExperiment& experiment, const std::vector<double>& followed) {
  LoadPath path{experiment.times, followed};
  if (experiment.ramp > 0.0) {
    path.times.insert(path.times.begin(), experiment.times.front() - experiment.ramp);
    path.followed.insert(path.followed.begin(), 0.0);
    path.added = 1;
  }
  return path;
}

ViscoelasticExperiment at_reference(ViscoelasticExperiment experiment, const std::optional<TemperatureShift>& shift) {
  if (!shift || experiment.temperatures.empty()) return experiment;
  constexpr double longest = 1e30;  // the law of a trial may have no times at a test's temperature
  const std::vector<double> temperatures = std::exchange(experiment.temperatures, {});
  const auto factor = [&](std::size_t i) {
    return std::clamp(shift->factor(temperatures[temperatures.size() > 1 ? i : 0]), 1.0 / longest, longest);
  };
  for (double& t : experiment.times) t /= factor(0);
  experiment.ramp /= factor(0);
  for (std::size_t i = 0; i < experiment.angular_frequencies.size(); ++i)
    experiment.angular_frequencies[i] *= factor(i);
  return experiment;
}

ViscoelasticExperiments at_reference(const ViscoelasticExperiments& experiments,
                                     const std::optional<TemperatureShift>& shift) {
  ViscoelasticExperiments there;
  for (const ViscoelasticExperiment& experiment : experiments) there.push_back(at_reference(experiment, shift));
  return there;
}

void sort_rows(ViscoelasticExperiment& sweep, std::vector<double> by) {
  std::vector<std::size_t> order(by.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return by[i]; });
  const auto sort = [&](std::vector<double>& values) {
    const std::vector<double> before = values;
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = before[order[i]];
  };
  for (ViscoelasticExperiment::Channel& channel : sweep.channels) sort(channel.values);
  sort(sweep.angular_frequencies);
  if (sweep.temperatures.size() > 1) sort(sweep.temperatures);
}

std::size_t n_temperatures(const ViscoelasticExperiments& experiments) {
  std::set<double> all;
  for (const ViscoelasticExperiment& experiment : experiments)
    all.insert(experiment.temperatures.begin(), experiment.temperatures.end());
  return all.size();
}

TimeWindow time_window(const ViscoelasticExperiments& experiments) {
  TimeWindow window{.shortest = std::numeric_limits<double>::infinity(), .longest = 0.0};
  for (const ViscoelasticExperiment& experiment : experiments) {
    if (!experiment.is_frequency_sweep()) {
      const TimeWindow of_history = window_of(whole_path(experiment, experiment.followed));
      window.shortest = std::min(window.shortest, of_history.shortest);
      window.longest = std::max(window.longest, of_history.longest);
    }
    for (const double w : experiment.angular_frequencies) {
      window.shortest = std::min(window.shortest, 1.0 / w);
      window.longest = std::max(window.longest, 1.0 / w);
    }
  }
  return window;
}

std::string text_of(const TimeWindow& window) {
  return fmt::format("{} to {}", quantity_text(window.shortest, "s", 3), quantity_text(window.longest, "s", 3));
}

}  // namespace pfdm
