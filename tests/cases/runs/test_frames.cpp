// What frames of a run are called by, and meshes of Gmsh as cases.

#include "postproc/fields/pvd.h"
#include "postproc/fields/vtkhdf_frames.h"
#include "tests/cases/page_data.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* frames_at = "frames_at = [\"0.006 mm\"]";

std::string with_output(const std::string& keys) {
  return replaced(bar_case(), frames_at, std::string(frames_at) + "\n" + keys);
}

std::string lasting_3_s(const std::string& text) {
  return replaced(text, "[loading]\n", "[loading]\nduration = \"3 s\"\n");
}

std::vector<double> times_of(const std::string& text) {
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string(), "--threads", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<double> times;
  for (const Frame& frame : read_pvd(directory.results() / "fields.pvd")) times.push_back(frame.time);
  return times;
}

TEST(Frames, HaveTheTimeThatTheCaseHas) {
  EXPECT_THAT(times_of(bar_case()), ElementsAre(testing::DoubleEq(6e-6), testing::DoubleEq(15e-6)));
  EXPECT_THAT(times_of(lasting_3_s(bar_case())), ElementsAre(testing::DoubleEq(1.2), testing::DoubleEq(3.0)));
  const std::string pressed =
      replaced(replaced(bar_case(), "\"0.015 mm\"", "\"-0.015 mm\""), frames_at, "frames_every = 5");
  EXPECT_THAT(times_of(pressed), ElementsAre(0.0, testing::DoubleEq(7.5e-6), testing::DoubleEq(15e-6)));
}

TEST(Frames, HaveTheTimeThatIsAskedFor) {
  EXPECT_THAT(times_of(with_output("time_value = \"load\"")), ElementsAre(0.4, 1.0));
  EXPECT_THAT(times_of(with_output("time_value = \"step\"")), ElementsAre(4.0, 10.0));
  EXPECT_THAT(times_of(lasting_3_s(with_output("time_value = \"displacement\""))),
              ElementsAre(testing::DoubleEq(6e-6), testing::DoubleEq(15e-6)));
}

TEST(Frames, StandInOneFileInTheirPlace) {
  const TemporaryCase directory(with_output("format = \"vtkhdf\""));
  const std::vector<std::string> command{"run", directory.path().string(), "--threads", "1"};
  const Outcome outcome = run(command);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("fields.vtkhdf"));
  EXPECT_EQ(frames_in(directory.results() / "fields.vtkhdf").size(), 2u);
  EXPECT_FALSE(fs::exists(directory.results() / "fields.pvd"));
  EXPECT_FALSE(fs::exists(directory.results() / "fields"));
  directory.write("case.toml", bar_case());
  ASSERT_EQ(run(command).status, 0);
  EXPECT_FALSE(fs::exists(directory.results() / "fields.vtkhdf"));
  EXPECT_EQ(read_pvd(directory.results() / "fields.pvd").size(), 2u);
}

TEST(Frames, InOneFileGiveTheSamePage) {
  nlohmann::json bodies[2];
  for (const bool in_one : {false, true}) {
    const TemporaryCase directory(with_output(in_one ? "format = \"vtkhdf\"" : "format = \"vtu\""));
    for (const char* command : {"run", "report"})
      ASSERT_EQ(run({command, directory.path().string(), "--threads", "1"}).status, 0);
    EXPECT_EQ(fs::exists(directory.results() / "fields.pvd"), !in_one);
    bodies[in_one] = data_of_page(content_of(directory.results() / "report" / "index.html"))["body"];
  }
  EXPECT_EQ(bodies[0]["frames"].size(), 2u);
  EXPECT_EQ(bodies[0], bodies[1]);
}

TEST(Frames, InOneFileAreContinuedByARestart) {
  const TemporaryCase directory(replaced(bar_case(), frames_at, "frames_every = 2\nformat = \"vtkhdf\""));
  const std::string place = directory.path().string();
  const fs::path whole = directory.path() / "whole", broken = directory.path() / "broken";
  ASSERT_EQ(run({"run", place, "--output", whole.string()}).status, 0);
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--max-steps", "4"}).status, 0);
  EXPECT_EQ(frames_in(broken / "fields.vtkhdf").size(), 3u);  // of the steps 0, 2, 4
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart"}).status, 0);
  EXPECT_EQ(frames_in(broken / "fields.vtkhdf"), frames_in(whole / "fields.vtkhdf"));
  EXPECT_TRUE(content_of(broken / "fields.vtkhdf") == content_of(whole / "fields.vtkhdf"));
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart"}).status, 0);  // nothing is left to be done
  EXPECT_EQ(frames_in(broken / "fields.vtkhdf"), frames_in(whole / "fields.vtkhdf"));
  EXPECT_FALSE(fs::exists(broken / "fields.pvd"));
}

class BadFrames : public testing::TestWithParam<BadInput> {};

