// What a page and the terminal tell of surfaces that debond, from records written by hand and from a shipped case.

#include "cases/program/fracture/outcome/end_of_run.h"
#include "cases/program/fracture/page/debonding_charts.h"
#include "cases/program/fracture/page/fracture_story.h"
#include "cases/program/fracture/page/law_chart.h"
#include "cases/program/input/case_files/case_file.h"
#include "physics/angle.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

namespace pfdm::this_file {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Vector up = Vector::UnitZ();

struct Bead {
  CaseFile file = open_case(std::filesystem::path(PFDM_CASES_DIR) / "glass_bead_quick");
  FractureCase fracture = read_fracture_case(file.config.root(), file.directory);
};

struct State {
  double separation, traction;  // [um], [MPa]
};

/// A sphere with a place at either pole and one between, that went through these states from the load on.
ColumnRecord record_of(const std::vector<std::vector<State>>& steps) {
  ColumnRecord record{.name = "skin", .places = {}, .steps = {}};
  for (const double angle : {5.0, 40.0, 175.0})
    record.places.push_back({.normal = Vector(std::sin(angle * degree), 0, std::cos(angle * degree)),
                             .polar_angle = angle * degree,
                             .area = 1e-9});
  for (const std::vector<State>& step : steps) {
    record.steps.emplace_back();
    for (const State& state : step)
      record.steps.back().push_back({.traction = Vector(1e6 * state.traction, 0, 0),
                                     .separation = Vector(1e-6 * state.separation, 0, 0),
                                     .largest_damage = state.separation > 50 ? 1.0 : 0.5});
  }
  return record;
}

std::vector<std::string> labels_of(const Chart& chart) {
  std::vector<std::string> labels;
  for (const Series& series : chart.series) labels.push_back(series.label);
  return labels;
}

// The place between falls from 7 of 14 MPa to nearly nothing, half of its strength.
TEST(DebondingPage, BreaksALawWhereItsTractionFallsWithinAStep) {
  const ColumnRecord record = record_of({{{0, 0}, {0, 0}, {0, 0}},
                                         {{2, 20}, {1, 14}, {3, 26}},
                                         {{1.5, 15}, {0.5, 7}, {200, 0.1}},
                                         {{1.6, 16}, {100, 0.2}, {250, 0.1}}});
  const Chart chart = law_chart(record, up);
  EXPECT_THAT(labels_of(chart), ElementsAre("lower pole, 165°–180°", "upper pole, 0°–15°", "30°–45°"));
  EXPECT_EQ(chart.series[0].style, SeriesStyle::line_with_points);
  EXPECT_EQ(chart.series[1].style, SeriesStyle::line);
  EXPECT_TRUE(chart.x.logarithmic);
  EXPECT_TRUE(std::isnan(chart.series[0].y[2]));
  EXPECT_EQ(chart.series[1].y.size(), 4u);  // it is unloaded
  ASSERT_EQ(chart.series[2].y.size(), 5u);
  EXPECT_TRUE(std::isnan(chart.series[2].y[3]));
}

TEST(DebondingPage, DrawsAnglesOfBothPolesOnceBesideWhatWasMeasured) {
  const ColumnRecord record = record_of({{{0, 0}, {0, 0}, {0, 0}}, {{1, 20}, {1, 14}, {200, 0.1}}});
  std::vector<CurveRow> curve(2);
  curve[1].displacement = 100e-6;
  const MeasuredAngle measured{
      .curve = {.name = "camera", .x = {0.0, 1e-4}, .y = {0.0, 1.0}}, .surface = {}, .at_positive = false};
  const Chart beside = debonding_chart(record, up, curve, {&measured, 1});
  EXPECT_EQ(beside.caption, "Debonding angle of \"skin\"");
  EXPECT_THAT(labels_of(beside), ElementsAre("camera", "lower pole, computed", "upper pole, computed"));
  EXPECT_NEAR(beside.series[1].y[1], std::acos(1.0 - 2.0 / 3.0) / degree, 1e-9);
  EXPECT_EQ(beside.series[2].y[1], 0.0);
  EXPECT_EQ(beside.series[1].colour, 0);
  EXPECT_THAT(labels_of(debonding_chart(record, Vector::UnitX(), curve, {})),
              ElementsAre("pole along the load", "pole against the load"));

  const Bead bead;
  ExperimentSettings experiment{.specimens = {}, .where = bead.file.config.root()};
  EXPECT_EQ(debonding_charts(bead.fracture, experiment, curve, {record}).size(), 1u);
  experiment.angles.push_back(measured);
  EXPECT_TRUE(debonding_charts(bead.fracture, experiment, curve, {record}).empty());
}

TEST(DebondingPage, GivesTheToughnessOfABandAsGivenAndAsItsCellsHaveIt) {
  const Bead bead;
  const Table table = material_table(bead.fracture);
  EXPECT_THAT(table.rows[0], ElementsAre("region", "E", "nu", "Gc [J/m²]", "in its band", "ell"));
  EXPECT_THAT(table.rows[1], ElementsAre("matrix", testing::_, "0.44", "10000", "-", testing::_));
  EXPECT_THAT(table.rows[2], ElementsAre("interface", testing::_, "0.44", "400", "275.8", testing::_));
  EXPECT_EQ(table.rows[3][3], "no damage");
}

// A glued joint has no poles.
TEST(DebondingPage, TellsNoPoleOfAFlatSurface) {
  ColumnRecord record =
      record_of({{{0, 0}, {0, 0}, {0, 0}}, {{2, 20}, {2, 20}, {2, 20}}, {{200, 0.1}, {200, 0.1}, {200, 0.1}}});
  for (Place& place : record.places) place.normal = up, place.polar_angle = 0.0;
  EXPECT_THAT(labels_of(law_chart(record, up)), ElementsAre("mean of all places"));
}

/// Of a surface with one law.
std::string words_of_law(const std::string& law, const std::string& is_flat = "") {
  const TemporaryCase results("");
  results.write("cohesive.json", R"({"surfaces": [{"name": "skin", "kind": "interface", "law_is_given": false, )" +
                                     is_flat + R"("laws": [{
      "polar_angle_from_deg": 165.0, "polar_angle_to_deg": 180.0, "strength_Pa": 2e7, "critical_separation_m": 4e-6,
      "surface_energy_J_per_m2": 300.0, )" +
                                     law + "}]}]}");
  const Bead bead;
  return what_happened(bead.fracture, bead.file, RunSummary(), results.path()).back();
}

