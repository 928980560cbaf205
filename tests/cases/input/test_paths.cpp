// Files that a case names, and names that become files: nothing is read that is no file, nothing is written outside the
// results, and a case that is written elsewhere names the same files.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/studies/runs/slurm.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string point_case = R"(kind = "endochronic"
title = "a strain from a file"
[material]
young_modulus = "100 GPa"
poisson_ratio = 0.3
kernel = [{ C = "30 GPa", alpha = 700 }]
[loading]
[[loading.segments]]
control = { strain_xx = { csv = "DATA", column = "strain_xx" } }
)";

const std::string shaken_case =
    soft_sample() + "[[test]]\nname = \"up\"\nrecord = { file = \"DATA\", from = \"10 Hz\", to = \"70 Hz\" }\n";

const std::string shaken_by_a_record = replaced(shaken_case, R"(record = { file = "DATA", from)",
                                                R"(excitation = { type = "measured", file = "DATA", from)");

const std::string imported_case = [] {
  std::string text = bar_case();
  const auto mesh = text.find("generator"), next = text.find("[materials");
  return text.replace(mesh, next - mesh, "generator = \"vtk\"\nfile = \"DATA\"\nlength_unit = \"mm\"\n");
}();

const std::string compared_case = bar_case() + replaced(measured_specimen(), "data/one.csv", "DATA");

void expect_refused_data(const std::string& text, const std::string& data, const std::string& message) {
  const TemporaryCase directory(replaced(text, "DATA", data));
  fs::create_directory(directory.path() / "folder.csv");
  ASSERT_EQ(mkfifo((directory.path() / "pipe.csv").c_str(), 0600), 0);
  expect_refused(directory, {data.c_str(), "", "", {"case.toml:", data + message}});
}

TEST(DataFile, IsNeitherAFolderNorAPipe) {
  for (const std::string& text : {point_case, shaken_case, shaken_by_a_record, imported_case, compared_case}) {
    SCOPED_TRACE(text.substr(0, 60));
    expect_refused_data(text, "folder.csv", ": it is a directory, not a file");
    expect_refused_data(text, "pipe.csv", ": it is a named pipe, not a file");
    expect_refused_data(text, "/dev/null", ": it is not a regular file");
  }
}

TEST(CaseFile, IsNeitherAFolderNorAPipe) {
  const TemporaryCase directory(bar_case());
  fs::remove(directory.path() / "case.toml");
  fs::create_directory(directory.path() / "case.toml");
  const Outcome folder = run({"check", directory.path().string()});
  EXPECT_EQ(folder.status, 2);
  EXPECT_THAT(folder.err, HasSubstr("case.toml: it is a directory, not a file"));
  fs::remove(directory.path() / "case.toml");
  ASSERT_EQ(mkfifo((directory.path() / "case.toml").c_str(), 0600), 0);
  const Outcome pipe = run({"check", directory.path().string()});
  EXPECT_EQ(pipe.status, 2);
  EXPECT_THAT(pipe.err, HasSubstr("case.toml: it is a named pipe, not a file"));
}

class BadName : public testing::TestWithParam<BadInput> {};

