// --set KEY=VALUE.

#include "cases/program/input/case_files/case_override.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

/// The value at `key` as TOML, of the bar with these words.
std::string value_with(const std::vector<std::string>& words, const std::string& key) {
  const TemporaryCase directory(bar_case());
  const CaseFile file = with_overrides(open_case(directory.path()), words);
  return written(value_at(parse_toml(file.text, "case.toml"), key));
}

TEST(Overrides, ReplaceTextsNumbersAndElements) {
  EXPECT_EQ(value_with({"materials.concrete.young_modulus=40 GPa"}, "materials.concrete.young_modulus"), "\"40 GPa\"");
  EXPECT_EQ(value_with({"materials.concrete.young_modulus = \"40 GPa\""}, "materials.concrete.young_modulus"),
            "\"40 GPa\"");
  EXPECT_EQ(value_with({"materials.concrete.poisson_ratio=0.3"}, "materials.concrete.poisson_ratio"), "0.3");
  EXPECT_EQ(value_with({"mesh.x[0].cells=42"}, "mesh.x[0].cells"), "42");
  EXPECT_EQ(value_with({"boundary[1].displacement[0]=0.02 mm"}, "boundary[1].displacement[0]"), "\"0.02 mm\"");
  EXPECT_EQ(value_with({"title=12"}, "title"), "\"12\"");
  EXPECT_EQ(value_with({"title=a=b"}, "title"), "\"a=b\"");
  EXPECT_EQ(value_with({"mesh.x[0].cells=42", "mesh.x[0].cells=43"}, "mesh.x[0].cells"), "43");
}

TEST(Overrides, AddKeysThatTheFileLeavesOut) {
  EXPECT_EQ(value_with({"fracture.residual_stiffness=1e-7"}, "fracture.residual_stiffness"), "1e-07");
  EXPECT_EQ(value_with({"solver.maximum_iterations=7"}, "solver.maximum_iterations"), "7");
  EXPECT_EQ(value_with({"solver.maximum_iterations=7", "solver.damage_tolerance=1e-3"}, "solver.damage_tolerance"),
            "0.001");
  EXPECT_EQ(value_with({"boundary[2].pressure=1 MPa"}, "boundary[2].pressure"), "\"1 MPa\"");
  EXPECT_EQ(value_with({"boundary[1].traction=[\"free\", \"0 Pa\", \"free\"]"}, "boundary[1].traction[1]"), "\"0 Pa\"");
}

// Editors of Windows write one.
TEST(Overrides, TakeAByteOrderMark) {
  const TemporaryCase directory("\xEF\xBB\xBF" + bar_case());
  const CaseFile file = open_case(directory.path());
  for (const char* word : {"kind=fracture", "title=another", "sweep.method=product"})
    EXPECT_EQ(with_overrides(file, std::vector<std::string>{word}).text,
              with_overrides(with_text(file, bar_case()), std::vector<std::string>{word}).text);
}

TEST(Overrides, DecideWhatRuns) {
  const TemporaryCase directory(bar_case());
  const std::string place = directory.path().string();
  const Outcome whole = run({"run", place, "--set", "loading.end=0.5"});
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("complete at step 5, load 0.5"));
  EXPECT_THAT(whole.out, HasSubstr("next: pfdm report " + place + " --set 'loading.end=0.5'"));
  EXPECT_EQ(content_of(directory.path() / "case.toml"), bar_case());
  EXPECT_EQ(run({"report", place, "--set", "loading.end=0.5"}).status, 0);
}

// Each takes one word: what follows is a further one, or the case.
TEST(Overrides, MayBeRepeated) {
  const TemporaryCase directory(bar_case());
  const std::string place = directory.path().string();
  const Outcome whole =
      run({"run", "--set", "loading.end=0.5", "--set", "loading.initial_increment=0.05", place, "--quiet"});
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::string ran = content_of(directory.path() / "results" / "case.toml");
  EXPECT_THAT(ran, HasSubstr("end = 0.5"));
  EXPECT_THAT(ran, HasSubstr("initial_increment = 0.05"));
}

void expect_refused_word(const std::string& word, const std::string& message) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"check", directory.path().string(), "--set", word});
  EXPECT_EQ(outcome.status, 2) << word;
  EXPECT_THAT(outcome.err, HasSubstr(message));
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
}

TEST(Overrides, ListsTakeThePlaceOfLists) {
  EXPECT_EQ(with_value("a = [1, \"]\", # ]\n  [2, '[']]  # last\nb = 3\n", "a", "[4, [5]]"),
            "a = [4, [5]]  # last\nb = 3\n");
  EXPECT_EQ(with_value("x = [[1], [2]]\n", "x[1]", "[7]"), "x = [[1], [7]]\n");
  EXPECT_EQ(with_value("x = [\n  [1],\n]\n", "x[0]", "[7]"), "x = [\n  [7],\n]\n");
  EXPECT_THROW(with_value("[[x]]\ny = 1\n", "x", "[{ y = 2 }]"), InputError);
  EXPECT_THROW(with_value("  [[x]]\ny = 1\n", "x", "[{ y = 2 }]"), InputError);
  EXPECT_EQ(value_with({R"(boundary[1].displacement=["1 mm", "free", "free"])"}, "boundary[1].displacement"),
            R"(["1 mm","free","free",])");
}

