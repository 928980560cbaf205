#include "postproc/cohesive/cohesive_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::test::this_file {
namespace {

ColumnSample sample(double traction, double separation, double damage) {
  return {.traction = Vector(traction, 0.0, 0.0), .separation = Vector(separation, 0.0, 0.0), .largest_damage = damage};
}

// A record of an interface with a place for each history, at the polar angles given [rad].
ColumnRecord record_of(const std::vector<double>& angles, const std::vector<std::vector<ColumnSample>>& histories) {
  ColumnRecord record{.name = "band", .places = {}, .steps = {}};
  for (const double angle : angles) record.places.push_back({.polar_angle = angle, .area = 2.0});
  for (std::size_t step = 0; step < histories.front().size(); ++step) {
    record.steps.emplace_back();
    for (const auto& history : histories) record.steps.back().push_back(history[step]);
  }
  return record;
}

const std::vector<ColumnSample> breaks{sample(0, 0, 0), sample(4, 1e-6, 0.3), sample(2, 5e-6, 0.8), sample(0, 9e-6, 1)};
const std::vector<ColumnSample> snaps{sample(0, 0, 0), sample(4, 1e-6, 0.3), sample(0, 9e-6, 1), sample(0, 12e-6, 1)};
// Its separation is the discretisation's error.
const std::vector<ColumnSample> holds{sample(0, 0, 0), sample(8, -1e-7, 0), sample(9, -2e-7, 0.005),
                                      sample(1, 0, 0.005)};
// The load goes elsewhere.
const std::vector<ColumnSample> unloads{sample(0, 0, 0), sample(4, 1e-6, 0.3), sample(4.1, 1.1e-6, 0.3),
                                        sample(0.1, 0.1e-6, 0.3)};

TEST(CohesiveLaw, leaves_out_places_that_were_never_damaged) {
  const ColumnRecord record = record_of({0.1, 0.1, 1.5}, {breaks, holds, holds});
  EXPECT_TRUE(was_damaged(record, 0));
  EXPECT_FALSE(was_damaged(record, 1));
  EXPECT_EQ(n_never_damaged(record), 2u);
  const std::vector<CohesiveLaw> laws = averaged_laws(record);
  ASSERT_EQ(laws.size(), 1u);
  EXPECT_EQ(laws.front().places, std::vector<std::size_t>{0});
  EXPECT_EQ(laws.front().area, 2.0);
  EXPECT_EQ(figures_of(record, laws.front()).strength, 4.0);
  EXPECT_TRUE(averaged_laws(record_of({0.1, 1.5}, {holds, holds})).empty());
}

TEST(CohesiveLaw, leaves_out_a_plane_that_was_never_damaged) {
  ColumnRecord record = record_of({0.0}, {holds});
  record.kind = SurfaceKind::plane;
  EXPECT_TRUE(averaged_laws(record).empty());
}

TEST(CohesiveLaw, jumps_where_the_traction_falls_while_it_opens) {
  const ColumnRecord record = record_of({0.1}, {snaps});
  const CohesiveFigures figures = figures_of(record, averaged_laws(record).front());
  ASSERT_TRUE(figures.jump);
  EXPECT_EQ(*figures.jump, 2u);
  EXPECT_FALSE(figures.is_traced());
  EXPECT_TRUE(std::isnan(figures.normal_energy));
  EXPECT_DOUBLE_EQ(figures.energy_at_least, 2e-6);
}

TEST(CohesiveLaw, is_traced_down_to_the_end) {
  const ColumnRecord record = record_of({0.1}, {breaks});
  const CohesiveFigures figures = figures_of(record, averaged_laws(record).front());
  EXPECT_TRUE(figures.is_traced());
  EXPECT_DOUBLE_EQ(figures.normal_energy, 2e-6 + 12e-6 + 4e-6);
}

// What an AT2 crack with damage 0.95 has dissipated, 0.9025 of the toughness.
TEST(CohesiveLaw, counts_cohesive_faces_by_what_they_dissipated) {
  ColumnRecord record = record_of({0.1, 3.0}, {{sample(0, 1e-6, 0.91)}, {sample(0, 1e-6, 0.89)}});
  EXPECT_EQ(debonding_of(record).front().area, 0.0);
  record.is_cohesive = true;
  const Debonding debonding = debonding_of(record).front();
  EXPECT_EQ(debonding.area, 2.0);
  EXPECT_NEAR(debonding.angle_plus, std::numbers::pi / 2, 1e-12);  // half of the whole surface
  EXPECT_EQ(debonding.angle_minus, 0.0);
}

// No jump, although the traction drops within a step, and not traced, although none is left.
TEST(CohesiveLaw, tells_unloading_from_a_jump) {
  const ColumnRecord record = record_of({0.1}, {unloads});
  const CohesiveFigures figures = figures_of(record, averaged_laws(record).front());
  EXPECT_FALSE(figures.jump);
  EXPECT_TRUE(figures.unloaded);
  EXPECT_FALSE(figures.is_traced());
  EXPECT_NEAR(figures.normal_energy, 2e-6 + 0.405e-6 - 2.1e-6, 1e-18);
}

}  // namespace
}  // namespace pfdm::test::this_file
