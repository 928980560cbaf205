// Statistics of identification over many synthetic records. Too long for the ordinary suite; README.md has the results.
//
//   identification_statistics order SEEDS        how often BIC finds the two kernel terms there are
//   identification_statistics coverage TRIALS    how often the 95 % intervals hold the truth
//   identification_statistics ten_steps SEEDS    complex stiffness by the report's iteration, beside ours
//   identification_statistics impulse TRIALS     an impulse response of four poles: ours, matrix pencil, Prony's series
//   identification_statistics models SECONDS DB [THREADS NAME ...]
//                                                models of Table A2, all or these: errors and CPU seconds, three levels

#include "solver/linear/dense_algebra.h"
#include "solver/parallel.h"
#include "solver/vibration/identification/identification_stiffness.h"
#include "solver/vibration/identification/identification_ten_steps.h"
#include "solver/vibration/signals/impulse_response.h"
#include "solver/vibration/simulation/vibration_excitation.h"
#include "tests/solver/mass_material_truth.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>
#include <thread>

namespace pfdm {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void order(int seeds) {
  MassMaterial t = truth("4b");
  t.stiffness.resize(1);
  IdentificationSettings settings;
  settings.mass = t.mass;
  const double levels[] = {60.0, 40.0, 30.0};
  int right[3] = {};
  double worst[3] = {};
  for (int seed = 1; seed <= seeds; ++seed) {
    const VibrationRecord clean = random_record(t, 100.0, static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 3; ++i) {
      VibrationRecord noisy = clean;
      add_noise(noisy, levels[i], static_cast<std::uint64_t>(seed));
      const StiffnessIdentification found = identify_stiffness(std::span(&noisy, 1), settings);
      right[i] += found.fit.model.kernel.size() == 2;
      worst[i] = std::max(worst[i], stiffness_error(found.fit.model, t, 20.0, 850.0, 0.0));
    }
    fmt::print("{} seeds: right at 60, 40, 30 dB: {}, {}, {}; largest error of K {:.2g}, {:.2g}, {:.2g}\n", seed,
               right[0], right[1], right[2], worst[0], worst[1], worst[2]);
    std::fflush(stdout);
  }
}

void ten_steps(int seeds) {
  MassMaterial t = truth("4b");
  t.stiffness.resize(1);
  IdentificationSettings settings;
  settings.mass = t.mass;
  settings.kernel_order = 2;
  for (int seed = 1; seed <= seeds; ++seed)
    for (const double decibel : {200.0, 60.0, 40.0, 30.0}) {
      VibrationRecord record = random_record(t, 100.0, static_cast<std::uint64_t>(seed));
      add_noise(record, decibel, static_cast<std::uint64_t>(seed));
      const auto error = [&](const MassMaterial& m) { return stiffness_error(m, t, 50.0, 800.0, 0.0); };
      fmt::print("seed {} {} dB: complex stiffness by", seed, decibel);
      for (const auto& [m1, m] : {std::pair(40, 10), std::pair(10, 4), std::pair(10, 2)})
        fmt::print(
            " ten steps {} to {} {:.2g},", m1, m,
            error(ten_steps(std::span(&record, 1), model_structure("linear_4b"), m, settings, m1).regression.model));
      fmt::print(" maximum likelihood {:.2g}\n", error(identify_stiffness(std::span(&record, 1), settings).fit.model));
      std::fflush(stdout);
    }
}

void coverage(int trials) {
  const MassMaterial t = truth("2");
  const std::vector<Estimate> expected = named_values(t);
  const std::vector<VibrationRecord> clean{sweep_record(t, 10.0, 12.0, 150.0, 400.0, 3000.0)};
  IdentificationSettings settings;
  settings.mass = t.mass;
  settings.reference_velocity = t.reference_velocity;
  std::vector<int> held(expected.size());
  for (int trial = 1; trial <= trials; ++trial) {
    std::vector<VibrationRecord> noisy = clean;
    add_noise(noisy[0], 40.0, static_cast<std::uint64_t>(trial));
    const Identification found = identify(noisy, model_structure("2"), settings);
    for (std::size_t i = 0; i < expected.size(); ++i)
      held[i] += found.fit.estimates[i].lower <= expected[i].value && expected[i].value <= found.fit.estimates[i].upper;
    if (trial % 20 != 0 && trial != trials) continue;
    fmt::print("{} trials:", trial);
    for (std::size_t i = 0; i < expected.size(); ++i)
      fmt::print(" {} {:.1f} %", expected[i].name, 100.0 * held[i] / trial);
    fmt::print("\n");
    std::fflush(stdout);
  }
}

using Samples = Eigen::VectorXd;

/// g(t) = sum of weight exp(-alpha t), of which the real part.
Samples sampled(const std::vector<std::complex<double>>& alphas, const std::vector<std::complex<double>>& weights,
                Eigen::Index n, double rate) {
  Samples g = Samples::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (std::size_t i = 0; i < alphas.size(); ++i)
      g[k] += (weights[i] * std::exp(-alphas[i] * (static_cast<double>(k) / rate))).real();
  return g;
}

/// Of the four poles the energy of which is largest, by linear prediction of the given order; weights of all decaying
/// poles by least squares.
Samples prony(const Samples& g, int order, double rate) {
  const Eigen::Index n = g.size() - order;
  Eigen::MatrixXd past(n, order);
  for (int i = 0; i < order; ++i) past.col(i) = g.segment(order - 1 - i, n);
  const Eigen::VectorXd a = scaled_least_squares(past, g.tail(n));
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.row(0) = a.transpose();
  companion.diagonal(-1).setOnes();
  std::vector<std::complex<double>> alphas;
  for (const std::complex<double> z : eigenvalues(companion))
    if (std::abs(z) < 1.0 && std::abs(z) > 1e-6 && z.imag() >= 0.0) alphas.push_back(-rate * std::log(z));
  Eigen::MatrixXd basis(g.size(), 2 * std::ssize(alphas));
  for (Eigen::Index i = 0; i < std::ssize(alphas); ++i)
    for (Eigen::Index k = 0; k < g.size(); ++k) {
      const std::complex<double> decay = std::exp(-alphas[i] * (static_cast<double>(k) / rate));
      basis(k, 2 * i) = decay.real(), basis(k, 2 * i + 1) = -decay.imag();
    }
  const Eigen::VectorXd x = scaled_least_squares(basis, g);
  std::vector<std::pair<double, std::size_t>> by_energy;
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const auto column = 2 * static_cast<Eigen::Index>(i);
    by_energy.emplace_back(-(basis.middleCols(column, 2) * x.segment(column, 2)).squaredNorm(), i);
  }
  std::ranges::sort(by_energy);
  Samples kept = Samples::Zero(g.size());
  int poles = 0;
  for (const auto& [energy, i] : by_energy) {
    if (poles >= 4) break;
    const auto column = 2 * static_cast<Eigen::Index>(i);
    kept += basis.middleCols(column, 2) * x.segment(column, 2);
    poles += alphas[i].imag() == 0.0 ? 1 : 2;
  }
  return kept;
}

