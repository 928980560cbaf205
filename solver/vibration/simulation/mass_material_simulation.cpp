#include "solver/vibration/simulation/mass_material_simulation.h"

#include "physics/error.h"
#include "solver/vibration/signals/lanes.h"
#include "solver/vibration/simulation/lane_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace pfdm {
namespace {

// Cooper and Verner, SIAM J. Numer. Anal. 9 (1972) 389: order 8 in 11 stages, whose abscissae are Lobatto points, so
// that the base's acceleration is needed at three places within a step only.
struct Tableau {
  static constexpr std::size_t stages = 11;
  double a[stages][stages] = {};
  double b[stages] = {};
  int node[stages] = {};  // which of the Lobatto points 0 ... 4
};

constexpr Tableau cooper_verner() {
  constexpr double s = 4.58257569495584000659;  // sqrt 21
  return {
      .a = {{},
            {1.0 / 2},
            {1.0 / 4, 1.0 / 4},
            {1.0 / 7, (-7 - 3 * s) / 98, (21 + 5 * s) / 49},
            {(11 + s) / 84, 0, (18 + 4 * s) / 63, (21 - s) / 252},
            {(5 + s) / 48, 0, (9 + s) / 36, (-231 + 14 * s) / 360, (63 - 7 * s) / 80},
            {(10 - s) / 42, 0, (-432 + 92 * s) / 315, (633 - 145 * s) / 90, (-504 + 115 * s) / 70, (63 - 13 * s) / 35},
            {1.0 / 14, 0, 0, 0, (14 - 3 * s) / 126, (13 - 3 * s) / 63, 1.0 / 9},
            {1.0 / 32, 0, 0, 0, (91 - 21 * s) / 576, 11.0 / 72, (-385 - 75 * s) / 1152, (63 + 13 * s) / 128},
            {1.0 / 14, 0, 0, 0, 1.0 / 9, (-733 - 147 * s) / 2205, (515 + 111 * s) / 504, (-51 - 11 * s) / 56,
             (132 + 28 * s) / 245},
            {0, 0, 0, 0, (-42 + 7 * s) / 18, (-18 + 28 * s) / 45, (-273 - 53 * s) / 72, (301 + 53 * s) / 72,
             (28 - 28 * s) / 45, (49 - 7 * s) / 18}},
      .b = {1.0 / 20, 0, 0, 0, 0, 0, 0, 49.0 / 180, 16.0 / 45, 49.0 / 180, 1.0 / 20},
      .node = {0, 2, 2, 3, 3, 2, 1, 1, 2, 3, 4}};
}

/// N: number of states, known to the compiler, so that the sums over stages are written out without the zeros.
template <std::size_t N>
class Stepper {
 public:
  Stepper(const LaneModel& model, const Lanes& displacement, const Lanes& velocity) : m_(model) {
    state_.fill(Lanes::all(0.0));
    state_[0] = displacement;
    state_[1] = velocity;
    for (auto& slope : slope_) slope.fill(Lanes::all(0.0));
  }

  /// y: base acceleration at the five Lobatto points of the step.
  void step(const Lanes* y, const Lanes& h) {
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I>(y, h), ...); }
    (std::make_index_sequence<n_stages>());
    for (std::size_t d = 0; d < N; ++d) state_[d] += h * weighted_sum<n_stages>(tableau.b, d);
  }

  Lanes acceleration(const Lanes& y) {
    lane_slopes(m_, state_, y, slope_[0]);
    return slope_[0][1];
  }
  bool all_ran_away() const {
    for (int l = 0; l < n_lanes; ++l)
      if (std::abs(state_[0][l]) < runaway_displacement) return false;
    return true;
  }
  const Lanes& displacement() const { return state_[0]; }

 private:
  static constexpr Tableau tableau = cooper_verner();
  static constexpr std::size_t n_stages = Tableau::stages;

  template <std::size_t I>
  void stage(const Lanes* y, const Lanes& h) {
    std::array<Lanes, N> at;
    for (std::size_t d = 0; d < N; ++d) at[d] = state_[d] + h * weighted_sum<I>(tableau.a[I], d);
    lane_slopes(m_, at, y[tableau.node[I]], slope_[I]);
  }

  template <std::size_t Count>
  Lanes weighted_sum(const double (&weights)[n_stages], std::size_t d) const {
    Lanes sum = Lanes::all(0.0);
#pragma GCC unroll 11
    for (std::size_t k = 0; k < Count; ++k)
      if (weights[k] != 0.0) sum += weights[k] * slope_[k][d];
    return sum;
  }

  const LaneModel& m_;
  std::array<Lanes, N> state_;
  std::array<std::array<Lanes, N>, n_stages> slope_;
};

/// The base accelerations of the lanes, step by step. At the end of a record its last interval is repeated.
class LaneDrives {
 public:
  explicit LaneDrives(std::span<const SimulationRun> runs) {
    for (int l = 0; l < n_lanes; ++l) {
      const Eigen::VectorXd& values = runs[std::min(static_cast<std::size_t>(l), runs.size() - 1)].base->values;
      at_[l] = values.data();
      last_[l] = values.data() + values.size() - 1;
      y_[4][l] = values[0];
    }
  }
  const Lanes& now() const { return y_[4]; }

  /// At the five Lobatto points of the next step.
  const Lanes* next() {
    y_[0] = y_[4];
    for (int l = 0; l < n_lanes; ++l) {
      const double*& at = at_[l];
      if (at != last_[l]) at += 4;
      for (int k = 1; k < 5; ++k) y_[k][l] = at[k - 4];
    }
    return y_.data();
  }

