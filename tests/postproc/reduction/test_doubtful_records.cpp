// Data reduction of records with a toe, a failure, noise or crack lengths that are read too long.

#include "postproc/reduction/reduced_test.h"
#include "postproc/reduction/reduction_results.h"
#include "tests/postproc/reduction/synthetic_tests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm::this_file {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double E = 130e9, b = 25e-3, h = 1.5e-3, a0 = 50e-3, delta = 2.7e-3, Gc = 280.0;

TestDimensions laminate() {
  return {.width = b, .thickness = 2.0 * h, .crack_length = a0, .transverse_modulus = 9e9, .shear_modulus = 5e9};
}

double beam_compliance(double a) { return 8.0 * std::pow(a + delta, 3) / (E * b * h * h * h); }

TestRecord beam_record() { return SyntheticTest{beam_compliance, b, Gc}.record(a0, 90e-3); }

const ReducedByMethod& by(const ReducedTest& test, std::string_view name) {
  return *std::ranges::find(test.methods, name, &ReducedByMethod::name);
}

ReducedTest reduced(const TestRecord& record, const TestDimensions& dimensions = laminate(), std::size_t specimen = 0) {
  return reduced_test(reduced_specimens()[specimen], record, dimensions, "synthetic");
}

double slack_of(const TestRecord& record) { return 0.1 * record.displacement[50]; }

void expect_same_methods(const ReducedTest& found, const ReducedTest& due, double tolerance) {
  for (const ReducedByMethod& method : due.methods) {
    const ReducedByMethod& other = by(found, method.name);
    ASSERT_EQ(other.points.size(), method.points.size()) << method.name;
    EXPECT_NEAR(other.five_percent.toughness, method.five_percent.toughness, tolerance * Gc) << method.name;
    EXPECT_NEAR(other.propagation.toughness, method.propagation.toughness, tolerance * Gc) << method.name;
    for (std::size_t i = 0; i < method.constants.size(); ++i)
      EXPECT_NEAR(other.constants[i].value / method.constants[i].value, 1.0, tolerance) << method.name;
  }
}

TEST(DoubtfulRecords, CountDisplacementsFromTheOriginInAllMethods) {
  const TestRecord record = beam_record();
  TestRecord moved = record;
  for (double& d : moved.displacement) d += slack_of(record);
  const ReducedTest found = reduced(moved);
  expect_same_methods(found, reduced(record), 1e-9);
  EXPECT_NEAR(found.straight.origin, 0.0, 1e-12);
  EXPECT_THAT(found.remarks, Contains(HasSubstr("taken as the origin")));
}

TEST(DoubtfulRecords, AreNotCalibratedByRowsAfterTheFailure) {
  TestRecord record = beam_record();
  const ReducedTest due = reduced(record);
  for (int i = 0; i < 20; ++i) {  // 1 % of the force is left, and the last crack length
    record.displacement.push_back(1.01 * record.displacement.back());
    record.force.push_back(0.01 * record.force[50]);
    record.crack_length.push_back(record.crack_length.back());
  }
  expect_same_methods(reduced(record), due, 1e-9);
}

TEST(DoubtfulRecords, OfCrackLengthsTooLongHaveNoCorrection) {
  TestRecord record = beam_record();
  for (double& a : record.crack_length) a += 4e-3;  // 1.3 mm more than the beam turns at its root
  const ReducedTest found = reduced(record);
  EXPECT_EQ(by(found, "modified_beam_theory").constants[0].value, 0.0);
  EXPECT_THAT(found.remarks, Contains(AllOf(HasSubstr("crack lengths look too long"), HasSubstr("1.3 mm"))));
  EXPECT_THAT(reduced(beam_record()).remarks, Not(Contains(HasSubstr("too long"))));
}

/// Straight to 100 N at 1 mm, then with a tenth of the slope to 2 mm.
TestRecord bent_record() {
  TestRecord record;
  for (int i = 0; i <= 200; ++i) {
    const double u = 1e-5 * i;
    record.displacement.push_back(u);
    record.force.push_back(u <= 1e-3 ? 1e5 * u : 100.0 + 1e4 * (u - 1e-3));
  }
  return record;
}

TEST(DoubtfulRecords, CrossTheSecantWhereTheyStayBelowIt) {
  TestRecord record = bent_record();
  record.force[70] *= 0.9;  // one reading, on the straight part
  const double secant = 90.0 / (1e5 / 1.05 - 1e4);
  EXPECT_NEAR(five_percent_or_greatest(record, straight_part(record)).displacement, secant, 1e-8);
}

TEST(DoubtfulRecords, BeginBehindTheRowBeforeInitiation) {
  const ReducedTest found = reduced(bent_record());
  const ReducedByMethod& method = by(found, "equivalent_crack");
  ASSERT_FALSE(method.points.empty());
  EXPECT_GT(found.record.displacement[method.points.front().row], found.five_percent.displacement);
}

TEST(DoubtfulRecords, SeeTheCrackWhereItIsLongerThanAtFirst) {
  TestRecord record = beam_record();
  for (std::size_t i = 0; i < 50; ++i) record.crack_length[i] = a0;
  EXPECT_EQ(reduced(record).visual->row, 51U);
  TestRecord early = beam_record();
  early.crack_length[45] = 50.2e-3;  // read before the record leaves its line
  EXPECT_EQ(reduced(early).visual->row, 45U);
}

TEST(DoubtfulRecords, NeedBothDimensionsOfTheBlocks) {
  TestRecord record = beam_record();
  for (double& d : record.displacement) d *= 30.0;
  TestDimensions half = laminate();
  half.block_offset = 5e-3;
  EXPECT_THAT(reduced(record, half).remarks, Contains(HasSubstr("F of the standard takes")));
}

TestDimensions compact(double a) {
  return {.width = 10e-3, .crack_length = a, .depth = 20e-3, .young_modulus = 3e9, .poisson_ratio = 0.35};
}

// ASTM E399, 9.1.1: the secant has 95 % of the slope; P_Q is an earlier force, if that is larger.
TEST(CompactSpecimens, HaveTheSecantOfTheStandard) {
  const double secant = 90.0 / (0.95e5 - 1e4);
  EXPECT_NEAR(reduced(bent_record(), compact(10e-3), 3).five_percent.displacement, secant, 1e-8);
  TestRecord pop_in = bent_record();
  pop_in.force[100] = 104.0;  // larger than at the secant, 100.6 N
  EXPECT_EQ(reduced(pop_in, compact(10e-3), 3).five_percent.force, 104.0);
}

TEST(CompactSpecimens, SayWhereTheFactorIsOutOfItsRange) {
  EXPECT_THAT(reduced(bent_record(), compact(3e-3), 3).remarks, Contains(HasSubstr("a/W = 0.15")));
  EXPECT_THAT(reduced(bent_record(), compact(4.1e-3), 3).remarks, Not(Contains(HasSubstr("a/W"))));
}

}  // namespace
}  // namespace pfdm::this_file
