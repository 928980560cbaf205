#pragma once
// A bar that breaks at once, and fits to its synthetic record with the jump of the force as a datum.

#include "tests/cases/bar_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pfdm {

inline constexpr double true_modulus = 33e9, true_toughness = 121.0;
inline constexpr double row_spacing = 0.25e-6, load_step = 0.15e-6;

inline std::string fine_bar(const std::string& increment) {
  const std::string bar = replaced(bar_case(), "initial_increment = 0.1", "initial_increment = " + increment);
  return replaced(bar, "\nmaximum_increment = 0.1", "\nmaximum_increment = " + increment);
}

inline const std::string toughness_bounds = "bounds = [\"20 J/m^2\", \"500 J/m^2\"]";

inline std::string event_fit(const std::string& event = "event = \"jump\"\nleast_fall = 0.3\n") {
  std::string fit = replaced(bar_fit, "force = { column = \"force_N\" }\n",
                             "force = { column = \"force_N\" }\ndeviation = { column = \"deviation_N\" }\n");
  fit = replaced(fit, "[fit]\n", "[[experiment.events]]\n" + event + "[fit]\nstep = 0.05\ntolerance = 0.002\n");
  return fine_bar("0.01") + fit;
}

/// Runs of the bar with the true values in steps a fifth as long; rows with noise of 2 % of the largest force.
class BrokenBar {
 public:
  BrokenBar() {
    const std::string bar = replaced(replaced(fine_bar("0.002"), "30 GPa", "33 GPa"), "100 J/m^2", "121 J/m^2");
    const TemporaryCase truth(replaced(bar, "80 J/m^2", "96.8 J/m^2"));
    if (run({"run", truth.path().string(), "--quiet"}).status != 0) throw std::logic_error("the bar's run fails");
    const CsvTable curve = read_csv(truth.results() / "force_displacement.csv");
    const SampledCurve computed{.name = "", .x = curve.column("displacement_m"), .y = curve.column("force_x_N")};
    const double deviation = 0.02 * std::ranges::max(computed.y);
    std::mt19937 engine(7);
    std::normal_distribution<double> noise(0.0, deviation);
    std::vector<double> u, force;
    for (int i = 0; row_spacing * i <= computed.x.back(); ++i) {
      u.push_back(row_spacing * i);
      force.push_back(computed.at(u.back()) + noise(engine));
    }
    rows.comments = {"SYNTHETIC, made by the test"};
    rows.add("displacement_m", u);
    rows.add("force_N", force);
    rows.add("deviation_N", std::vector(u.size(), deviation));
    for (std::size_t i = 0; i + 1 < computed.x.size(); ++i)
      if (computed.y[i] - computed.y[i + 1] > 0.3 * std::ranges::max(computed.y)) jump = computed.x[i];
  }
  void write(const TemporaryCase& directory) const { write_csv(directory.path() / "data.csv", rows); }

  CsvTable rows;
  double jump = 0.0;  ///< [m]
};

inline const BrokenBar& broken_bar() {
  static const BrokenBar bar;
  return bar;
}

/// Of the fit to its rows.
inline nlohmann::json fitted_to_broken_bar(const TemporaryCase& directory) {
  broken_bar().write(directory);
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return fit_in(directory.results());
}

inline const nlohmann::json& event_figure(const nlohmann::json& event, const std::string& name) {
  for (const auto& entry : event["figures"])
    if (entry["name"] == name) return entry;
  throw std::logic_error("no figure " + name);
}

}  // namespace pfdm
