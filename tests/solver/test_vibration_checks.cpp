// Records with one thing wrong each, and a good one with nothing wrong.

#include "solver/vibration/vibration_checks.h"
#include "solver/vibration/vibration_excitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace pfdm {
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
    {"clipped", false, [](RawRecord& r) { r.relative = r.relative.cwiseMin(40.0).eval(); }},
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
INSTANTIATE_TEST_SUITE_P(VibrationChecks, BadRecord, testing::ValuesIn(spoilt),
                         [](const auto& row) { return std::string(row.param.fault); });

}  // namespace
}  // namespace pfdm
