// Cohesive interfaces in case files: what they do, where they are written, and what is refused.

#include "cases/program/fracture/page/fracture_pictures.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/fields/pvd.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace pfdm::this_file {
namespace {

CsvTable curve_of(const TemporaryCase& directory) { return read_csv(directory.results() / "force_displacement.csv"); }

// u = delta + 2 L T/E, T = strength (1 - delta/delta_f).
void expect_linear_softening(const TemporaryCase& directory, double precision) {
  const CsvTable curve = curve_of(directory);
  const double compliance = 2e-3 / 1e9, final_opening = 2.0 * toughness / strength;
  ASSERT_EQ(curve.n_rows(), 11U);
  for (std::size_t i = 1; i < 11; ++i) {
    const double u = curve.column("displacement_m")[i];
    const double opening = (u - compliance * strength) / (1.0 - compliance * strength / final_opening);
    const double due = 1e-6 * strength * std::max(0.0, 1.0 - opening / final_opening);
    EXPECT_NEAR(curve.column("force_x_N")[i], due, precision * 1e-6 * strength) << i;
  }
}

TEST(Interfaces, OpenByTheirLawAndTellOfIt) {
  const TemporaryCase directory(glued_blocks(linear_glue + "name = \"glue\"\n"));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_linear_softening(directory, 1e-3);
  const CsvTable curve = curve_of(directory);
  EXPECT_NEAR(curve.column("interface_dissipation_J").back(), 1e-6 * toughness, 1e-6 * 1e-6 * toughness);
  const std::vector<Frame> frames = read_pvd(directory.results() / "interfaces.pvd");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames.back().file, "interfaces/step_000010.vtu");
  const std::string frame = content_of(directory.results() / frames.back().file);
  for (const char* field : {"opening", "separation", "traction", "damage", "interface"})
    EXPECT_NE(frame.find(fmt::format("Name=\"{}\"", field)), std::string::npos) << field;
}

std::vector<PageBlock> pictures_of(const TemporaryCase& directory) {
  return interface_pictures(read_curve(directory.results() / "force_displacement.csv"), directory.results());
}

TEST(Interfaces, AreSeenAcrossTheirThinnestSide) {
  const TemporaryCase directory(glued_blocks(linear_glue));
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const std::vector<PageBlock> pictures = pictures_of(directory);
  ASSERT_EQ(pictures.size(), 2U);  // half way, and broken
  for (const bool last : {false, true}) {
    const auto& picture = std::get<Picture>(pictures[last ? 1 : 0]);
    EXPECT_NE(picture.caption.find("seen along x"), std::string::npos) << picture.caption;
    EXPECT_EQ(picture.x_title, "y [mm]");
    EXPECT_EQ(picture.y_title, "z [mm]");
    ASSERT_EQ(picture.cells.size(), 4U);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Picture::Cell& cell : picture.cells) {
      ASSERT_EQ(cell.corners.size(), 4U);
      for (const Eigen::Vector2d& corner : cell.corners) sum += corner / 16.0;
      if (last)
        EXPECT_EQ(cell.value, 1.0);
      else
        EXPECT_TRUE(cell.value > 0.0 && cell.value < 1.0) << cell.value;
    }
    EXPECT_NEAR((sum - Eigen::Vector2d(0.5, 0.5)).norm(), 0.0, 1e-6);
  }
}

