// Fits to vibration records of an independent simulator: right ones raise no doubt, wrong records and wrong models do.

#include "solver/vibration/diagnosis/identification_changes.h"
#include "solver/vibration/diagnosis/identification_faults.h"
#include "solver/vibration/identification/identification_base_noise.h"
#include "solver/vibration/identification/identification_coordinates.h"
#include "solver/vibration/identification/identification_evidence.h"
#include "solver/vibration/identification/identification_responses.h"
#include "tests/solver/independent_simulators.h"
#include "tests/solver/judged_records.h"
#include "tests/solver/mass_material_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using independent::sample_of;

TEST(IdentificationVerdict, RightFitsRaiseNoDoubt) {
  for (const auto& [name, shaker] :
       {std::pair("1", sweep), std::pair("2", sweep), std::pair("3", sweep), std::pair("1", random_motion)}) {
    const Judged found = judged(noisy_record(name, shaker), name);
    EXPECT_THAT(found.doubts, IsEmpty()) << name;
    EXPECT_THAT(found.faults, IsEmpty()) << name;
  }
}

TEST(IdentificationVerdict, NoiseFreeRecordsRaiseNoDoubt) {
  EXPECT_THAT(judged(independent::record_of(sample_of(truth("2")), sweep), "2").doubts, IsEmpty());
}

TEST(IdentificationVerdict, WrongModelsAreDoubted) {
  EXPECT_THAT(judged(noisy_record("2", sweep), "1").doubts, SizeIs(1));  // no cubic stiffness
  EXPECT_THAT(judged(noisy_record("3", sweep), "2").doubts, SizeIs(1));  // no nonlinear damping
  EXPECT_THAT(judged(noisy_record("2", random_motion), "1").doubts, SizeIs(1));
}

/// k_1 ... k_5, damping and a pair at 220 Hz, with a real term at 1500/s or without.
MassMaterial truth_with_pair(int stiffness_order, bool with_real_term) {
  MassMaterial t = truth("2");
  t.stiffness.resize(stiffness_order);
  t.damping *= 0.5;
  t.forcing = KernelForcing::velocity;
  const double kk = t.stiffness[0], omega = 2.0 * std::numbers::pi * 220.0;
  t.kernel = {{{0.15 * omega, omega}, {0.1 * kk, 0.0045 * kk}}};
  if (with_real_term) t.kernel.push_back({1500.0, 0.15 * kk});
  return t;
}

void expect_pair(const MassMaterial& t, const independent::Shaker& shaker, const char* structure) {
  VibrationRecord record = independent::record_of(sample_of(t), shaker);
  independent::add_white_noise(record, 40.0, 1);
  IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .replicates = 200};
  const Identification found = identify(std::span(&record, 1), model_structure(structure), settings);
  ASSERT_EQ(found.fit.model.kernel.size(), t.kernel.size());
  ASSERT_TRUE(found.fit.model.kernel[0].is_pair());
  const std::complex<double> alpha = found.fit.model.kernel[0].alpha;
  EXPECT_NEAR(std::abs(alpha) / std::abs(t.kernel[0].alpha), 1.0, 0.005);
  EXPECT_NEAR(alpha.real() / t.kernel[0].alpha.real(), 1.0, 0.05);
  EXPECT_NEAR(found.fit.model.stiffness[0] / t.stiffness[0], 1.0, 0.01);
  EXPECT_LT(stiffness_error(found.fit.model, t, 105.0, 410.0, 0.0), 2e-3);
  EXPECT_TRUE(found.passivity.passive);
  const RecordEvidence evidence = record_evidence(found.fit.model, record, settings.crop);
  EXPECT_THAT(doubts_of(std::span(&evidence, 1)), IsEmpty());
  const std::vector<Estimate> expected = named_values(t);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Estimate& e = found.fit.estimates[i];
    EXPECT_EQ(e.name, expected[i].name);
    EXPECT_NEAR(e.value, expected[i].value, 5.0 * e.standard_error) << e.name;
  }
}