 private:
  std::array<const double*, n_lanes> at_{};
  std::array<const double*, n_lanes> last_{};
  std::array<Lanes, 5> y_{};
};

template <std::size_t N>
std::vector<Eigen::VectorXd> march(const LaneModel& model, std::span<const SimulationRun> runs) {
  Lanes displacement, velocity;
  for (int l = 0; l < n_lanes; ++l) {
    const InitialMotion& start = runs[std::min(static_cast<std::size_t>(l), runs.size() - 1)].start;
    displacement[l] = start.displacement;
    velocity[l] = start.velocity;
  }
  Stepper<N> stepper(model, displacement, velocity);
  LaneDrives drives(runs);
  const int substeps = runs.front().base->substeps;
  Lanes h;
  for (int l = 0; l < n_lanes; ++l)
    h[l] = 1.0 / (runs[std::min(static_cast<std::size_t>(l), runs.size() - 1)].base->rate * substeps);
  std::vector<Eigen::VectorXd> result;
  Eigen::Index n = 0;
  for (const SimulationRun& run : runs) {
    result.emplace_back(Eigen::VectorXd::Constant(run.base->n_samples(), std::numeric_limits<double>::quiet_NaN()));
    n = std::max(n, run.base->n_samples());
  }
  std::array<bool, n_lanes> ran_away{};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Lanes acceleration = stepper.acceleration(drives.now());
    for (std::size_t l = 0; l < runs.size(); ++l) {
      if (i >= result[l].size()) continue;
      result[l][i] = acceleration[static_cast<int>(l)];
      if (!(std::abs(stepper.displacement()[static_cast<int>(l)]) < runaway_displacement)) ran_away[l] = true;
    }
    if (i + 1 == n || stepper.all_ran_away()) break;
    for (int sub = 0; sub < substeps; ++sub) stepper.step(drives.next(), h);
  }
  for (std::size_t l = 0; l < runs.size(); ++l)
    if (ran_away[l]) result[l].setConstant(std::numeric_limits<double>::quiet_NaN());
  return result;
}

/// Kernels of more states than the program has steppers for make do with that of the next size: states without slopes
/// stay zero.
std::vector<Eigen::VectorXd> simulate_lanes(std::span<const SimulationRun> runs) {
  const LaneModel model = lane_model(runs);
  switch (model.n_states) {
    case 2: return march<2>(model, runs);
    case 3: return march<3>(model, runs);
    case 4: return march<4>(model, runs);
    case 5: return march<5>(model, runs);
    case 6: return march<6>(model, runs);
    default: break;
  }
  if (model.n_states <= 12) return march<12>(model, runs);
  if (model.n_states > 44) throw InputError("a kernel of more than 42 states (a pair counts two) cannot be simulated");
  return march<44>(model, runs);
}

/// The responses of runs under one base acceleration, a column each.
Eigen::MatrixXd columns_of(std::span<const SimulationRun> runs) {
  assert(!runs.empty());
  Eigen::MatrixXd result(runs.front().base->n_samples(), static_cast<Eigen::Index>(runs.size()));
  Eigen::Index column = 0;
  for (const auto& group : simulation_groups(runs))
    for (const Eigen::VectorXd& response : simulate_group(group)) result.col(column++) = response;
  return result;
}

}  // namespace

int substeps_for(const MassMaterial& model, double rate) {
  double fastest = std::sqrt(std::abs(model.stiffness.front()) / model.mass);
  // Order 8: 0.7 rad a step keep the phase error below 1e-7; decaying states are also stable well beyond.
  double n = fastest / (0.7 * rate);
  for (const HereditaryTerm& term : model.kernel) n = std::max(n, std::abs(term.alpha) / (1.5 * rate));
  return static_cast<int>(std::clamp(std::ceil(n), 1.0, 64.0));
}

std::vector<std::vector<SimulationRun>> simulation_groups(std::span<const SimulationRun> runs) {
  const std::size_t n_groups = (runs.size() + n_lanes - 1) / n_lanes;
  std::vector<std::vector<SimulationRun>> groups;
  for (std::size_t g = 0; g < n_groups; ++g) {
    const std::size_t first = g * runs.size() / n_groups;
    const auto part = runs.subspan(first, (g + 1) * runs.size() / n_groups - first);
    groups.emplace_back(part.begin(), part.end());
  }
  return groups;
}

std::vector<Eigen::VectorXd> simulate_group(std::span<const SimulationRun> runs) {
  assert(!runs.empty() && runs.size() <= n_lanes);
  return simulate_lanes(runs);
}

Eigen::MatrixXd simulate_batch(std::span<const MassMaterial> models, const BaseNodes& base,
                               const InitialMotion& start) {
  std::vector<SimulationRun> runs;
  for (const MassMaterial& m : models) runs.push_back({&m, &base, start});
  return columns_of(runs);
}

Eigen::MatrixXd simulate_starts(const MassMaterial& model, const BaseNodes& base,
                                std::span<const InitialMotion> starts) {
  std::vector<SimulationRun> runs;
  for (const InitialMotion& start : starts) runs.push_back({&model, &base, start});
  return columns_of(runs);
}

void add_noise(VibrationRecord& record, double decibel, std::uint64_t seed) {
  const double factor = std::pow(10.0, -decibel / 20.0) / std::sqrt(static_cast<double>(record.n()));
  record.base += factor * record.base.norm() * normal_numbers(record.n(), 2 * seed);
  record.relative += factor * record.relative.norm() * normal_numbers(record.n(), 2 * seed + 1);
}

}  // namespace pfdm
