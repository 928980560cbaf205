#include "cases/program/vibration/mass_material_ten_steps.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/records/signal_table.h"
#include "solver/vibration/signals/impulse_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr const char* remark = "the report's iteration (A4.3)";

/// The kernel, as three sums of exponentials.
struct Kernels {
  std::vector<HereditaryTerm> series;
  std::vector<HereditaryTerm> kept;
  std::vector<HereditaryTerm> pencil;
  Eigen::Index n_samples = 0;  // of the impulse responses
};

/// v [N] over what drives it: z' [m/s], or z [m].
struct Units {
  const char *weight, *response, *energy;
};

Units units_of(KernelForcing forcing) {
  const bool by_displacement = forcing == KernelForcing::displacement || forcing == KernelForcing::stiffness;
  return by_displacement ? Units{"N/m/s", "N/m", "N^2/m^2/s"} : Units{"N/m", "N s/m", "N^2 s/m^2"};
}

int n_poles(const std::vector<HereditaryTerm>& terms) {
  int n = 0;
  for (const HereditaryTerm& term : terms) n += term.is_pair() ? 2 : 1;
  return n;
}

Kernels kernels_of(const TenSteps& steps, double rate) {
  Kernels k;
  for (const PronyTerm& term : steps.series) {
    k.series.push_back(term.term);
    if (term.kept) k.kept.push_back(term.term);
  }
  const int poles = n_poles(k.kept);
  k.n_samples = std::max(
      {static_cast<Eigen::Index>(std::lround(ten_step_duration * rate)), Eigen::Index{12}, Eigen::Index{6} * poles});
  const Eigen::Index stride =
      std::max(Eigen::Index{1}, k.n_samples / 1000);  // the pencil's time grows with their number cubed
  const double thinned = rate / static_cast<double>(stride);
  const VectorXd g = impulse_response(k.series, k.n_samples / stride, thinned);
  if (poles > 0 && g.allFinite() && g.norm() > 0.0) k.pencil = matrix_pencil(g, thinned, poles).terms;
  return k;
}

void write_iterations(const fs::path& path, const TenSteps& steps) {
  const auto n = static_cast<Eigen::Index>(steps.iterations.size());
  const auto column = [&](auto value) {
    VectorXd values(n);
    for (Eigen::Index i = 0; i < n; ++i) values[i] = value(steps.iterations[i]);
    return values;
  };
  SignalTable table{.remark = fmt::format("{}: {}", remark, steps.settled ? "settled" : "not settled"),
                    .columns = {{"iteration", "1", VectorXd::LinSpaced(n, 1.0, static_cast<double>(n))},
                                {"c", "N s/m", column([](const TenStep& s) { return s.damping; })}}};
  for (std::size_t i = 0; i < steps.iterations.front().stiffness.size(); ++i)
    table.columns.push_back({fmt::format("k{}", i + 1), i == 0 ? "N/m" : fmt::format("N/m^{}", i + 1),
                             column([i](const TenStep& s) { return s.stiffness[i]; })});
  table.columns.push_back({"misfit", "1", column([](const TenStep& s) { return s.misfit; })});
  write_signals_csv(path, table);
}

void write_series(const fs::path& path, const TenSteps& steps) {
  const Units units = units_of(steps.regression.model.forcing);
  const auto n = static_cast<Eigen::Index>(steps.series.size());
  const auto column = [&](auto value) {
    VectorXd values(n);
    for (Eigen::Index i = 0; i < n; ++i) values[i] = value(steps.series[i]);
    return values;
  };
  write_signals_csv(
      path,
      {.remark = fmt::format("{}: Prony series of the last iteration, the most energy within {:g} s first", remark,
                             ten_step_duration),
       .columns = {{"alpha", "1/s", column([](const PronyTerm& t) { return t.term.alpha.real(); })},
                   {"alpha_imaginary", "1/s", column([](const PronyTerm& t) { return t.term.alpha.imag(); })},
                   {"beta", units.weight, column([](const PronyTerm& t) { return t.term.beta.real(); })},
                   {"beta_imaginary", units.weight, column([](const PronyTerm& t) { return t.term.beta.imag(); })},
                   {"energy", units.energy, column([](const PronyTerm& t) { return t.energy; })},
                   {"kept", "1", column([](const PronyTerm& t) { return t.kept ? 1.0 : 0.0; })}}});
}

void write_responses(const fs::path& path, const TenSteps& steps, const Kernels& k) {
  SignalTable table{.remark = fmt::format("{}: frequency response of the kernel", remark),
                    .columns = {{"frequency", "Hz", steps.frequency}}};
  const char* unit = units_of(steps.regression.model.forcing).response;
  const auto add = [&](const std::string& name, const VectorXcd& G) {
    table.columns.push_back({name + "_real", unit, G.real()});
    table.columns.push_back({name + "_imaginary", unit, G.imag()});
  };
  add("record", steps.response);
  add("series", frequency_response(k.series, steps.frequency));
  add("kept", frequency_response(k.kept, steps.frequency));
  add("pencil", frequency_response(k.pencil, steps.frequency));
  write_signals_csv(path, table);
}

void write_impulses(const fs::path& path, const Kernels& k, double rate, const char* unit) {
  const VectorXd time = VectorXd::LinSpaced(k.n_samples, 0.0, static_cast<double>(k.n_samples - 1) / rate);
  write_signals_csv(path, {.remark = fmt::format("{}: impulse response of the kernel", remark),
                           .columns = {{"time", "s", time},
                                       {"series", unit, impulse_response(k.series, k.n_samples, rate)},
                                       {"kept", unit, impulse_response(k.kept, k.n_samples, rate)},
                                       {"pencil", unit, impulse_response(k.pencil, k.n_samples, rate)}}});
}

void say_steps(const TenSteps& steps, const Kernels& k, Log& log) {
  const auto misfit = [&](const std::vector<HereditaryTerm>& terms) {
    return (frequency_response(terms, steps.frequency) - steps.response).norm() / steps.response.norm();
  };
  log.say(
      fmt::format("ten steps: {} after {} iterations; the kernel's response is met within {:.3g} by the series of "
                  "{} poles, {:.3g} by the {} of the most energy, {:.3g} by as many of the matrix pencil",
                  steps.settled ? "settled" : "not settled", steps.iterations.size(), misfit(k.series),
                  n_poles(k.series), misfit(k.kept), n_poles(k.kept), misfit(k.pencil)));
}

}  // namespace

void write_ten_steps(const fs::path& results, const std::optional<TenSteps>& steps, double rate, Log& log) {
  const fs::path folder = results / ten_steps_folder;
  fs::remove_all(folder);
  if (!steps) return;
  make_folder(folder);
  const Kernels kernels = kernels_of(*steps, rate);
  write_iterations(folder / "iterations.csv", *steps);
  write_series(folder / "prony_series.csv", *steps);
  write_responses(folder / "kernel_response.csv", *steps, kernels);
  write_impulses(folder / "kernel_impulse.csv", kernels, rate, units_of(steps->regression.model.forcing).weight);
  say_steps(*steps, kernels, log);
}

}  // namespace pfdm
