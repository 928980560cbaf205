// Stress updates of the endochronic law, beside a plain elastic update; one thread.

#include "tests/physics/endochronic_laws.h"

#include <benchmark/benchmark.h>

namespace pfdm {
namespace {

EndochronicLaw law_of(std::int64_t n_terms) {
  EndochronicLaw law = three_term_law();
  law.kernel.clear();
  for (std::int64_t r = 0; r < n_terms; ++r) {
    const double alpha = 3000.0 / std::pow(6.0, static_cast<double>(r));
    law.kernel.push_back({20e6 * alpha, alpha});
  }
  return law;
}

constexpr int n_steps = 1000;

/// Increments along a path that turns all the time.
std::vector<Mandel> increments() {
  std::vector<Mandel> result;
  const auto strain = [](double t) {
    return Mandel{0.004 * std::sin(t), -0.001 * std::sin(t), 0.0, 0.0, 0.002 * std::sin(2.0 * t), 0.003 * std::cos(t)};
  };
  for (int i = 0; i < n_steps; ++i) result.push_back(strain(0.05 * (i + 1)) - strain(0.05 * i));
  return result;
}

void endochronic_update(benchmark::State& state) {
  const EndochronicLaw law = law_of(state.range(0));
  const std::vector<Mandel> steps = increments();
  std::int64_t iterations = 0;
  for ([[maybe_unused]] const auto run : state) {
    EndochronicState point = virgin_state(law);
    for (const Mandel& step : steps) {
      EndochronicUpdate result = update(law, point, step, 1.0);
      benchmark::DoNotOptimize(result.tangent);
      iterations += result.iterations;
      point = std::move(result.state);
    }
  }
  state.SetItemsProcessed(state.iterations() * n_steps);
  state.counters["newton"] = static_cast<double>(iterations) / static_cast<double>(state.iterations() * n_steps);
}

void elastic_update(benchmark::State& state) {
  const IsotropicElasticity elasticity = three_term_law().elasticity;
  const std::vector<Mandel> steps = increments();
  for ([[maybe_unused]] const auto run : state) {
    Mandel strain = Mandel::Zero();
    for (const Mandel& step : steps) {
      strain += step;
      Mandel sigma = (elasticity.lambda * trace(strain)) * mandel_identity() + (2.0 * elasticity.mu) * strain;
      MandelMatrix tangent =
          (2.0 * elasticity.mu) * deviatoric_projector() + (3.0 * elasticity.bulk_modulus()) * volumetric_projector();
      benchmark::DoNotOptimize(sigma);
      benchmark::DoNotOptimize(tangent);
    }
  }
  state.SetItemsProcessed(state.iterations() * n_steps);
}

BENCHMARK(endochronic_update)->ArgName("terms")->Arg(1)->Arg(2)->Arg(3)->Arg(5)->Unit(benchmark::kMicrosecond);
BENCHMARK(elastic_update)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace pfdm

BENCHMARK_MAIN();
