// What tests over time can show: their loads, and the window of relaxation times (viscoelastic_fit.h).

#include "physics/quantity_text.h"
#include "solver/point/viscoelastic_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
