// Cohesive interfaces in pfdm cohesive, compare and report: the record of their faces, and another run beside them.

#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

nlohmann::json json_in(const fs::path& file) { return nlohmann::json::parse(content_of(file)); }

constexpr const char* other_specimen =
    "[experiment]\nstiffness_between = [\"0 um\", \"40 um\"]\n[[experiment.specimens]]\nname = \"other\"\n"
    "csv = \"other.csv\"\ndisplacement = { column = \"displacement_m\", unit = \"m\" }\n"
    "force = { column = \"force_x_N\", unit = \"N\" }\n";

// The law that the case gives, seen by its faces; their debonding and the energies beside another run's.
TEST(CohesiveInterfaces, RecordsCohesiveInterfaces) {
  const TemporaryCase glued(glued_blocks(linear_glue + "name = \"glue\"\n"));
  const Outcome first = run({"run", glued.path().string()});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out.find("cohesive interface \"glue\", 4 places, debonded area 1 mm^2"), std::string::npos)
      << first.out;
  const CsvTable law = read_csv(glued.results() / "cohesive_law.csv");
  for (std::size_t i = 1; i < law.n_rows(); ++i) {
    const double due = strength * std::max(0.0, 1.0 - law.column("separation_m")[i] * 0.5 * strength / toughness);
    EXPECT_NEAR(law.column("traction_Pa")[i], due, 1e-3 * strength) << i;
  }
  const nlohmann::json surface = json_in(glued.results() / "cohesive.json")["surfaces"][0];
  EXPECT_EQ(surface["law_is_given"], true);
  EXPECT_EQ(surface["kind"], "plane");
  EXPECT_TRUE(surface["laws"].empty());
  EXPECT_EQ(surface["given_law"]["law"], "linear");
  EXPECT_EQ(surface["given_law"]["strength_Pa"], strength);
  EXPECT_EQ(surface["given_law"]["toughness_J_per_m2"], toughness);
  EXPECT_EQ(surface["given_law"]["shear_strength_Pa"], strength);
  EXPECT_NEAR(surface["means_over_faces"][0]["dissipated_J_per_m2"].get<double>(), toughness, 1e-6 * toughness);
  EXPECT_EQ(read_csv(glued.results() / "debonding.csv").column("debonded_area_m2").back(), 1e-6);
}

std::string other_energy(const std::string& of, const std::string& column) {
  return fmt::format(
      "[[experiment.energies]]\nname = \"other\"\ncsv = \"other.csv\"\nof = \"{}\"\ndisplacement = {{ "
      "column = \"displacement_m\", unit = \"m\" }}\nenergy = {{ column = \"{}\", unit = \"J\" }}\n",
      of, column);
}