TEST_P(BadName, IsRefused) {
  const TemporaryCase directory(
      replaced(GetParam().name[0] == 't' ? shaken_case : bar_case() + crack_plane(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_names[] = {
    {"region_of_layers",
     "generator = \"box_hexes\"\nx = [{ length = \"20 mm\", cells = 21 }]\ny = [{ length = \"1 mm\", cells = 2 }]\n"
     "z = [{ length = \"1 mm\", cells = 1 }]\nregion = \"bar\"\n[[mesh.regions]]\nname = \"weak\"\n"
     "lower = [\"9.6 mm\", \"-1 mm\", \"-1 mm\"]\nupper = [\"10.4 mm\", \"2 mm\", \"2 mm\"]",
     "generator = \"particles_in_box\"\nsize = [\"9 mm\", \"9 mm\", \"9 mm\"]\n"
     "layers = { count = 1, thickness = \"1 mm\", region = \"../../x\" }",
     {"[mesh.layers] region: \"../../x\" is used as the name of a folder; it may have letters, digits, _ and - only"}},
    {"region_of_a_band",
     "[regions.weak]",
     "[regions.\"../weak\"]\nband = { width = \"1 mm\", between = [\"bar\", \"bar\"] }",
     {"\"../weak\" is used as the name of a folder"}},
    {"plane",
     "name = \"crack\"",
     "name = \"a/b\"",
     {"[cohesive.planes] name: \"a/b\" is used as the name of a folder"}},
    {"plane_that_is_hidden", "name = \"crack\"", "name = \".new\"", {"and . but not at the beginning"}},
    {"crack_tip",
     "[output]",
     "[[output.energy_release_rate]]\nname = \"a,b\"\n[output]",
     {"\"a,b\" is used as the name of a column"}},
    {"test", "name = \"up\"", "name = \"../up\"", {"[test] name: \"../up\" is used as the name of files"}},
    {"test_above", "name = \"up\"", "name = \"..\"", {"[test] name: \"..\" is used as the name of files"}},
};

INSTANTIATE_TEST_SUITE_P(Program, BadName, testing::ValuesIn(bad_names),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(CaseFile, NamesTheSameFilesFromElsewhere) {
  const TemporaryCase directory(
      "both = [{ csv = \"a.csv\" }, { csv = 'data/b \"2\".csv' }]  # csv = \"no.csv\"\n"
      "[\"x.y\"]\n\"file\" = \"../c.csv\"\ntitle = \"csv = \\\"d.csv\\\"\"\ntable = \"law.csv\"\n"
      "[[mesh.particles]]\nsurface = \"grain.stl\"\n[[mesh.shapes]]\nsurface = \"chip.obj\"\n[heating]\nsurface = "
      "\"zmax\"\n");
  EXPECT_EQ(moved(open_case(directory.path()), directory.results()),
            "both = [{ csv = \"../a.csv\" }, { csv = \"../data/b \\\"2\\\".csv\" }]  # csv = \"no.csv\"\n"
            "[\"x.y\"]\n\"file\" = \"../../c.csv\"\ntitle = \"csv = \\\"d.csv\\\"\"\ntable = \"../law.csv\"\n"
            "[[mesh.particles]]\nsurface = \"../grain.stl\"\n[[mesh.shapes]]\nsurface = "
            "\"../chip.obj\"\n[heating]\nsurface = \"zmax\"\n");
}

TEST(CaseFile, KeepsTablesWithDigitsBehindTheOneThatIsReplaced) {
  const TemporaryCase directory("[model]\nmass = 1\n[glass_2]\nE = 2\n");
  EXPECT_EQ(with_table(open_case(directory.path()), "model", "[model]\nmass = 2\n", directory.results()),
            "[model]\nmass = 2\n[glass_2]\nE = 2\n");
}

TEST(CaseFile, FindsTablesBesideLinesOfAnyLength) {
  const std::string blanks(200000, ' ');
  const TemporaryCase directory("[ model ] # " + blanks + "x\nmass = 1\n" + blanks + "\nlist = [\n[1.0],\n[2.0]]\n" +
                                "[[ other.part ]]\nE = 2\n");
  EXPECT_EQ(with_table(open_case(directory.path()), "model", "[model]\nmass = 2\n", directory.results()),
            "[model]\nmass = 2\n[[ other.part ]]\nE = 2\n");
}

TEST(ResultNumbers, AreLookedForByKeysOfAnyLength) {
  const TemporaryCase directory(
      replaced(bar_case(), "\"30 GPa\"", "{ from = \"x.json\", key = \"E_Pa" + std::string(50000, '[') + "0]\" }"));
  directory.write("x.json", "{ \"E_Pa\": [3e10] }");
  EXPECT_EQ(run({"check", directory.path().string()}).status, 0);
}

TEST(Paths, ThatAreNoUtf8KeepTheirResults) {
  const TemporaryCase directory(bar_case());
  const fs::path results = directory.path() / "l\xe4tin";
  EXPECT_EQ(run({"run", directory.path().string(), "--output", results.string()}).status, 0);
  EXPECT_TRUE(fs::exists(results / "summary.json"));
  const fs::path moved_case = directory.path() / "f\xe4ll";
  fs::create_directory(moved_case);
  fs::copy_file(directory.path() / "case.toml", moved_case / "case.toml");
  EXPECT_EQ(run({"run", moved_case.string()}).status, 0);
  EXPECT_THAT(content_of(moved_case / "results/summary.json"), HasSubstr("\"case\": \"f\uFFFDll\""));
}

TEST(Sweep, RunsAgainWhereALoadingFileHasChanged) {
  const TemporaryCase directory(replaced(point_case, "DATA", "path.csv") +
                                "[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\n"
                                "key = \"material.kernel[0].alpha\"\nvalues = [500, 700]\n");
  directory.write("path.csv", "time_s,strain_xx\n0,0\n1,0.002\n");
  const Outcome first = run({"sweep", directory.path().string()});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(run({"sweep", directory.path().string()}).out, HasSubstr("0 runs made, 2 reused"));
  directory.write("path.csv", "time_s,strain_xx\n0,0\n1,0.003\n");
  EXPECT_THAT(run({"sweep", directory.path().string()}).out, HasSubstr("2 runs made, 0 reused"));
}

TEST(Slurm, TakesNamesOfPartitionsOfAnyLength) {
  const TemporaryCase directory(bar_case() +
                                "\n[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\nkey = "
                                "\"materials.concrete.young_modulus\"\nvalues = [\"30 GPa\"]\n[sweep.slurm]\n"
                                "memory = \"4 GB\"\npartition = \"" +
                                std::string(50000, 'x') + "\"\n");
  EXPECT_EQ(run({"check", directory.path().string()}).status, 0);
}

TEST(Slurm, TakesNoCommandForAPartition) {
  for (const char* partition : {"all\\nrm -rf x", "all --wrap=x", "$(x)", "a\\tb", "\\u001b[2J"}) {
    const TemporaryCase directory(bar_case() +
                                  "[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\n"
                                  "key = \"materials.concrete.young_modulus\"\nvalues = [\"30 GPa\"]\n"
                                  "[sweep.slurm]\npartition = \"" +
                                  partition + "\"\n");
    expect_refused(directory, {"partition", "", "", {"[sweep.slurm] partition: this is not a partition"}});
  }
  const TemporaryCase directory(bar_case() +
                                "[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\n"
                                "key = \"materials.concrete.young_modulus\"\nvalues = [\"30 GPa\"]\n"
                                "[sweep.slurm]\nlines = [\"a\\rb\"]\n");
  expect_refused(directory, {"line", "", "", {"without line breaks or control characters"}});
}

}  // namespace
}  // namespace pfdm::this_file