TEST(DebondingPage, SaysWhatIsNotKnownOfALaw) {
  EXPECT_THAT(words_of_law(R"("traced": true, "jump_at_step": null, "final_traction_Pa": 1e5)"),
              testing::AllOf(HasSubstr("law of \"skin\" at the lower pole: largest normal traction 20"),
                             testing::EndsWith("surface energy 300 J/m^2")));
  EXPECT_THAT(words_of_law(R"("traced": true, "jump_at_step": null, "final_traction_Pa": 1e5)", R"("is_flat": true, )"),
              HasSubstr("law of \"skin\": largest normal traction 20"));
  EXPECT_THAT(words_of_law(R"("traced": false, "jump_at_step": 8, "final_traction_Pa": 1e5)"),
              HasSubstr("; the traction falls within one step, so that how it softens is not known"));
  EXPECT_THAT(
      words_of_law(R"("traced": false, "jump_at_step": null, "final_traction_Pa": 5e6)"),
      testing::EndsWith("; 5 MPa act at the end, so that its last part is not known and the energy a lower bound"));
  EXPECT_THAT(words_of_law(R"("traced": false, "jump_at_step": null, "final_traction_Pa": 1e6)"),
              HasSubstr("; the surface closes again"));
}

}  // namespace
}  // namespace pfdm::this_file
