#include "solver/mass_material_simulation.h"

#include "physics/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace pfdm {
namespace {

using Eigen::Index;

// Models side by side: two vector registers of four, whose chains of operations overlap.
constexpr int n_lanes = 8;

using Register = double __attribute__((vector_size(32)));

/// One number of each model. Plain vector arithmetic, which the compiler keeps in registers.
struct Lane {
  Register a;
  Register b;
  double& operator[](int i) { return i < 4 ? reinterpret_cast<double*>(&a)[i] : reinterpret_cast<double*>(&b)[i - 4]; }
  double operator[](int i) const {
    return i < 4 ? reinterpret_cast<const double*>(&a)[i] : reinterpret_cast<const double*>(&b)[i - 4];
  }
  static Lane all(double x) { return {Register{x, x, x, x}, Register{x, x, x, x}}; }
};
inline Lane operator+(const Lane& x, const Lane& y) { return {x.a + y.a, x.b + y.b}; }
inline Lane operator-(const Lane& x, const Lane& y) { return {x.a - y.a, x.b - y.b}; }
inline Lane operator*(const Lane& x, const Lane& y) { return {x.a * y.a, x.b * y.b}; }
inline Lane operator*(double x, const Lane& y) { return {x * y.a, x * y.b}; }
inline Lane operator-(double x, const Lane& y) { return {x - y.a, x - y.b}; }
inline Lane operator-(const Lane& x) { return {-x.a, -x.b}; }
inline Lane& operator+=(Lane& x, const Lane& y) { return x = x + y; }
inline Lane& operator-=(Lane& x, const Lane& y) { return x = x - y; }

/// One kernel state a real term, two a pair.
struct LaneKernel {
  Lane rate_real, rate_imaginary, weight_real, weight_imaginary;
  bool pair = false;
};

struct LaneModel {
  Lane mass_inverse, damping, exponent, velocity_inverse;
  std::vector<Lane> stiffness;
  std::vector<LaneKernel> kernel;
  KernelForcing forcing = KernelForcing::none;
  bool nonlinear_damping = false;
  bool any_pair = false;
  std::size_t n_states = 2;
};

template <class Get>
Lane lanes(std::span<const MassMaterial> models, const Get& get) {
  Lane lane;
  for (int l = 0; l < n_lanes; ++l) lane[l] = get(models[std::min(static_cast<std::size_t>(l), models.size() - 1)]);
  return lane;
}

LaneModel gather(std::span<const MassMaterial> models) {
  using M = const MassMaterial&;
  LaneModel m;
  m.mass_inverse = lanes(models, [](M x) { return 1.0 / x.mass; });
  m.damping = lanes(models, [](M x) { return x.damping; });
  m.exponent = lanes(models, [](M x) { return x.damping_exponent; });
  m.velocity_inverse = lanes(models, [](M x) { return 1.0 / x.reference_velocity; });
  m.nonlinear_damping = std::ranges::any_of(models, [](M x) { return x.damping_exponent != 0.0; });
  m.forcing = models.front().forcing;
  for (std::size_t i = 0; i < models.front().stiffness.size(); ++i)
    m.stiffness.push_back(lanes(models, [i](M x) { return x.stiffness[i]; }));
  for (std::size_t i = 0; i < models.front().kernel.size(); ++i) {
    LaneKernel k;
    k.pair = models.front().kernel[i].is_pair();
    k.rate_real = lanes(models, [i](M x) { return x.kernel[i].alpha.real(); });
    k.rate_imaginary = lanes(models, [i](M x) { return x.kernel[i].alpha.imag(); });
    const double share = k.pair ? 2.0 : 1.0;
    k.weight_real = lanes(models, [=](M x) { return share * x.kernel[i].beta.real(); });
    k.weight_imaginary = lanes(models, [=](M x) { return share * x.kernel[i].beta.imag(); });
    m.any_pair = m.any_pair || k.pair;
    m.n_states += k.pair ? 2 : 1;
    m.kernel.push_back(k);
  }
  return m;
}

[[gnu::always_inline]] inline Lane power_of_speed(const LaneModel& m, const Lane& velocity) {
  using Array = Eigen::Array<double, n_lanes, 1>;
  const auto as_array = [](const Lane& lane) {
    return Eigen::Map<const Array>(reinterpret_cast<const double*>(&lane));
  };
  const Array speed = (as_array(velocity) * as_array(m.velocity_inverse)).abs().max(1e-300);
  const Array power = (as_array(m.exponent) * speed.log()).exp();
  Lane result;
  Eigen::Map<Array>(reinterpret_cast<double*>(&result)) = power;
  return result;
}

/// Forces of a state, and f.
struct Forces {
  Lane plain;    // k(z) + c(z')
  Lane forcing;  // f
};

[[gnu::always_inline]] inline Forces forces(const LaneModel& m, const Lane& z, const Lane& velocity) {
  Lane stiffness = Lane::all(0.0);
  for (std::size_t i = m.stiffness.size(); i-- > 0;) stiffness = (stiffness + m.stiffness[i]) * z;
  const Lane shaped = m.nonlinear_damping ? velocity * power_of_speed(m, velocity) : velocity;
  const Lane plain = stiffness + m.damping * shaped;
  switch (m.forcing) {
    case KernelForcing::displacement: return {plain, z};
    case KernelForcing::stiffness: return {plain, stiffness};
    case KernelForcing::damping: return {plain, shaped};
    case KernelForcing::none:
    case KernelForcing::velocity: break;
  }
  return {plain, velocity};
}

/// Slopes of the kernel states, which follow z and z' in `state`; returns v. N: number of all states.
template <std::size_t N>
[[gnu::always_inline]] inline Lane kernel_slopes(const LaneModel& m, const std::array<Lane, N>& state, const Lane& f,
                                                 std::array<Lane, N>& slope) {
  Lane v = Lane::all(0.0);
  if (!m.any_pair && m.kernel.size() == N - 2) {
#pragma GCC unroll 4
    for (std::size_t s = 2; s < N; ++s) {
      const LaneKernel& k = m.kernel[s - 2];
      v += k.weight_real * state[s];
      slope[s] = f - k.rate_real * state[s];
    }
    return v;
  }
  std::size_t s = 2;
  for (const LaneKernel& k : m.kernel) {
    v += k.weight_real * state[s];
    slope[s] = f - k.rate_real * state[s];
    if (k.pair) {
      v -= k.weight_imaginary * state[s + 1];
      slope[s] += k.rate_imaginary * state[s + 1];
      slope[s + 1] = -k.rate_real * state[s + 1] - k.rate_imaginary * state[s];
      ++s;
    }
    ++s;
  }
  return v;
}

/// Slopes of [z, z', kernel states] under the base acceleration y.
template <std::size_t N>
[[gnu::always_inline]] inline void slopes(const LaneModel& m, const std::array<Lane, N>& state, double y,
                                          std::array<Lane, N>& slope) {
  const Forces force = forces(m, state[0], state[1]);
  const Lane v = kernel_slopes(m, state, force.forcing, slope);
  slope[0] = state[1];
  slope[1] = -y - (force.plain + v) * m.mass_inverse;
}

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
  explicit Stepper(const LaneModel& model) : m_(model) {
    state_.fill(Lane::all(0.0));
    for (auto& slope : slope_) slope.fill(Lane::all(0.0));
  }

