// The mass-material model: simulation against real time, and one step of an identification.

#include "solver/parallel.h"
#include "solver/vibration/identification/identification.h"
#include "solver/vibration/simulation/mass_material_simulation.h"
#include "tests/solver/mass_material_truth.h"

#include <benchmark/benchmark.h>

namespace pfdm {
namespace {

constexpr const char* names[] = {"1", "2", "3", "4a", "4b", "5", "6", "7"};

/// With error control, 20 s at 6000 samples/s.
void simulation(benchmark::State& state) {
  const char* name = names[state.range(0)];
  const MassMaterial m = truth(name);
  const Excitation shaker = swept_sine({.amplitude = 5 * g0, .from = 100, .to = 420, .duration = 20.0, .ramp = 0.2});
  for (auto _ : state) benchmark::DoNotOptimize(simulate(m, shaker, 6000.0));
  state.SetLabel(name);
  state.counters["times_real_time"] =
      benchmark::Counter(20.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(simulation)->DenseRange(0, 7)->Unit(benchmark::kMillisecond);

/// Eight neighbouring models at once, in fixed steps.
void simulation_of_eight(benchmark::State& state) {
  const char* name = names[state.range(0)];
  const std::vector<MassMaterial> models(8, truth(name));
  const BaseNodes base =
      nodes_of(swept_sine({.amplitude = 5 * g0, .from = 100, .to = 420, .duration = 20.0, .ramp = 0.2}), 6000.0, 1);
  for (auto _ : state) benchmark::DoNotOptimize(simulate_batch(models, base));
  state.SetLabel(name);
}
BENCHMARK(simulation_of_eight)->DenseRange(0, 7)->Unit(benchmark::kMillisecond);

/// Three levels of 60 s at 6000 samples/s, noise of 40 dB, all threads.
void identification(benchmark::State& state) {
  set_threads(2);
  const char* name = names[state.range(0)];
  const MassMaterial m = truth(name);
  std::vector<VibrationRecord> records;
  for (const double level : {5.0, 7.5, 10.0}) {
    records.push_back(sweep_record(m, level, 60.0));
    add_noise(records.back(), 40.0, records.size());
  }
  IdentificationSettings settings;
  settings.mass = m.mass;
  settings.reference_velocity = m.reference_velocity;
  settings.kernel_order = static_cast<int>(m.kernel.size());
  for (auto _ : state) benchmark::DoNotOptimize(identify(records, model_structure(name), settings));
  state.SetLabel(name);
}
BENCHMARK(identification)->DenseRange(0, 7)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace pfdm

BENCHMARK_MAIN();