TEST(Interfaces, ThatAreStripsAreAChart) {
  std::string text = glued_blocks(linear_glue);
  for (const auto& [from, to] :
       {std::pair{"y = [{ length = \"1 mm\", cells = 2 }]", "y = [{ length = \"1 mm\", cells = 5 }]"},
        std::pair{"z = [{ length = \"1 mm\", cells = 2 }]", "z = [{ length = \"10 um\", cells = 1 }]"}})
    text = replaced(text, from, to);
  const TemporaryCase directory(text);
  ASSERT_EQ(run({"run", directory.path().string(), "--max-steps", "5"}).status, 0);
  const std::vector<PageBlock> pictures = pictures_of(directory);
  ASSERT_EQ(pictures.size(), 1U);
  const auto& chart = std::get<Chart>(pictures.front());
  EXPECT_EQ(chart.x.title, "y [mm]");
  const Series& last = chart.series.back();
  ASSERT_EQ(last.x.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(last.x[i], 0.1 + 0.2 * static_cast<double>(i), 1e-6);
  EXPECT_TRUE(std::ranges::all_of(last.y, [](double d) { return d > 0.0 && d < 1.0; }));
}

TEST(Interfaces, GoOnFromACheckpoint) {
  const TemporaryCase whole(glued_blocks(linear_glue)), parts(glued_blocks(linear_glue));
  ASSERT_EQ(run({"run", whole.path().string()}).status, 0);
  ASSERT_EQ(run({"run", parts.path().string(), "--max-steps", "4"}).status, 0);
  ASSERT_EQ(run({"run", parts.path().string(), "--restart"}).status, 0);
  EXPECT_EQ(content_of(parts.results() / "force_displacement.csv"),
            content_of(whole.results() / "force_displacement.csv"));
  EXPECT_EQ(read_pvd(parts.results() / "interfaces.pvd"), read_pvd(whole.results() / "interfaces.pvd"));
}

// Blocks so soft that the end moves back while the face softens: 2 L/E = 1e-10 m/Pa is twice the law's 2 Gc/strength^2.
std::string blocks_that_snap_back() {
  std::string text = glued_blocks(linear_glue);
  text = replaced(text, "young_modulus = \"1 GPa\"", "young_modulus = \"20 MPa\"");
  text = replaced(text, "displacement = [\"0.12 mm\"", "displacement = [\"0.25 mm\"");
  return replaced(text, "maximum_increment = 0.1\n", "maximum_increment = 0.1\nmaximum_dissipation = \"10 uJ\"\n");
}

TEST(Interfaces, SnapBackAlongTheirLaw) {
  const TemporaryCase directory(blocks_that_snap_back());
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = curve_of(directory);
  const std::vector<double>&u = curve.column("displacement_m"), &force = curve.column("force_x_N");
  // The rise of the rigid interface is 1000 times as stiff as the two half cells of 125 um beside it.
  const double compliance = 2e-3 / 20e6, rise = strength * 0.25e-3 / 20e6 / 1000.0, last = 2.0 * toughness / strength;
  double furthest_back = u.back();
  for (std::size_t i = 1; i < curve.n_rows(); ++i) {
    const double traction = 1e6 * force[i], opening = u[i] - compliance * traction;
    const double due = strength * (opening < rise ? opening / rise : std::max(0.0, (last - opening) / (last - rise)));
    EXPECT_NEAR(traction, due, 1e-3 * strength) << i;
    if (curve.column("interface_dissipation_J")[i] > 1e-9 * 1e-6 * toughness)
      furthest_back = std::min(furthest_back, u[i]);
  }
  EXPECT_NEAR(furthest_back, last, 1e-3 * last);
  EXPECT_NEAR(curve.column("interface_dissipation_J").back(), 1e-6 * toughness, 1e-6 * 1e-6 * toughness);
}

TEST(Interfaces, GoOnAlongASnapBackFromACheckpoint) {
  const TemporaryCase whole(blocks_that_snap_back());
  ASSERT_EQ(run({"run", whole.path().string()}).status, 0);
  const std::vector<double> u = curve_of(whole).column("displacement_m");
  const auto peak = static_cast<std::size_t>(std::ranges::adjacent_find(u, std::greater<>()) - u.begin());
  ASSERT_LT(peak + 3, u.size());
  for (const std::size_t step : {peak, peak + 2}) {  // the next step leads back; the last one did
    const TemporaryCase parts(blocks_that_snap_back());
    ASSERT_EQ(run({"run", parts.path().string(), "--max-steps", fmt::format("{}", step)}).status, 0);
    ASSERT_EQ(run({"run", parts.path().string(), "--restart"}).status, 0);
    EXPECT_EQ(content_of(parts.results() / "force_displacement.csv"),
              content_of(whole.results() / "force_displacement.csv"));
    EXPECT_EQ(read_pvd(parts.results() / "interfaces.pvd"), read_pvd(whole.results() / "interfaces.pvd"));
  }
}

TEST(Interfaces, AreNotLedBackBesideDamage) {
  const TemporaryCase directory(
      replaced(blocks_that_snap_back(), "damageable = false", "toughness = \"1 kJ/m^2\"\nlength = \"1 mm\""));
  expect_refused(directory, {.name = "path",
                             .good = "",
                             .bad = "",
                             .message = {"loading.maximum_dissipation",
                                         "cohesive interfaces only where no region is "
                                         "damageable"}});
}

TEST(Interfaces, TakeAnExtractedLawFromItsTable) {
  const std::string rise = "1e-9";  // the elastic part of the table
  const TemporaryCase directory(
      glued_blocks("plane = { point = [\"1 mm\", \"0 mm\", \"0 mm\"], normal = [1, 0, 0] }\nlaw = \"table\"\n"
                   "table = \"cohesive_law.csv\"\n"));
  directory.write("cohesive_law.csv",
                  "separation_m,traction_Pa,step\n0,0,0\n" + rise + ",2e6,1\n4e-5,1.2e6,2\n3e-5,0.9e6,3\n1e-4,0,4\n");
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_linear_softening(directory, 1e-4);
}

TEST(Interfaces, ScatterByTheirSeed) {
  const auto forces = [](int seed) {
    const TemporaryCase directory(glued_blocks(
        linear_glue + fmt::format("strength_scatter = {{ coefficient = 0.2, correlation_length = \"0.3 mm\", seed = {} "
                                  "}}\ntoughness_scatter = {{ coefficient = 0.1, correlation_length = \"0.3 mm\", seed "
                                  "= 5 }}\n",
                                  seed)));
    const Outcome outcome = run({"run", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return curve_of(directory).column("force_x_N");
  };
  const std::vector<double> first = forces(1);
  EXPECT_EQ(forces(1), first);
  EXPECT_GT(std::abs(forces(2)[3] / first[3] - 1.0), 1e-3);
}

class BadInterface : public testing::TestWithParam<BadInput> {};

TEST_P(BadInterface, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(glued_blocks(linear_glue), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_inputs[] = {
    {"no_place",
     "between = [\"left\", \"right\"]\n",
     "",
     {"[interface]", "either between = [\"region\", \"region\"], or plane"}},
    {"unknown_region",
     "between = [\"left\", \"right\"]",
     "between = [\"left\", \"middle\"]",
     {"middle", "left, right"}},
    {"nothing_there",
     "between = [\"left\", \"right\"]",
     "between = [\"left\", \"right\"]\nwhere = \"y > 1\"",
     {"[interface]", "no face of the mesh is there"}},
    {"regions_apart",
     "upper = [\"3 mm\", \"2 mm\", \"2 mm\"]\n[materials.stone]\nregions = [\"left\", \"right\"]",
     "upper = [\"3 mm\", \"2 mm\", \"2 mm\"]\n[[mesh.regions]]\nname = \"middle\"\nlower = [\"0.7 mm\", \"-1 mm\", "
     "\"-1 mm\"]\nupper = [\"1.3 mm\", \"2 mm\", \"2 mm\"]\n[materials.stone]\nregions = [\"left\", \"right\", "
     "\"middle\"]",
     {"[interface]", "no face of the mesh is there"}},
    {"region_with_itself",
     "between = [\"left\", \"right\"]",
     "between = [\"left\", \"left\"]",
     {"[interface]", "between", "two different regions"}},
    {"plane_beside_the_body",
     "between = [\"left\", \"right\"]",
     "plane = { point = [\"9 mm\", \"0 mm\", \"0 mm\"], normal = [1, 0, 0] }",
     {"[interface]", "no face of the mesh is there"}},
    {"plane_between_faces",
     "between = [\"left\", \"right\"]",
     "plane = { point = [\"1.1 mm\", \"0 mm\", \"0 mm\"], normal = [1, 0, 0] }",
     {"[interface]", "no face of the mesh is there"}},
    {"plane_without_a_normal",
     "between = [\"left\", \"right\"]",
     "plane = { point = [\"1 mm\", \"0 mm\", \"0 mm\"], normal = [0, 0, 0] }",
     {"normal", "a direction must not be zero"}},
    {"negative_strength", "strength = \"2 MPa\"", "strength = \"-2 MPa\"", {"strength", "positive"}},
    {"no_strength", "strength = \"2 MPa\"", "strength = \"0 MPa\"", {"strength", "positive"}},
    {"infinite_strength", "strength = \"2 MPa\"", "strength = \"inf MPa\"", {"strength"}},
    {"strength_that_is_no_number", "strength = \"2 MPa\"", "strength = \"nan MPa\"", {"strength"}},
    {"strength_without_a_unit", "strength = \"2 MPa\"", "strength = 2e6", {"strength"}},
    {"negative_toughness", "toughness = \"100 J/m^2\"", "toughness = \"-1 J/m^2\"", {"toughness", "positive"}},
    {"no_toughness", "toughness = \"100 J/m^2\"", "toughness = \"0 J/m^2\"", {"toughness", "positive"}},
    {"infinite_toughness", "toughness = \"100 J/m^2\"", "toughness = \"inf J/m^2\"", {"toughness"}},
    {"strength_negative_somewhere",
     "strength = \"2 MPa\"",
     "strength = { expr = \"1 - y / 4e-4\", unit = \"MPa\" }",
     {"strength", "must be positive"}},
    {"toughness_infinite_somewhere",
     "toughness = \"100 J/m^2\"",
     "toughness = { expr = \"1 / (x - x)\", unit = \"J/m^2\" }",
     {"toughness"}},
    {"unknown_law", "law = \"linear\"", "law = \"linaer\"", {"linaer", "linear", "table"}},
    {"parameter_of_another_law", "law = \"linear\"", "law = \"linear\"\nalpha = 3", {"alpha"}},
    {"too_soft", "law = \"linear\"", "law = \"linear\"\nstiffness = \"1e9 Pa/m\"", {"interface_1", "20 GPa/m"}},
    {"stiffness_of_another_dimension",
     "law = \"linear\"",
     "law = \"linear\"\nstiffness = \"1 GPa\"",
     {"stress per length", "1e12 Pa/m"}},
    {"mode_without_shear_strength",
     "law = \"linear\"",
     "law = \"linear\"\nmixed_mode = \"benzeggagh_kenane\"",
     {"\"shear_strength\" is missing"}},
    {"mode_without_a_rise",
     "law = \"linear\"",
     "law = \"xu_needleman\"\nmixed_mode = \"power_law\"",
     {"a law with a straight rise", "xu_needleman"}},
    {"potential_of_another_law",
     "law = \"linear\"",
     "law = \"linear\"\nmixed_mode = \"xu_needleman\"",
     {"mixed_mode", "potential of the law \"xu_needleman\"", "linear"}},
    {"potential_without_shear_strength",
     "law = \"linear\"",
     "law = \"xu_needleman\"\nmixed_mode = \"xu_needleman\"",
     {"\"shear_strength\" is missing"}},
    {"potential_tougher_in_shear",
     "law = \"linear\"",
     "law = \"xu_needleman\"\nmixed_mode = \"xu_needleman\"\nshear_strength = \"2 MPa\"\nshear_toughness = \"101 "
     "J/m^2\"",
     {"shear_toughness", "more than the toughness in opening, 100 J/m^2"}},
};

INSTANTIATE_TEST_SUITE_P(All, BadInterface, testing::ValuesIn(bad_inputs),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pfdm::this_file
