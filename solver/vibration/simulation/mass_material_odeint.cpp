// simulate() of mass_material_simulation.h. The only place that knows Boost.Odeint.

#include "solver/vibration/simulation/mass_material_simulation.h"

#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

namespace ode = boost::numeric::odeint;
using Complex = std::complex<double>;
using State = std::vector<double>;  // z, z', then real and imaginary part of each kernel term's convolution with f

double hereditary_force(const MassMaterial& model, const State& state) {
  double v = 0.0;
  for (std::size_t i = 0; i < model.kernel.size(); ++i) {
    const HereditaryTerm& term = model.kernel[i];
    v += (term.is_pair() ? 2.0 : 1.0) * (term.beta * Complex(state[2 + 2 * i], state[3 + 2 * i])).real();
  }
  return v;
}

double acceleration(const MassMaterial& model, const State& state, double base) {
  return -base - (stiffness_force(model, state[0]) + damping_force(model, state[1]) + hereditary_force(model, state)) /
                     model.mass;
}

struct Equation {
  const MassMaterial& model;
  const Excitation& excitation;
  void operator()(const State& state, State& slope, double t) const {
    slope[0] = state[1];
    slope[1] = acceleration(model, state, excitation.acceleration(t));
    const double f = kernel_forcing(model, state[0], state[1]);
    for (std::size_t i = 0; i < model.kernel.size(); ++i) {
      const Complex rate = f - model.kernel[i].alpha * Complex(state[2 + 2 * i], state[3 + 2 * i]);
      slope[2 + 2 * i] = rate.real();
      slope[3 + 2 * i] = rate.imag();
    }
  }
};

Motion empty_motion(Eigen::Index n, double rate) {
  Motion motion;
  motion.rate = rate;
  for (Eigen::VectorXd* x : {&motion.base, &motion.displacement, &motion.velocity, &motion.acceleration})
    x->setConstant(n, std::numeric_limits<double>::quiet_NaN());
  return motion;
}

/// Displacements that matter: a small part of what the base does in a period.
double absolute_tolerance(const Excitation& excitation, double tolerance) {
  double largest = 0.0;
  for (int i = 0; i <= 1000; ++i)
    largest = std::max(largest, std::abs(excitation.acceleration(excitation.duration * i / 1000.0)));
  const double omega = 2.0 * std::numbers::pi * std::max(excitation.band_high, 1.0);
  return tolerance * std::max(largest, 1e-12) / (omega * omega);
}

/// Steps a state from sample to sample; the step continues beyond a sample that cut it short.
class Marcher {
 public:
  Marcher(const MassMaterial& model, const Excitation& excitation, double rate, double tolerance)
      : equation_{model, excitation},
        stepper_(ode::make_controlled(absolute_tolerance(excitation, tolerance), tolerance,
                                      ode::runge_kutta_fehlberg78<State>())),
        state_(2 + 2 * model.kernel.size(), 0.0),
        longest_(1.0 / rate),
        step_(0.5 / rate) {}

  /// False if the mass ran away.
  bool advance_to(double due) {
    while (t_ < due) {
      const bool last = t_ + step_ >= due * (1.0 - 1e-15);
      double tried = last ? due - t_ : step_;
      const bool accepted = stepper_.try_step(equation_, state_, t_, tried) == ode::success;
      if (accepted && last) t_ = due;
      step_ = std::min(accepted && last ? std::max(step_, tried) : tried, longest_);
      if (step_ < 1e-9 * longest_ || !(std::abs(state_[0]) < runaway_displacement)) return false;
    }
    return true;
  }
  const State& state() const { return state_; }

 private:
  Equation equation_;
  ode::result_of::make_controlled<ode::runge_kutta_fehlberg78<State>>::type stepper_;
  State state_;
  double longest_;
  double step_;
  double t_ = 0.0;
};

}  // namespace

Motion simulate(const MassMaterial& model, const Excitation& excitation, double rate, double tolerance) {
  const auto n = static_cast<Eigen::Index>(std::floor(excitation.duration * rate + 1e-9)) + 1;
  Motion motion = empty_motion(n, rate);
  Marcher marcher(model, excitation, rate, tolerance);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / rate;
    if (!marcher.advance_to(t)) {
      motion.bounded = false;
      break;
    }
    motion.base[i] = excitation.acceleration(t);
    motion.displacement[i] = marcher.state()[0];
    motion.velocity[i] = marcher.state()[1];
    motion.acceleration[i] = acceleration(model, marcher.state(), motion.base[i]);
  }
  return motion;
}

}  // namespace pfdm