  /// y: base acceleration at the five Lobatto points of the step.
  void step(const double* y, double h) {
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I>(y, h), ...); }
    (std::make_index_sequence<n_stages>());
    for (std::size_t d = 0; d < N; ++d) state_[d] += h * weighted_sum<n_stages>(tableau.b, d);
  }

  Lane acceleration(double y) {
    slopes(m_, state_, y, slope_[0]);
    return slope_[0][1];
  }
  bool all_ran_away() const {
    for (int l = 0; l < n_lanes; ++l)
      if (std::abs(state_[0][l]) < runaway_displacement) return false;
    return true;
  }
  const Lane& displacement() const { return state_[0]; }

 private:
  static constexpr Tableau tableau = cooper_verner();
  static constexpr std::size_t n_stages = Tableau::stages;

  template <std::size_t I>
  void stage(const double* y, double h) {
    std::array<Lane, N> at;
    for (std::size_t d = 0; d < N; ++d) at[d] = state_[d] + h * weighted_sum<I>(tableau.a[I], d);
    slopes(m_, at, y[tableau.node[I]], slope_[I]);
  }

  template <std::size_t Count>
  Lane weighted_sum(const double (&weights)[n_stages], std::size_t d) const {
    Lane sum = Lane::all(0.0);
#pragma GCC unroll 11
    for (std::size_t k = 0; k < Count; ++k)
      if (weights[k] != 0.0) sum += weights[k] * slope_[k][d];
    return sum;
  }

  const LaneModel& m_;
  std::array<Lane, N> state_;
  std::array<std::array<Lane, N>, n_stages> slope_;
};