TEST(CohesiveInterfaces, ComparesEnergiesWithThoseOfAnotherRun) {
  const std::string text = glued_blocks(linear_glue + "name = \"glue\"\n") + other_specimen +
                           other_energy("dissipated", "interface_dissipation_J") +
                           other_energy("work", "external_work_J");
  const TemporaryCase directory(text);
  std::ofstream(directory.path() / "other.csv")
      << "displacement_m,force_x_N,external_work_J,interface_dissipation_J\n0,0,0,0\n0.00012,1,2e-4,1e-4\n";
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome compared = run({"compare", directory.path().string()});
  ASSERT_EQ(compared.status, 0) << compared.err;
  const nlohmann::json energies = json_in(directory.results() / "comparison.json")["energies"];
  ASSERT_EQ(energies.size(), 2U);
  EXPECT_EQ(energies[0]["kind"], "work");
  EXPECT_EQ(energies[1]["kind"], "dissipated");
  EXPECT_NEAR(energies[1]["model_at_end_J"].get<double>(), 1e-4, 1e-9);  // toughness times area
  EXPECT_NEAR(energies[1]["measured_at_end_J"].get<double>(), 1e-4, 1e-12);
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  const std::vector<double>&u = curve.column("displacement_m"), &force = curve.column("force_x_N");
  double work = 0.0;
  for (std::size_t i = 1; i < u.size(); ++i) work += 0.5 * (force[i] + force[i - 1]) * (u[i] - u[i - 1]);
  EXPECT_NEAR(energies[0]["model_at_end_J"].get<double>(), work, 1e-6 * work);
  EXPECT_EQ(read_csv(directory.results() / "comparison_energies.csv").column("kind").back(), 1.0);
  EXPECT_EQ(run({"report", directory.path().string()}).status, 0);
  const TemporaryCase wrong(replaced(text, "of = \"work\"", "of = \"heat\""));
  std::ofstream(wrong.path() / "other.csv") << content_of(directory.path() / "other.csv");
  const Outcome refused = run({"check", wrong.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("stored"), std::string::npos) << refused.err;
}

// The case of a fit, and another file beside case.toml, are told apart.
TEST(CohesiveInterfaces, NamesTheCaseOfAnExportedLaw) {
  const TemporaryCase glued(glued_blocks(linear_glue));
  const std::string name = fs::weakly_canonical(glued.path()).filename().string();
  fs::create_directories(glued.results());
  const fs::path fitted = glued.results() / "case.fitted.toml", coarse = glued.path() / "coarse.toml";
  fs::copy_file(glued.path() / "case.toml", fitted);
  fs::copy_file(glued.path() / "case.toml", coarse);
  for (const auto& [file, due] : {std::pair{fitted, name + ".fitted"}, std::pair{coarse, name + ".coarse"},
                                  std::pair{glued.path() / "case.toml", name}}) {
    const fs::path to = glued.path() / "out";
    const Outcome outcome = run({"cohesive", file.string(), "--export", "table", "--output", to.string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string head = content_of(to / "cohesive_law" / "table.csv");
    EXPECT_NE(head.find("case " + due + " ("), std::string::npos) << head;
    EXPECT_EQ(head.find("record"), std::string::npos) << head;
    fs::remove_all(to);
  }
}

const fs::path interface_case = fs::path(PFDM_CASES_DIR) / "glass_bead_interface";

double largest(const CsvTable& table, const std::string& column) {
  double value = 0.0;
  for (const double v : table.column(column)) value = std::max(value, std::abs(v));
  return value;
}

// What ships as the law of the faces is what the bar beside it makes.
TEST(CohesiveInterfaces, TheShippedLawIsThatOfItsBar) {
  const TemporaryCase place(content_of(interface_case / "bar.toml"));
  ASSERT_EQ(run({"run", place.path().string(), "--quiet"}).status, 0);
  ASSERT_EQ(run({"cohesive", place.path().string(), "--export", "table"}).status, 0);
  const fs::path made = place.results() / "cohesive_law" / "table.csv";
  EXPECT_NE(content_of(made).find("shear_ratio = 0.3273"), std::string::npos) << content_of(made);
  const CsvTable law = read_csv(made), shipped = read_csv(interface_case / "data/cohesive_law.csv");
  EXPECT_NEAR(largest(law, "traction_Pa"), largest(shipped, "traction_Pa"), 1e-3 * largest(shipped, "traction_Pa"));
  EXPECT_NEAR(law.column("separation_m").back(), shipped.column("separation_m").back(), 1e-6);
  EXPECT_NE(content_of(interface_case / "case.toml").find("shear_ratio = 0.3273"), std::string::npos);
}

// T_n^2/M + T_t^2/mu drives the damage of a confined band, M = lambda + 2 mu.
TEST(CohesiveInterfaces, AConfinedBandIsWeakerInShear) {
  const std::string bar = content_of(interface_case / "bar.toml");
  std::string shear = replaced(bar, "[\"0 um\", \"0 um\", \"120 um\"]", "[\"400 um\", \"0 um\", \"0 um\"]");
  shear = replaced(
      shear, "patches = [\"xmin\", \"xmax\", \"ymin\", \"ymax\"]\ndisplacement = [\"0 um\", \"0 um\", \"free\"]",
      "patches = [\"xmin\", \"xmax\"]\ndisplacement = [\"free\", \"0 um\", \"0 um\"]\n[[boundary]]\npatches = "
      "[\"ymin\", \"ymax\"]\ntype = \"symmetry\"");
  double force[2];
  for (const bool sheared : {false, true}) {
    const TemporaryCase place(sheared ? shear : bar);
    const Outcome outcome = run({"run", place.path().string(), "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    force[sheared ? 1 : 0] =
        largest(read_csv(place.results() / "force_displacement.csv"), sheared ? "force_x_N" : "force_z_N");
  }
  const double nu = 0.44, mu_over_M = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu));
  EXPECT_NEAR(force[1] / force[0], std::sqrt(mu_over_M), 2e-3);
}

}  // namespace
}  // namespace pfdm::this_file