void impulse(int trials) {
  constexpr double rate = 6000.0;
  constexpr Eigen::Index n = 1200;
  const Samples clean = sampled({{30.0, 0.0}, {60.0, 900.0}, {250.0, 0.0}}, {1.0, {0.8, -0.6}, 0.6}, n, rate);
  const auto error = [&](const Samples& g) { return (g - clean).norm() / clean.norm(); };
  const auto of = [&](const ImpulseFit& fit) {
    std::vector<std::complex<double>> alphas, weights;
    for (const HereditaryTerm& term : fit.terms) {
      alphas.push_back(term.alpha);
      weights.push_back(term.is_pair() ? 2.0 * term.beta : term.beta);
    }
    return sampled(alphas, weights, n, rate);
  };
  for (const double decibel : {60.0, 40.0, 20.0}) {
    double ours = 0.0, pencil = 0.0, prony_40 = 0.0, prony_250 = 0.0;
    int right = 0;
    for (int seed = 1; seed <= trials; ++seed) {
      const double deviation = clean.norm() / std::sqrt(double(n)) * std::pow(10.0, -decibel / 20.0);
      const Samples g = clean + deviation * normal_numbers(n, static_cast<std::uint64_t>(seed));
      const ImpulseFit fit = fit_impulse_response(g, rate);
      right += fit.order == 4;
      ours += error(of(fit)) / trials;
      pencil += error(of(matrix_pencil(g, rate))) / trials;
      prony_40 += error(prony(g, 40, rate)) / trials;
      prony_250 += error(prony(g, 250, rate)) / trials;
    }
    fmt::print(
        "{} dB: order right {} of {}; error ours {:.2g}, matrix pencil {:.2g}, Prony M1 = 40 {:.2g}, 250 {:.2g}\n",
        decibel, right, trials, ours, pencil, prony_40, prony_250);
    std::fflush(stdout);
  }
}

