#pragma once
// Fits of a bar that breaks at once to a run of its own, and what they leave.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace pfdm {

inline nlohmann::json fit_in(const std::filesystem::path& results) {
  return nlohmann::json::parse(content_of(results / "fit.json"));
}

inline const nlohmann::json& parameter(const nlohmann::json& fit, const std::string& name) {
  for (const auto& entry : fit["parameters"])
    if (entry["name"] == name) return entry;
  throw std::logic_error("no parameter " + name);
}

inline double estimate(const nlohmann::json& fit, const std::string& name) { return parameter(fit, name)["estimate"]; }

inline constexpr const char* modulus_key = "materials.concrete.young_modulus";
inline constexpr const char* toughness_key = "materials.concrete.toughness";

inline const std::string bar_fit = R"(
[experiment]
stiffness_between = ["1 um", "5 um"]
[[experiment.specimens]]
name = "one"
csv = "data.csv"
displacement = { column = "displacement_m" }
force = { column = "force_N" }

[fit]
[[fit.parameters]]
key = "materials.concrete.young_modulus"
bounds = ["10 GPa", "90 GPa"]
[[fit.parameters]]
key = ["materials.concrete.toughness", "regions.weak.toughness"]
bounds = ["20 J/m^2", "500 J/m^2"]
)";

/// The modulus first; what the second one does may follow.
inline const std::string two_stages = R"(
[[fit.stages]]
name = "elastic"
parameters = ["materials.concrete.young_modulus"]
between = ["0 um", "6 um"]
[[fit.stages]]
name = "whole"
)";

/// The case with [fit], and in data.csv what a run of the bar with 33 GPa and 110 J/m^2 gives.
class BarFit {
 public:
  explicit BarFit(const std::string& fit = bar_fit, const std::string& bar = marked_bar())
      : directory(
            replaced(replaced(replaced(bar, "30 GPa", "33 GPa"), "100 J/m^2", "110 J/m^2"), "80 J/m^2", "88 J/m^2")) {
    if (run({"run", path(), "--quiet"}).status != 0) throw std::logic_error("the bar's run fails");
    const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
    CsvTable data;
    data.comments = {"made by the test"};
    data.add("displacement_m", curve.column("displacement_m"));
    data.add("force_N", curve.column("force_x_N"));
    write_csv(directory.path() / "data.csv", data);
    std::filesystem::remove_all(directory.results());
    directory.write("case.toml", bar + fit);
  }
  std::string path() const { return directory.path().string(); }

  static std::string marked_bar() {
    return replaced(bar_case(), "young_modulus = \"30 GPa\"", "young_modulus = \"30 GPa\"  # of a cube");
  }

  TemporaryCase directory;
};

/// One parameter alone.
inline std::string fit_of(const std::string& key, const std::string& bounds, const std::string& settings = "") {
  return bar_fit.substr(0, bar_fit.find("[fit]")) + "[fit]\n" + settings + "[[fit.parameters]]\nkey = \"" + key +
         "\"\nbounds = " + bounds + "\n";
}

inline std::string last_line(std::string text) {
  text.resize(text.find_last_not_of('\n') + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace pfdm