TEST(IdentificationVerdict, ConjugatePairsAreFoundInSweeps) {
  expect_pair(truth_with_pair(5, false), sweep, "4b");
  expect_pair(truth_with_pair(5, true), sweep, "4b");
}

TEST(IdentificationVerdict, ConjugatePairsAreFoundInRandomMotion) {
  expect_pair(truth_with_pair(1, false), random_motion, "linear_4b");
}

// A pair whose imaginary part vanishes and a real term fit as well, with more parameters.
TEST(IdentificationVerdict, TwoRealTermsAreNotTakenForAPair) {
  MassMaterial t = truth("4b");
  t.stiffness.resize(1);
  VibrationRecord record = independent::record_of(sample_of(t), random_motion);
  independent::add_white_noise(record, 60.0, 1);
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .replicates = 0};
  const Identification found = identify(std::span(&record, 1), model_structure("linear_4b"), settings);
  ASSERT_EQ(found.fit.model.kernel.size(), 2u);
  for (const HereditaryTerm& term : found.fit.model.kernel) EXPECT_FALSE(term.is_pair());
  EXPECT_THAT(found.fit.doubts, IsEmpty());
}

// One real term leaves more than noise, two do not: trials of pairs, which took most of the simulations, are left out.
TEST(IdentificationVerdict, NoPairIsTriedWhereTwoRealTermsLeaveNoise) {
  VibrationRecord record = sweep_record(truth("7"), 20.0, 6.0);
  independent::add_white_noise(record, 40.0, 1);
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .replicates = 0};
  const Identification found = identify(std::span(&record, 1), model_structure("7"), settings);
  ASSERT_EQ(found.fit.model.kernel.size(), 2u);
  for (const OrderTrial& trial : found.orders) EXPECT_FALSE(trial.pair);
  const RecordEvidence evidence = record_evidence(found.fit.model, record, settings.crop);
  EXPECT_THAT(doubts_of(std::span(&evidence, 1)), IsEmpty());
}

// Real terms alone are no fit to such a record, and it says so.
TEST(IdentificationVerdict, RealTermsInPlaceOfAPairAreDoubted) {
  VibrationRecord record = independent::record_of(sample_of(truth_with_pair(1, false)), sweep);
  independent::add_white_noise(record, 40.0, 1);
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = 1, .replicates = 0};
  const Identification found = identify(std::span(&record, 1), model_structure("4b"), settings);
  const RecordEvidence evidence = record_evidence(found.fit.model, record, settings.crop);
  EXPECT_THAT(doubts_of(std::span(&evidence, 1)), SizeIs(1));
}

// A tenth of each channel is noise, which reaches the residual through the resonance and directly.
TEST(IdentificationVerdict, NoiseOfBothChannelsIsToldApart) {
  const MassMaterial t = truth("1");
  const VibrationRecord clean = independent::record_of(sample_of(t), random_motion);
  VibrationRecord r = clean;
  independent::add_white_noise(r, 20.0, 3);
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}};
  const auto density = [&](const Eigen::VectorXd& x) {
    return 0.01 * x.squaredNorm() / static_cast<double>(x.size()) / (0.5 * r.rate);
  };
  const Eigen::VectorXd off = output_condition(r, settings.crop)((predicted_response(t, r) - r.relative).eval());
  const ChannelNoise noise = channel_noise(t, r, settings.crop, 0.0, off);
  EXPECT_NEAR(noise.base / density(clean.base), 1.0, 0.1);
  EXPECT_NEAR(noise.relative / density(clean.relative), 1.0, 0.1);
  const Identification found = identify(std::span(&r, 1), model_structure("1"), settings);
  for (const auto& [estimate, expected] : {std::pair(0, t.stiffness[0]), std::pair(1, t.damping)}) {
    const Estimate& e = found.fit.estimates[estimate];
    EXPECT_NEAR(e.value, expected, 3.0 * e.standard_error) << e.name;
  }
}