void models(double duration, double decibel, const std::vector<std::string>& names) {
  const double all_cpu = cpu_seconds();
  const double all_wall = wall_seconds();
  for (const std::string& name : names) {
    const MassMaterial t = truth(name);
    std::vector<VibrationRecord> records;
    for (const double level : {5.0, 7.5, 10.0}) {
      records.push_back(sweep_record(t, level, duration));
      if (decibel > 0.0) add_noise(records.back(), decibel, records.size());
    }
    IdentificationSettings settings;
    settings.mass = t.mass;
    settings.reference_velocity = t.reference_velocity;
    settings.kernel_order = static_cast<int>(t.kernel.size());
    const double cpu = cpu_seconds();
    const Identification found = identify(records, model_structure(name), settings);
    fmt::print(
        "model {:<3} largest error {:.2e} (regression alone {:.2e}), complex stiffness {:.2e}, {} iterations, {:.1f} "
        "CPU s\n",
        name, largest_error(found.fit.model, t), largest_error(found.start.model, t),
        stiffness_error(found.fit.model, t, 100.0, 420.0, 0.2), found.fit.path.size(), cpu_seconds() - cpu);
    std::fflush(stdout);
  }
  fmt::print("all: {:.1f} CPU s, {:.1f} s\n", cpu_seconds() - all_cpu, wall_seconds() - all_wall);
}

int run(int n, char** words) {
  set_threads(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  const std::string what = n > 1 ? words[1] : "";
  const double amount = n > 2 ? std::atof(words[2]) : 0.0;
  std::vector<std::string> names{"1", "2", "3", "4a", "4b", "5", "6", "7"};
  if (n > 4) set_threads(std::max(1, std::atoi(words[4])));
  if (n > 5) names.assign(words + 5, words + n);
  if (what == "order" && amount > 0.0) return order(static_cast<int>(amount)), 0;
  if (what == "ten_steps" && amount > 0.0) return ten_steps(static_cast<int>(amount)), 0;
  if (what == "coverage" && amount > 0.0) return coverage(static_cast<int>(amount)), 0;
  if (what == "impulse" && amount > 0.0) return impulse(static_cast<int>(amount)), 0;
  if (what == "models" && amount > 0.0) return models(amount, n > 3 ? std::atof(words[3]) : 0.0, names), 0;
  fmt::print(stderr,
             "usage: identification_statistics order SEEDS | ten_steps SEEDS | coverage TRIALS | impulse TRIALS | "
             "models SECONDS [DB "
             "[THREADS [NAME ...]]]\n");
  return 2;
}

}  // namespace
}  // namespace pfdm

int main(int n, char** words) { return pfdm::run(n, words); }