TEST_P(BadFrames, AreRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(bar_case(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_frames[] = {
    {"unknown_time", frames_at, "time_value = \"loads\"", {"[output] time_value: ", "\"load\""}},
    {"time_without_duration",
     frames_at,
     "time_value = \"time\"",
     {"[output] time_value: this needs [loading] duration"}},
    {"displacement_that_may_fall",
     "curve = { patch = \"xmax\", component = \"x\" }\nframes_at = [\"0.006 mm\"]",
     "curve = { patch = \"xmax\", component = \"y\" }\ntime_value = \"displacement\"",
     {"[output] time_value: the displacement of the curve's patch is not prescribed by a plain quantity"}},
    {"load_that_may_fall",
     "maximum_increment = 0.1\n\n[output]\ncurve = { patch = \"xmax\", component = \"x\" }\nframes_at = [\"0.006 mm\"]",
     "maximum_dissipation = \"4 uJ\"\n\n[output]\ncurve = { patch = \"xmax\", component = \"x\" }\ntime_value = "
     "\"load\"",
     {"[output] time_value: with loading.maximum_dissipation the load may decrease"}},
    {"unknown_compression", frames_at, "compression = \"gzip\"", {"[output] compression: ", "zlib, lz4, none"}},
};

INSTANTIATE_TEST_SUITE_P(All, BadFrames, testing::ValuesIn(bad_frames),
                         [](const auto& bad) { return std::string(bad.param.name); });

TEST(Frames, OfARestartAreThoseOfAnUnbrokenRun) {
  const TemporaryCase directory(replaced(bar_case(), frames_at, "frames_every = 2"));
  const std::string place = directory.path().string();
  const fs::path whole = directory.path() / "whole", broken = directory.path() / "broken";
  ASSERT_EQ(run({"run", place, "--output", whole.string()}).status, 0);
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--max-steps", "4"}).status, 0);
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart"}).status, 0);
  for (const Frame& frame : read_pvd(whole / "fields.pvd"))
    EXPECT_TRUE(content_of(broken / frame.file) == content_of(whole / frame.file)) << frame.file;
}

// Two cubes with names of Gmsh.
constexpr const char* two_cubes = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
6
2 5 "front"
2 6 "back"
2 1 "left"
2 2 "right"
3 3 "soft"
3 4 "hard"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 0 1
8 1 0 1
9 2 0 1
10 0 1 1
11 1 1 1
12 2 1 1
$EndNodes
$Elements
8
5 3 2 5 3 1 2 5 4
6 3 2 5 3 2 3 6 5
7 3 2 6 4 7 8 11 10
8 3 2 6 4 8 9 12 11
1 3 2 1 1 1 4 10 7
2 3 2 2 2 3 6 12 9
3 5 2 3 1 1 2 5 4 7 8 11 10
4 5 2 4 2 2 3 6 5 8 9 12 11
$EndElements
)";

std::string gmsh_case() {
  std::string text = bar_case();
  const std::size_t begin = text.find("generator"), end = text.find("[materials.concrete]");
  text.replace(begin, end - begin, "generator = \"gmsh\"\nfile = \"cubes.msh\"\nlength_unit = \"mm\"\n\n");
  text = replaced(text, "[\"bar\", \"weak\"]", "[\"soft\", \"hard\"]");
  text = replaced(text, "[regions.weak]", "[regions.soft]");
  text =
      replaced(text, "displacement = [\"0 mm\", \"free\", \"free\"]", "displacement = [\"0 mm\", \"0 mm\", \"0 mm\"]");
  text = replaced(text, "[\"0.015 mm\", \"free\", \"free\"]", "[\"0.015 mm\", \"0 mm\", \"free\"]");
  text = replaced(text, "patch = \"xmin\"", "patch = \"left\"");
  text =
      replaced(replaced(text, "patch = \"xmax\"\n", "patch = \"right\"\n"), "patch = \"xmax\",", "patch = \"right\",");
  const std::size_t sides = text.find("[[boundary]]\npatches"), loading = text.find("[loading]");
  return text.replace(sides, loading - sides, "[[boundary]]\npatches = [\"front\", \"back\"]\ntype = \"plane\"\n\n");
}

TEST(GmshCase, IsCheckedByTheNamesOfItsGroups) {
  const TemporaryCase directory(gmsh_case());
  directory.write("cubes.msh", two_cubes);
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("region soft"), HasSubstr("region hard")));
  const TemporaryCase other(replaced(gmsh_case(), "patch = \"left\"", "patch = \"top\""));
  other.write("cubes.msh", two_cubes);
  const Outcome refused = run({"check", other.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("left"));
}

TEST(GmshCase, NamesAFileThatIsNone) {
  const TemporaryCase directory(gmsh_case());
  directory.write("cubes.msh", "no mesh");
  const Outcome refused = run({"check", directory.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("cubes.msh: in line 1: expected a section"));
}

}  // namespace
}  // namespace pfdm::this_file
