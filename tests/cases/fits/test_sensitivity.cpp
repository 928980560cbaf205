// pfdm sensitivity, against closed forms: a bar that softens evenly, blocks that an interface joins.

#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
using Values = std::map<std::string, double>;

const std::string E_key = "materials.stuff.young_modulus", Gc_key = "materials.stuff.toughness",
                  ell_key = "fracture.length";

/// Of AT2, so short that its damage is even: no jump, a smooth peak.
std::string short_bar() {
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

const Values bar_values{{E_key, 30e9}, {Gc_key, 100.0}, {ell_key, 4e-3}};

/// Bourdin, Marigo, Maurini, Sicsic (2014), with w = d^2: d = E e^2/(E e^2 + Gc/ell), and F = (1 - d)^2 E e A; of
/// alpha = d^2 and c0 = 2 the local term is Gc d/ell.
double force_of_bar(const Values& p, double u) {
  const double strain = u / 2e-3, y = p.at(E_key) * strain * strain, resistance = p.at(Gc_key) / p.at(ell_key);
  const double whole = resistance / (y + resistance);
  return whole * whole * p.at(E_key) * strain * 1e-6;
}

double elasticity_of(const std::function<double(const Values&)>& f, const Values& at, const std::string& key) {
  const double h = 1e-5;
  Values more = at, less = at;
  more[key] *= 1.0 + h;
  less[key] *= 1.0 - h;
  return std::log(f(more) / f(less)) / (2.0 * h);
}

nlohmann::json found_in(const TemporaryCase& directory, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"sensitivity", directory.path().string()};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = run(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(content_of(directory.results() / "sensitivity.json"));
}

nlohmann::json of_event(const nlohmann::json& found, const std::string& event, const std::string& figure,
                        const std::string& parameter) {
  for (const auto& e : found["events"])
    for (const auto& f : e["figures"])
      for (const auto& p : f["elasticities"])
        if (e["name"] == event && f["name"] == figure && p["parameter"] == parameter) return p;
  throw std::logic_error("no " + event + ", " + figure + ", " + parameter);
}

double value_of(const nlohmann::json& found, const std::string& event, const std::string& figure,
                const std::string& parameter) {
  return of_event(found, event, figure, parameter)["elasticity"].get<double>();
}

TEST(Sensitivity, OfABarThatSoftensEvenlyHasItsClosedForm) {
  const TemporaryCase directory(short_bar());
  const auto found = found_in(directory);
  const CsvTable table = read_csv(directory.results() / "sensitivity.csv", {.has_gaps = true});
  const std::vector<double>& u = table.column("displacement_m");
  ASSERT_EQ(u.size(), 51u);
  for (const auto& [key, value] : bar_values) {
    const std::vector<double>&e = table.column("elasticity_" + key), &error = table.column("error_" + key);
    for (std::size_t i = 1; i < u.size(); ++i) {
      if (std::isnan(e[i])) continue;
      const double due = elasticity_of([&](const Values& p) { return force_of_bar(p, u[i]); }, bar_values, key);
      EXPECT_NEAR(e[i], due, 1e-4 * std::max(1.0, std::abs(due))) << key << " at " << u[i];
      EXPECT_GT(3.0 * error[i] + 1e-6, std::abs(e[i] - due));
    }
    EXPECT_TRUE(std::isnan(e[0]));
    EXPECT_FALSE(std::isnan(e[25]));
  }
  // F = (9/16) (E Gc/(3 ell))^(1/2) A at e = (Gc/(3 E ell))^(1/2).
  const std::map<std::string, double> of_force{{E_key, 0.5}, {Gc_key, 0.5}, {ell_key, -0.5}};
  for (const auto& [key, due] : of_force) {
    EXPECT_NEAR(value_of(found, "greatest force", "force", key), due, 1e-3) << key;
    EXPECT_NEAR(value_of(found, "greatest force", "displacement", key), key == E_key ? -0.5 : due, 0.02) << key;
  }
  EXPECT_TRUE(found["remarks"].empty()) << found["remarks"];
}

const std::string modulus = "materials.stone.young_modulus", law_strength = "interface[0].strength",
                  law_toughness = "interface[0].toughness";

/// Springs in series: u = F L/(E A) + w, F = A s (1 - w s/(2 G)).
double force_of_blocks(const Values& p, double u) {
  const double s = p.at(law_strength), elastic = p.at(modulus) * u / 2e-3;
  const double last = 2.0 * p.at(law_toughness) / s, opened = (last - u) / (last - s * 2e-3 / p.at(modulus));
  return 1e-6 * (elastic < s ? elastic : s * std::max(0.0, opened));
}

TEST(Sensitivity, OfGluedBlocksHasItsClosedForm) {
  const std::string blocks =
      replaced(glued_blocks(linear_glue), "\nmaximum_increment = 0.1", "\nmaximum_increment = 0.02");
  const TemporaryCase directory(replaced(blocks, "initial_increment = 0.1", "initial_increment = 0.02"));
  const auto found = found_in(directory);
  const CsvTable table = read_csv(directory.results() / "sensitivity.csv", {.has_gaps = true});
  const std::vector<double>& u = table.column("displacement_m");
  const Values values{{modulus, 1e9}, {law_strength, strength}, {law_toughness, toughness}};
  int n = 0;
  for (const auto& [key, value] : values) {
    const std::vector<double>& e = table.column("elasticity_" + key);
    for (std::size_t i = 1; i < u.size(); ++i) {
      if (std::isnan(e[i]) || u[i] < 1e-5 || u[i] > 0.7e-4) continue;
      const double due = elasticity_of([&](const Values& p) { return force_of_blocks(p, u[i]); }, values, key);
      EXPECT_NEAR(e[i], due, 2e-3 * std::max(1.0, std::abs(due))) << key << " at " << u[i];
      ++n;
    }
  }
  EXPECT_GT(n, 60);
}

TEST(Sensitivity, GoesOnWithTheRunsThatAreThere) {
  const TemporaryCase directory(short_bar());
  const std::vector<std::string> words{"sensitivity", directory.path().string(), "--parameters", Gc_key, "--step",
                                       "0.02"};
  const Outcome first = run(words);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("5 runs made, 0 reused"));
  const std::string table = content_of(directory.results() / "sensitivity.csv");
  std::filesystem::remove(std::filesystem::directory_iterator(directory.results() / "runs")->path() / "summary.json");
  const Outcome second = run(words);
  EXPECT_THAT(second.out, HasSubstr("1 runs made, 4 reused"));
  EXPECT_EQ(content_of(directory.results() / "sensitivity.csv"), table);
  const std::string page = content_of(directory.results() / "sensitivity/index.html");
  for (const char* part : {"Elasticity of the force", "Elasticities of events", "stuff.toughness"})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST(Sensitivity, KeepsTheRatiosOfKeysThatAreJoined) {
  const TemporaryCase directory(replaced(bar_case(), "poisson_ratio = 0.2", "poisson_ratio = 0.0"));
  const auto found = found_in(
      directory, {"--parameters", "materials.concrete.toughness+regions.weak.toughness", "--set",
                  "loading.initial_increment=0.01", "--set", "loading.maximum_increment=0.01", "--step", "0.1"});
  EXPECT_EQ(found["parameters"][0]["keys"].size(), 2u);
  const auto jump = of_event(found, "jump 1", "displacement", "materials.concrete.toughness");
  EXPECT_NEAR(jump["elasticity"].get<double>(), 0.5, 2.0 * jump["error"].get<double>());
}

TEST(Sensitivity, RefusesWhatIsNoParameter) {
  const TemporaryCase directory(short_bar());
  const std::map<std::string, std::string> refused{{"materials.stuff.toughnes", "toughnes"},
                                                   {"mesh.region", "is not a quantity with a unit"},
                                                   {"materials.stuff.poisson_ratio", "it is not positive"},
                                                   {Gc_key + "," + Gc_key, "named twice"},
                                                   {Gc_key + "+" + E_key, "must have the same dimension"}};
  for (const auto& [word, message] : refused) {
    const Outcome outcome = run({"sensitivity", directory.path().string(), "--parameters", word});
    EXPECT_EQ(outcome.status, 2) << word;
    EXPECT_THAT(outcome.err, HasSubstr("--parameters ")) << word;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << word;
  }
  EXPECT_EQ(run({"sensitivity", directory.path().string(), "--step", "0"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(directory.results()));
}

// What a step makes of a value may be none that the case allows.
TEST(Sensitivity, LeavesOutAParameterThatCannotBeGreater) {
  const TemporaryCase directory(replaced(short_bar(), "poisson_ratio = 0.0", "poisson_ratio = 0.499"));
  const auto found = found_in(directory, {"--parameters", "materials.stuff.poisson_ratio," + E_key});
  EXPECT_THAT(found["parameters"][1]["failure"].get<std::string>(), HasSubstr("at most 0.4999"));
  EXPECT_EQ(found["parameters"][0]["name"], E_key);
  EXPECT_EQ(found["parameters"][0]["failure"], "");
}

}  // namespace
}  // namespace pfdm::this_file