// To first order it is taken back, in proportion to its power; where the records say so little that this would move an
// estimate far, not at all.
TEST(IdentificationVerdict, BiasOfTheBasesNoiseGrowsWithItsPower) {
  const MassMaterial t = truth("1");
  const VibrationRecord clean = independent::record_of(sample_of(t), random_motion, 3);
  const ParameterCoordinates coordinates(t, excited_range(std::span(&clean, 1)));
  const Conditioner condition = output_condition(clean, 0.05);
  const Eigen::VectorXd measured = condition(clean.relative), x = coordinates.from(t);
  const Eigen::MatrixXd J =
      Eigen::MatrixXd::Identity(measured.size(), x.size()) * std::sqrt(static_cast<double>(measured.size()));
  const auto bias = [&](double decibel, double sensitivity) {
    VibrationRecord r = clean;
    independent::add_white_noise(r, decibel, 1);
    const Eigen::VectorXd off = condition((predicted_response(t, r) - clean.relative).eval());
    return base_noise_bias(std::span(&r, 1), coordinates, x,
                           off * (std::sqrt(static_cast<double>(off.size())) / measured.norm()), sensitivity * J, 0.05);
  };
  ASSERT_TRUE(bias(40.0, 1.0) && bias(30.0, 1.0));
  EXPECT_GT((*bias(40.0, 1.0))[1], 0.0);  // more damping responds less
  EXPECT_NEAR((*bias(30.0, 1.0))[1] / (*bias(40.0, 1.0))[1], 10.0, 1.5);
  EXPECT_FALSE(bias(30.0, 1e-6));
}

/// Reasons by the changes of the sample, after a joint fit of model 1.
std::vector<std::string> changes_in(std::span<const VibrationRecord> records) {
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .replicates = 0};
  const Identification found = identify(records, model_structure("1"), settings);
  std::vector<double> misfit;
  for (const VibrationRecord& r : records) misfit.push_back(record_evidence(found.fit.model, r, settings.crop).misfit);
  return changes_of_sample(records, misfit, found.fit.model, settings);
}

TEST(IdentificationVerdict, AnotherMassInOneOfTwoTestsIsNamed) {
  independent::Sample heavier = sample_of(truth("1"));
  heavier.mass = 1.4;
  std::vector<VibrationRecord> records{noisy_record("1", sweep), independent::record_of(heavier, sweep)};
  independent::add_white_noise(records[1], 40.0, 2);
  const auto changes = changes_in(records);
  ASSERT_THAT(changes, SizeIs(1));
  EXPECT_THAT(changes[0], HasSubstr("the mass or the sample has changed"));
  EXPECT_THAT(changes[0], HasSubstr("all parameters by one factor, 1.25"));
}

// Its stiffness falls by 6 %.
TEST(IdentificationVerdict, ASampleThatWarmsUpIsNamed) {
  VibrationRecord cold = noisy_record("1", random_motion);
  MassMaterial soft = truth("1");
  soft.stiffness[0] *= 0.94;
  const VibrationRecord warm = independent::record_of(sample_of(soft), random_motion);
  const Eigen::Index half = cold.n() / 2;
  cold.relative.tail(half) = warm.relative.tail(half);
  const auto changes = changes_in(std::span(&cold, 1));
  ASSERT_THAT(changes, SizeIs(1));
  EXPECT_THAT(changes[0], HasSubstr("the sample changes during the test"));
}

/// The record from this time on [s].
VibrationRecord without_beginning(VibrationRecord record, double seconds) {
  const auto left = record.n() - static_cast<Eigen::Index>(seconds * record.rate);
  record.base = record.base.tail(left).eval();
  record.relative = record.relative.tail(left).eval();
  return record;
}

