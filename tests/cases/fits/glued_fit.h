#pragma once
// Fits of two glued blocks whose record is a straight line: the law is linear.

#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr double glue_deviation = 0.004;  // of the force [N], whose largest is 2 N

/// A first guess of the law.
inline const std::string glue_guess =
    "name = \"glue\"\nbetween = [\"left\", \"right\"]\nlaw = \"linear\"\nstrength = \"1.6 MPa\"\n"
    "toughness = \"130 J/m^2\"\n";

/// Strength and toughness of an interface fitted to data.csv; `events`: text of [[experiment.events]].
inline std::string glued_fit(const std::string& interface, const std::string& intervals,
                             const std::string& events = "") {
  return glued_blocks(interface) + R"(
[experiment]
stiffness_between = ["20 um", "40 um"]
[[experiment.specimens]]
name = "glue"
csv = "data.csv"
displacement = { column = "displacement_m" }
force = { column = "force_N" }
deviation = { column = "deviation_N" }
)" + events +
         "[fit]\nintervals = \"" + intervals + R"("
[[fit.parameters]]
key = "interface[0].strength"
bounds = ["0.5 MPa", "8 MPa"]
[[fit.parameters]]
key = "interface[0].toughness"
bounds = ["20 J/m^2", "500 J/m^2"]
)";
}

struct GlueRecord {
  std::vector<double> u, force;  // [m], [N]
};

/// Writes data.csv: u = delta + 2 L T/E, T = strength (1 - delta/delta_f), with normal noise and what is `added` [N] at
/// u [m].
inline GlueRecord record_glue(const TemporaryCase& directory, const std::function<double(double)>& added = {}) {
  const double compliance = 2e-3 / 1e9, final_opening = 2.0 * toughness / strength, area = 1e-6;
  std::mt19937 engine(11);
  std::normal_distribution<double> noise(0.0, glue_deviation);
  GlueRecord record;
  for (int i = 13; i <= 95; ++i) {
    const double u = 1e-6 * i;
    const double opening = (u - compliance * strength) / (1.0 - compliance * strength / final_opening);
    record.u.push_back(u);
    record.force.push_back(area * strength * (1.0 - opening / final_opening) + noise(engine));
    if (added) record.force.back() += added(u);
  }
  CsvTable data;
  data.comments = {"SYNTHETIC, made by the test"};
  data.add("displacement_m", record.u);
  data.add("force_N", record.force);
  data.add("deviation_N", std::vector(record.u.size(), glue_deviation));
  write_csv(directory.path() / "data.csv", data);
  return record;
}

}  // namespace pfdm
