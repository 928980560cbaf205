// Records with one thing wrong each, and a good one with nothing wrong.

#include "solver/vibration/diagnosis/vibration_checks.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace pfdm::this_file {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

RawRecord good_record() {
  const Excitation shaker = swept_sine({.amplitude = 20.0, .from = 20, .to = 100, .duration = 10.0, .ramp = 0.2});
  const Index n = 10000;
  RawRecord r{.time = VectorXd(n),
              .base = VectorXd(n),
              .relative = VectorXd(n),
              .rate = 1000.0,
              .band_low = 20.0,
              .band_high = 100.0};
  const VectorXd noise = normal_numbers(2 * n, 1);
  for (Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / 1000.0;
    (*r.time)[i] = t;
    r.base[i] = shaker.acceleration(t) + 0.05 * noise[2 * i] + 0.3;
    r.relative[i] = 3.0 * shaker.acceleration(std::max(t - 0.002, 0.0)) + 0.05 * noise[2 * i + 1] - 0.4;
  }
  return r;
}

std::vector<std::string> names(const RawRecord& r) {
  std::vector<std::string> result;
  for (const RecordFault& fault : check_record(r)) result.push_back(fault.name);
  return result;
}

TEST(VibrationChecks, FindNothingWrongWithAGoodRecord) {
  EXPECT_TRUE(names(good_record()).empty());
  RawRecord without_time = good_record();
  without_time.time.reset();
  EXPECT_TRUE(names(without_time).empty());
  EXPECT_EQ(sampling_rate(without_time), 1000.0);
}

// Analysers sample at 2.56 times the highest frequency.
TEST(VibrationChecks, AcceptRecordsAtTheAnalysersRate) {
  RawRecord r = good_record();
  r.band_high = *r.rate / 2.56;
  EXPECT_EQ(std::ranges::count(names(r), "sampled_too_slowly"), 0);
  r.band_high = *r.rate / 2.5;
  EXPECT_EQ(std::ranges::count(names(r), "sampled_too_slowly"), 1);
}

// One row and the next are a tenth apart in both ends of the band, or in one: only the first is a matter of the rate.
TEST(VibrationChecks, TellARateFromABand) {
  RawRecord r = good_record();
  r.band_low *= 1.1, r.band_high *= 1.1;
  EXPECT_EQ(names(r), std::vector<std::string>{"rate_or_band"});
  r.band_low = good_record().band_low;
  EXPECT_TRUE(names(r).empty());
}

struct Spoilt {
  const char* fault;
  bool refused;
  std::function<void(RawRecord&)> spoil;
};
void PrintTo(const Spoilt& spoilt, std::ostream* stream) { *stream << spoilt.fault; }

class BadRecord : public testing::TestWithParam<Spoilt> {};

TEST_P(BadRecord, IsCalledByItsName) {
  RawRecord r = good_record();
  GetParam().spoil(r);
  const auto faults = check_record(r);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().name, GetParam().fault) << faults.front().message;
  EXPECT_EQ(faults.front().refused, GetParam().refused);
  EXPECT_FALSE(faults.front().message.empty());
  for (const RecordFault& fault : faults) EXPECT_EQ(fault.name, GetParam().fault) << fault.message;
}

const Spoilt spoilt[] = {
    {"unequal_lengths", true, [](RawRecord& r) { r.relative.conservativeResize(9000); }},
    {"not_finite", true, [](RawRecord& r) { r.relative[77] = std::numeric_limits<double>::quiet_NaN(); }},
    {"time_runs_backwards", true, [](RawRecord& r) { std::swap((*r.time)[500], (*r.time)[501]); }},
    {"gap", true, [](RawRecord& r) { r.time->tail(3000).array() += 0.25; }},
    {"uneven_sampling", true,
     [](RawRecord& r) {
       for (Index i = 0; i < r.time->size(); ++i) (*r.time)[i] += 4e-4 * std::sin(0.01 * static_cast<double>(i));
     }},
    {"wrong_rate", true, [](RawRecord& r) { r.rate = 1024.0; }},
    {"no_rate", true,
     [](RawRecord& r) {
       r.time.reset();
       r.rate.reset();
     }},
    {"too_short", true,
     [](RawRecord& r) {
       for (VectorXd* x : {&*r.time, &r.base, &r.relative}) x->conservativeResize(800);
     }},
    {"sampled_too_slowly", true, [](RawRecord& r) { r.band_high = 450.0; }},
    {"dead_channel", true, [](RawRecord& r) { r.base.setConstant(0.3); }},
    {"base_at_rest", false,
     [](RawRecord& r) {
       r.base.setConstant(0.3);
       for (Index i = 0; i < r.relative.size(); ++i) r.relative[i] *= std::exp(-3.0 * static_cast<double>(i) / 8000.0);
     }},
    {"clipped", false, [](RawRecord& r) { r.relative = r.relative.cwiseMin(40.0).eval(); }},
    {"quantised", false, [](RawRecord& r) { r.relative = (r.relative.array() / 2.0).round().matrix() * 2.0; }},
    {"dropouts", false,
     [](RawRecord& r) {
       for (const Index at : {2000, 4100, 6500}) r.relative.segment(at, 30).setConstant(r.relative[at]);
     }},
    {"rate_or_band", false,
     [](RawRecord& r) {
       r.time.reset();
       r.rate = 900.0;
     }},
    {"drift", false,
     [](RawRecord& r) {
       for (Index i = 0; i < r.base.size(); ++i)
         r.base[i] += 10.0 * std::sin(std::numbers::pi * static_cast<double>(i) / 1e4);
     }},
    {"spikes", false, [](RawRecord& r) { r.relative[1234] += 400.0; }},
    {"outside_the_band", false,
     [](RawRecord& r) {
       r.band_low = 130.0;
       r.band_high = 200.0;
     }},
};
// Noise on a base at rest is no excitation; a small motion within the band is, whatever its unit.
TEST(VibrationChecks, RingDownsAreToldByTheirBase) {
  RawRecord r = good_record();
  for (Index i = 0; i < r.relative.size(); ++i) r.relative[i] *= std::exp(-3.0 * static_cast<double>(i) / 8000.0);
  const auto is_at_rest = [&] {
    return std::ranges::any_of(check_record(r), [](const RecordFault& f) { return f.name == "base_at_rest"; });
  };
  EXPECT_FALSE(is_at_rest());
  r.base *= 1e-3;
  EXPECT_FALSE(is_at_rest());
  r.base = 1e-3 * normal_numbers(r.base.size(), 5);
  EXPECT_TRUE(is_at_rest());
  EXPECT_EQ(check_record(r).size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(VibrationChecks, BadRecord, testing::ValuesIn(spoilt),
                         [](const auto& row) { return std::string(row.param.fault); });

}  // namespace
}  // namespace pfdm::this_file