TEST(Overrides, TablesTakeThePlaceOfTables) {
  EXPECT_EQ(with_value("a = { b = \"}\", c = [1, { d = 2 }] }  # last\n", "a", "{ e = 3 }"), "a = { e = 3 }  # last\n");
  EXPECT_EQ(with_value("x = [{ y = 1 }, { y = 2 }]\n", "x[1]", "{ z = 3 }"), "x = [{ y = 1 }, { z = 3 }]\n");
  EXPECT_EQ(value_with({"mesh.x[0]={ length = \"5 mm\", cells = 3 }"}, "mesh.x[0]"),
            "{\"length\"=\"5 mm\",\"cells\"=3,}");
  EXPECT_EQ(value_with({"loading={ end = 0.5 }"}, "loading"), "{\"end\"=0.5,}");
  EXPECT_EQ(value_with({"loading={ end = 0.5 }", "loading={ end = 0.25 }"}, "loading"), "{\"end\"=0.25,}");
}

// Lines are those of the file; what is not in it has none.
TEST(Overrides, KeepTheNumbersOfLines) {
  const TemporaryCase directory(bar_case());
  const auto refused_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"check", directory.path().string()};
    for (const std::string& word : more) words.insert(words.end(), {"--set", word});
    const std::string message = run(words).err;
    return message.substr(message.find("case.toml"));
  };
  const std::string text = bar_case();
  const auto line_of = [&](const std::string& key) {
    return fmt::format("case.toml with --set:{}: ",
                       1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(key)), '\n'));
  };
  EXPECT_THAT(refused_with({"fracture.length=2 MPa"}), testing::StartsWith(line_of("length = \"4 mm\"")));
  EXPECT_THAT(refused_with({"mesh.x[0]={ length = \"3 MPa\", cells = 3 }"}),
              testing::StartsWith("case.toml with --set:"));
  EXPECT_THAT(refused_with({"fracture.residual_stiffness=7", "fracture.length=2 MPa"}),
              testing::StartsWith("case.toml with --set"));
  EXPECT_THAT(refused_with({"fracture.residual_stiffness=1e-7", "fracture.length=2 MPa"}),
              testing::StartsWith(line_of("length = \"4 mm\"")));
  EXPECT_THAT(refused_with({"fracture.residual_stiffness=7"}),
              testing::StartsWith("case.toml with --set: [fracture] residual_stiffness: "));
  EXPECT_THAT(refused_with({"fracture.lenght=1 mm"}),
              testing::StartsWith("case.toml with --set: [fracture] \"lenght\""));
}

TEST(Overrides, SayWhatIsWrong) {
  expect_refused_word("mesh.x[0].missing=7 mm",
                      "or set the table that holds it as a whole, mesh.x[0]={ missing = ... }");
  expect_refused_word("materials.concrete.shear_branches[0].modulus=7 MPa",
                      "the case has no materials.concrete.shear_branches; a list is given as a whole, as "
                      "materials.concrete.shear_branches=[{ modulus = ... }]");
  expect_refused_word("fracture.model=PF-CZM", "; did you mean \"Wu\"?");
  expect_refused_word("materials.concrete.driven_by=equilibrium",
                      "\"driven_by\" is not known here: it belongs to law = \"prony\", \"neo_hookean\", ");
  expect_refused_word("loading.end", "--set loading.end: expected KEY=VALUE, as in");
  expect_refused_word("=3", "expected KEY=VALUE");
  expect_refused_word("mesh.x[3].cells=3", "--set mesh.x[3].cells: ");
  expect_refused_word("mesh.x=3", "\"mesh.x\" is a list: expected one, as [...]");
  expect_refused_word(
      "boundary=[]",
      "\"boundary\" is a list of 4 tables; their keys can be set, as boundary[0].patch; tables are added");
  expect_refused_word("boundary[0]=1", "\"boundary[0]\" is a table; its keys can be set, as boundary[0].patch");
  expect_refused_word("materials=1", "\"materials\" is a table; its keys can be set, as materials.concrete.regions");
  expect_refused_word("output.frames_at=3", "\"output.frames_at\" is a list: expected one");
  expect_refused_word("boundary.patch=xmin", "boundary is a list: name one of its elements, as boundary[0].patch");
  expect_refused_word("fracture.lenght=2 mm", "did you mean \"length\"?");
  expect_refused_word("fracture.length=2 MPa", "case.toml with --set");
  expect_refused_word("materials.concrete.young_modulus=30", "has no unit");
}

}  // namespace
}  // namespace pfdm::this_file