template <std::size_t N>
void march(const LaneModel& model, Index n_models, const BaseNodes& base, Eigen::Ref<Eigen::MatrixXd> result) {
  Stepper<N> stepper(model);
  const double h = 1.0 / (base.rate * base.substeps);
  const Index n = base.n_samples();
  const Index stride = 4 * base.substeps;
  result.setConstant(std::numeric_limits<double>::quiet_NaN());
  Lane valid = Lane::all(1.0);
  for (Index i = 0; i < n; ++i) {
    const double* y = base.values.data() + stride * i;
    const Lane acceleration = stepper.acceleration(*y);
    for (int l = 0; l < n_models; ++l) result(i, l) = acceleration[l];
    if (i + 1 == n || stepper.all_ran_away()) break;
    for (int sub = 0; sub < base.substeps; ++sub) stepper.step(y + 4 * sub, h);
    for (int l = 0; l < n_models; ++l)
      if (!(std::abs(stepper.displacement()[l]) < runaway_displacement)) valid[l] = 0.0;
  }
  for (int l = 0; l < n_models; ++l)
    if (valid[l] == 0.0) result.col(l).setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// Kernels of more states than the program has steppers for make do with that of the next size: states without slopes
/// stay zero.
void simulate_lanes(std::span<const MassMaterial> models, const BaseNodes& base, Eigen::Ref<Eigen::MatrixXd> result) {
  const LaneModel model = gather(models);
  const auto n_models = static_cast<Index>(models.size());
  switch (model.n_states) {
    case 2: return march<2>(model, n_models, base, result);
    case 3: return march<3>(model, n_models, base, result);
    case 4: return march<4>(model, n_models, base, result);
    case 5: return march<5>(model, n_models, base, result);
    case 6: return march<6>(model, n_models, base, result);
    default: break;
  }
  if (model.n_states <= 12) return march<12>(model, n_models, base, result);
  if (model.n_states > 44) throw InputError("a kernel of more than 42 states (a pair counts two) cannot be simulated");
  march<44>(model, n_models, base, result);
}

}  // namespace

int substeps_for(const MassMaterial& model, double rate) {
  double fastest = std::sqrt(std::abs(model.stiffness.front()) / model.mass);
  // Order 8: 0.7 rad a step keep the phase error below 1e-7; decaying states are also stable well beyond.
  double n = fastest / (0.7 * rate);
  for (const HereditaryTerm& term : model.kernel) n = std::max(n, std::abs(term.alpha) / (1.5 * rate));
  return static_cast<int>(std::clamp(std::ceil(n), 1.0, 64.0));
}

Eigen::MatrixXd simulate_batch(std::span<const MassMaterial> models, const BaseNodes& base) {
  assert(!models.empty());
  Eigen::MatrixXd result(base.n_samples(), static_cast<Index>(models.size()));
  for (std::size_t first = 0; first < models.size(); first += n_lanes) {
    const std::size_t n = std::min<std::size_t>(n_lanes, models.size() - first);
    simulate_lanes(models.subspan(first, n), base, result.middleCols(static_cast<Index>(first), static_cast<Index>(n)));
  }
  return result;
}

void add_noise(VibrationRecord& record, double decibel, std::uint64_t seed) {
  const double factor = std::pow(10.0, -decibel / 20.0) / std::sqrt(static_cast<double>(record.n()));
  record.base += factor * record.base.norm() * normal_numbers(record.n(), 2 * seed);
  record.relative += factor * record.relative.norm() * normal_numbers(record.n(), 2 * seed + 1);
}

}  // namespace pfdm