// Free motion decays within 1/(zeta omega) = 16 ms, about as long as what is cropped of 1.2 s here.
TEST(IdentificationVerdict, RecordsMayBeginInMotion) {
  const independent::Shaker shaker{.duration = 1.4, .low = 100.0, .high = 420.0, .level = 60.0, .random = true};
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .crop = 0.002};
  for (const char* name : {"1", "2"}) {
    const VibrationRecord record = without_beginning(noisy_record(name, shaker), 0.2);
    const Identification found = identify(std::span(&record, 1), model_structure(name), settings);
    ASSERT_EQ(found.starts.size(), 1u) << name;
    EXPECT_FALSE(found.starts[0].is_rest());
    EXPECT_LT(found.fit.record_misfit[0], 0.02);  // noise of 1 % on either channel
    const RecordEvidence evidence = record_evidence(found.fit.model, record, settings.crop);
    EXPECT_THAT(doubts_of(std::span(&evidence, 1)), IsEmpty()) << name;
    EXPECT_NEAR(found.fit.model.stiffness[0] / truth(name).stiffness[0], 1.0, 5e-3) << name;
    const auto k1 = std::ranges::find(found.fit.estimates, "k1_N_per_m", &Estimate::name);
    EXPECT_LT(std::abs(k1->value - truth(name).stiffness[0]), 4.0 * k1->standard_error) << name;
  }
  const VibrationRecord at_rest = noisy_record("1", shaker);
  EXPECT_THAT(identify(std::span(&at_rest, 1), model_structure("1"), settings).starts, IsEmpty());
}

/// The mass let go, on a base at rest.
VibrationRecord ring_down(double duration) {
  VibrationRecord record{
      .name = "ring-down", .rate = 6000.0, .base = {}, .relative = {}, .band_low = 100.0, .band_high = 420.0};
  const MassMaterial model = truth("1");
  record.base = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(duration * record.rate));
  const InitialMotion start{.displacement = 1e-4, .velocity = 0.0};
  record.relative =
      simulate_starts(model, nodes_of(record.base, record.rate, substeps_for(model, record.rate)), std::span(&start, 1))
          .col(0);
  record.relative += 0.01 * normal_numbers(record.n(), 4);
  return record;
}

TEST(IdentificationVerdict, ARingDownTellsTheSample) {
  const VibrationRecord record = ring_down(0.3);
  const IdentificationSettings settings{.mass = 1.12, .reference_velocity = 0.3, .kernel_order = {}, .crop = 0.01};
  const Identification found = identify(std::span(&record, 1), model_structure("1"), settings);
  EXPECT_NEAR(found.fit.model.stiffness[0] / truth("1").stiffness[0], 1.0, 1e-3);
  EXPECT_NEAR(found.fit.model.damping / truth("1").damping, 1.0, 1e-2);
  EXPECT_LT(found.fit.record_misfit[0], 0.01);
  const RecordEvidence evidence = record_evidence(found.fit.model, record, settings.crop);
  EXPECT_THAT(doubts_of(std::span(&evidence, 1)), IsEmpty());
  EXPECT_THAT(traces_in(std::span(&evidence, 1)), IsEmpty());
}

// The shaker stops after 0.15 s, the mass goes on.
TEST(IdentificationVerdict, ARingDownAtTheEndIsNoDeadChannel) {
  VibrationRecord driven = independent::record_of(sample_of(truth("1")), {.duration = 0.15, .random = true});
  VibrationRecord whole = driven;
  const auto n = driven.n(), all = 2 * n;
  whole.base = Eigen::VectorXd::Zero(all);
  whole.base.head(n) = driven.base;
  const MassMaterial model = truth("1");
  whole.relative =
      simulate_batch(std::span(&model, 1), nodes_of(whole.base, whole.rate, substeps_for(model, whole.rate))).col(0);
  independent::add_white_noise(whole, 60.0, 2);
  EXPECT_FALSE(dead_part(whole));
}

// The mass still moves as before.
TEST(IdentificationVerdict, ADeadBaseIsNoRingDown) {
  VibrationRecord record = independent::record_of(sample_of(truth("1")), random_motion);
  record.base.tail(record.n() / 2).setZero();
  EXPECT_TRUE(dead_part(record));
}

}  // namespace
}  // namespace pfdm::this_file
