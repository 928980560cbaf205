// The first debonding of a run, on a body of six columns, one along each axis.

#include "physics/angle.h"
#include "postproc/cohesive/first_debonding.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::test::this_file {
namespace {

const Vector axis = Vector::UnitZ();

/// Column k runs through cell k, k = 0 ... 5 for x, -x, y, -y, z, -z; each stands for 1 m^2.
std::vector<ColumnSet> six_columns() {
  ColumnSet set{.name = "band", .kind = SurfaceKind::interface, .columns = {}};
  for (Index k = 0; k < 6; ++k) {
    Column column{.normal = (k % 2 == 0 ? 1.0 : -1.0) * Vector::Unit(k / 2), .area = 1.0};
    column.segments.push_back({.cell = k, .length = 1.0});
    set.columns.push_back(std::move(column));
  }
  return {set};
}

CellField<double> damage_of(const std::vector<double>& values) {
  CellField<double> damage(values.size(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) damage[i] = values[i];
  return damage;
}

OutputFields no_output() { throw std::logic_error("there are no faces"); }

TEST(FirstDebonding, IsThatOfAPole) {
  const std::vector<ColumnSet> sets = six_columns();
  const DebondingWatch watch(sets, axis, damage_of({0, 0, 0, 0, 0, 0}));
  StepReport report;
  report.step = 7;
  EXPECT_FALSE(watch.look(damage_of({0.5, 0, 0, 0, 0.9, 0.95}), report, no_output));
  const auto first = watch.look(damage_of({0.5, 0, 0, 0, 0.9, 0.96}), report, no_output);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->surface, "band");
  EXPECT_EQ(first->step, 7);
  EXPECT_DOUBLE_EQ(first->polar_from, std::numbers::pi);
  EXPECT_DOUBLE_EQ(first->polar_to, std::numbers::pi);
  EXPECT_DOUBLE_EQ(first->angle, std::acos(2.0 / 3.0));  // a sixth of a sphere: 1 - cos = 1/3
}

// Five of six on the side of +z and about the equator: polar angles from 0 to 90 degrees.
TEST(FirstDebonding, SpansTheDebondedPlacesAboutOnePole) {
  const std::vector<ColumnSet> sets = six_columns();
  const DebondingWatch watch(sets, Vector(0.1, 0.2, 1.0).normalized(), damage_of({0, 0, 0, 0, 0, 0}));
  const auto first = watch.look(damage_of({1, 0, 1, 0, 1, 1}), {}, no_output);
  ASSERT_TRUE(first);
  const double norm = std::sqrt(1.05);
  EXPECT_NEAR(first->polar_from, std::acos(1.0 / norm), 1e-12);
  EXPECT_NEAR(first->polar_to, std::acos(0.1 / norm), 1e-12);
}

TEST(FirstDebonding, LeavesOutWhatWasBrokenFromTheStart) {
  const std::vector<ColumnSet> sets = six_columns();
  const DebondingWatch watch(sets, axis, damage_of({0, 0, 0, 0, 1, 0}));
  EXPECT_FALSE(watch.look(damage_of({0, 0, 0, 0, 1, 0}), {}, no_output));
  const auto first = watch.look(damage_of({0, 1, 0, 0, 1, 0}), {}, no_output);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->polar_from, 0.5 * std::numbers::pi, 1e-12);
}

// All columns of a flat band have the same normal.
TEST(FirstDebonding, HasNoAnglesOnAFlatBand) {
  std::vector<ColumnSet> sets = six_columns();
  for (Column& column : sets[0].columns) column.normal = axis;
  const auto first =
      DebondingWatch(sets, axis, damage_of({0, 0, 0, 0, 0, 0})).look(damage_of({1, 0, 0, 0, 0, 0}), {}, no_output);
  ASSERT_TRUE(first);
  EXPECT_TRUE(std::isnan(first->angle) && std::isnan(first->polar_from));
}

/// 0, 2, 4, 3 N at 0, 1, 2, 3 um.
std::vector<CurveRow> curve() {
  std::vector<CurveRow> rows(4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto step = static_cast<double>(i);
    rows[i].step = static_cast<Index>(i);
    rows[i].load = 0.25 * step;
    rows[i].displacement = 1e-6 * step;
    rows[i].force = Vector(0.0, 0.0, i < 3 ? 2.0 * step : 3.0);
  }
  return rows;
}

TEST(FirstDebonding, TellsTheStepsOnBothSides) {
  const FirstDebonding first{.surface = "band", .step = 3, .polar_from = 3.0, .polar_to = 3.1, .angle = 0.5};
  const auto figures = debonding_figures(first, curve(), 2);
  EXPECT_EQ(figures.at("first_debonding_displacement_m"), 2e-6);
  EXPECT_EQ(figures.at("first_debonding_force_N"), 4.0);
  EXPECT_EQ(figures.at("first_debonding_load"), 0.5);
  EXPECT_EQ(figures.at("first_debonding_displacement_after_m"), 3e-6);
  EXPECT_EQ(figures.at("first_debonding_force_after_N"), 3.0);
  EXPECT_DOUBLE_EQ(figures.at("first_debonding_angle_deg"), 0.5 / degree);
  const auto none = debonding_figures(std::nullopt, curve(), 2);
  EXPECT_EQ(none.size(), figures.size());
  for (const auto& [name, value] : none) EXPECT_TRUE(std::isnan(value)) << name;
}

TEST(FirstDebonding, IsKeptForARestart) {
  const TemporaryFolder folder;
  const auto file = folder / first_debonding_file;
  EXPECT_FALSE(take_first_debonding(file, 9));
  write_first_debonding(file, {.surface = "glue", .step = 3, .angle = 0.5});
  const auto again = take_first_debonding(file, 3);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->surface, "glue");
  EXPECT_EQ(again->angle, 0.5);
  EXPECT_TRUE(std::isnan(again->polar_from));
  EXPECT_FALSE(take_first_debonding(file, 2));  // the run goes on from before it
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace pfdm::test::this_file
