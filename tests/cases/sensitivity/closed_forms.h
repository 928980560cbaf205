#pragma once
// Cases whose sensitivities have closed forms: a bar that softens evenly, blocks that an interface joins.

#include "tests/cases/glued_blocks.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

using Values = std::map<std::string, double>;

inline const std::string E_key = "materials.stuff.young_modulus", Gc_key = "materials.stuff.toughness",
                         ell_key = "fracture.length";

/// Of AT2, so short that its damage is even: no jump, a smooth peak.
inline std::string short_bar() {
  return R"(kind = "fracture"
title = "a short bar"
[mesh]
generator = "box_hexes"
x = [{ length = "2 mm", cells = 2 }]
y = [{ length = "1 mm", cells = 1 }]
z = [{ length = "1 mm", cells = 1 }]
region = "bar"
[materials.stuff]
regions = ["bar"]
young_modulus = "30 GPa"
poisson_ratio = 0.0
toughness = "100 J/m^2"
[fracture]
model = "AT2"
split = "none"
length = "4 mm"
[[boundary]]
patch = "xmin"
displacement = ["0 mm", "free", "free"]
[[boundary]]
patch = "xmax"
displacement = ["0.002 mm", "free", "free"]
[[boundary]]
patches = ["ymin", "ymax", "zmin", "zmax"]
type = "symmetry"
[loading]
initial_increment = 0.02
maximum_increment = 0.02
[solver]
damage_tolerance = 1e-9
energy_tolerance = 1e-9
maximum_iterations = 5000
[output]
curve = { patch = "xmax", component = "x" }
)";
}

inline const Values bar_values{{E_key, 30e9}, {Gc_key, 100.0}, {ell_key, 4e-3}};

/// Bourdin, Marigo, Maurini, Sicsic (2014), with w = d^2: d = E e^2/(E e^2 + Gc/ell), and F = (1 - d)^2 E e A; of
/// alpha = d^2 and c0 = 2 the local term is Gc d/ell.
inline double force_of_bar(const Values& p, double u) {
  const double strain = u / 2e-3, y = p.at(E_key) * strain * strain, resistance = p.at(Gc_key) / p.at(ell_key);
  const double whole = resistance / (y + resistance);
  return whole * whole * p.at(E_key) * strain * 1e-6;
}

inline double elasticity_of(const std::function<double(const Values&)>& f, const Values& at, const std::string& key) {
  const double h = 1e-5;
  Values more = at, less = at;
  more[key] *= 1.0 + h;
  less[key] *= 1.0 - h;
  return std::log(f(more) / f(less)) / (2.0 * h);
}

inline nlohmann::json found_in(const TemporaryCase& directory, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"sensitivity", directory.path().string()};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = run(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(content_of(directory.results() / "sensitivity.json"));
}

inline nlohmann::json of_event(const nlohmann::json& found, const std::string& event, const std::string& figure,
                               const std::string& parameter) {
  for (const auto& e : found["events"])
    for (const auto& f : e["figures"])
      for (const auto& p : f["elasticities"])
        if (e["name"] == event && f["name"] == figure && p["parameter"] == parameter) return p;
  throw std::logic_error("no " + event + ", " + figure + ", " + parameter);
}

inline double value_of(const nlohmann::json& found, const std::string& event, const std::string& figure,
                       const std::string& parameter) {
  return of_event(found, event, figure, parameter)["elasticity"].get<double>();
}

inline const std::string modulus = "materials.stone.young_modulus", law_strength = "interface[0].strength",
                         law_toughness = "interface[0].toughness";

/// Springs in series: u = F L/(E A) + w, F = A s (1 - w s/(2 G)).
inline double force_of_blocks(const Values& p, double u) {
  const double s = p.at(law_strength), elastic = p.at(modulus) * u / 2e-3;
  const double last = 2.0 * p.at(law_toughness) / s, opened = (last - u) / (last - s * 2e-3 / p.at(modulus));
  return 1e-6 * (elastic < s ? elastic : s * std::max(0.0, opened));
}

/// They peak at a corner, F = A s at u = L s/E.
inline void expect_corner_of_blocks(const nlohmann::json& found) {
  const std::map<std::string, std::pair<double, double>> due{
      {modulus, {-1.0, 0.0}}, {law_strength, {1.0, 1.0}}, {law_toughness, {0.0, 0.0}}};
  for (const auto& [key, values] : due) {
    const auto of = [&](const char* figure) { return of_event(found, "greatest force", figure, key); };
    EXPECT_NEAR(of("displacement")["elasticity"].get<double>(), values.first, 1e-3) << key;
    EXPECT_NEAR(of("force")["elasticity"].get<double>(), values.second, 1e-3) << key;
    EXPECT_FALSE(of("displacement")["doubtful"].get<bool>()) << key;
  }
}

/// A block pulled along x by 2 um and along y by 1 um, at plane strain: F = E/((1 + nu)(1 - 2 nu)) ((1 - nu) e_x + nu
/// e_y) A, e = 1e-3 (1, 1).
inline std::string block_pulled_twice() {
  std::string text = replaced(short_bar(), "toughness = \"100 J/m^2\"", "damageable = false");
  text = replaced(text, "poisson_ratio = 0.0", "poisson_ratio = 0.3");
  text = replaced(text, "model = \"AT2\"\n", "");
  text = replaced(text, "length = \"4 mm\"\n[[boundary]]", "[[boundary]]");
  text =
      replaced(text, "patches = [\"ymin\", \"ymax\", \"zmin\", \"zmax\"]", "patches = [\"ymin\", \"zmin\", \"zmax\"]");
  text = replaced(text, "[loading]",
                  "[[boundary]]\npatch = \"ymax\"\ndisplacement = [\"free\", \"0.001 mm\", \"free\"]\n[loading]");
  text = replaced(text, "initial_increment = 0.02", "initial_increment = 0.25");
  return replaced(text, "maximum_increment = 0.02", "maximum_increment = 0.25");
}
inline const std::string sideways = "boundary[3].displacement[1]";

inline std::string finely_pulled_blocks() {
  const std::string blocks =
      replaced(glued_blocks(linear_glue), "\nmaximum_increment = 0.1", "\nmaximum_increment = 0.02");
  return replaced(blocks, "initial_increment = 0.1", "initial_increment = 0.02");
}

}  // namespace pfdm
